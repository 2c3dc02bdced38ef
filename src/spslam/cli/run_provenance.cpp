// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/cli/run_provenance.h"

#include <spdlog/fmt/fmt.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <utility>

namespace spslam {
namespace {

namespace fs = std::filesystem;

// The words that this process was started with.
std::string command_line() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::string line;
  for (std::string word; std::getline(file, word, '\0');)
    line += (line.empty() ? "" : " ") + shell_word(word);
  return line;
}

std::string full_path(const fs::path& path) {
  std::error_code error;
  const fs::path full = fs::absolute(path, error);
  return shell_word((error ? path : full).lexically_normal().string());
}

// As --set takes them.
std::vector<std::string> differences(const SlamOptions& options, Preset preset) {
  const std::vector<OptionText> present = list_options(options), plain = list_options(preset_options(preset));
  std::vector<std::string> changed;
  for (std::size_t i = 0; i < present.size(); ++i)
    if (present[i].value != plain[i].value) changed.push_back(present[i].key + "=" + present[i].value);
  return changed;
}

}  // namespace

std::string shell_word(const std::string& word) {
  constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) {
    if (c == '\'')
      quoted += "'\\''";
    else
      quoted += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  }
  return quoted + "'";
}

std::string described_options(const SlamOptions& options) {
  Preset nearest = Preset::kSpSlam;
  for (const Preset other : {Preset::kPaper, Preset::kBaseline})
    if (differences(options, other).size() < differences(options, nearest).size()) nearest = other;
  std::string text = std::string("preset ") + preset_name(nearest), joint = " with ";
  for (const std::string& change : differences(options, nearest)) text += std::exchange(joint, ", ") + change;
  return text;
}

std::vector<std::string> provenance(const RunArguments& arguments, const SlamOptions& options) {
  std::vector<std::string> lines;
  const auto say = [&](const std::string& what, const std::string& value) {
    lines.push_back(what + ": " + value);
  };
  std::error_code ignored;
  say("command", command_line());
  say("in", shell_word(fs::current_path(ignored).string()));
  say("data set", full_path(arguments.dataset));
  const std::vector<OptionText> reading = list_options(arguments.reading),
                                plain = list_options(DatasetOptions{});
  for (std::size_t i = 0; i < reading.size(); ++i) {
    const auto& [key, value, unit, meaning] = reading[i];
    const bool is_path = key == "calibration" || key == "truth";
    if (value != plain[i].value) say(key, is_path ? full_path(value) : shell_word(value));
  }
  const bool to_the_last = arguments.end == std::numeric_limits<int>::max();
  say("frames", fmt::format("--start {}, {}", arguments.start,
                            to_the_last ? "to the last" : fmt::format("--end {}", arguments.end)));
  if (!arguments.load_map.empty())
    say(arguments.localize ? "localized in the map" : "continued map", full_path(arguments.load_map));
  if (arguments.vocabulary != kBuiltIn) say("vocabulary", full_path(arguments.vocabulary));
  if (!arguments.save_map.empty()) say("saved map", full_path(arguments.save_map));
  if (!arguments.options.config.empty()) say("options from", full_path(arguments.options.config));
  say("options", described_options(options));
  return lines;
}

std::string config_text(const std::vector<std::string>& provenance, const SlamOptions& options) {
  std::string text = "# spslam " SPSLAM_VERSION "; spslam run --config reads this file\n";
  for (const std::string& line : provenance) text += "# " + line + "\n";
  return text + to_yaml(options);
}

}  // namespace spslam
