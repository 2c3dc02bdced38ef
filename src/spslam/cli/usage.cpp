// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>

#include "spslam/base/options.h"
#include "spslam/cli/commands.h"

namespace spslam {
namespace {

const CLI::App& deepest_chosen(const CLI::App& app) {
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  return chosen.empty() ? app : deepest_chosen(*chosen.front());
}

std::vector<std::string> option_flags(const CLI::App& app) {
  std::vector<std::string> flags;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) flags.push_back("--" + name);
  return flags;
}

std::vector<std::string> subcommand_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* subcommand : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(subcommand->get_name());
  return names;
}

// What other programs call it, which no likeness of letters leads to. Only the options of this subcommand
// count.
std::string other_word_for(const std::string& word, const std::vector<std::string>& known) {
  constexpr std::pair<const char*, const char*> kMeant[] = {
      {"--frames", "--end"},        {"--max-frames", "--end"},
      {"--from", "--start"},        {"--to", "--end"},
      {"--fps", "--rate"},          {"--force", "--overwrite"},
      {"--verbose", "--log-level"}, {"--map", "--load-map"}};
  for (const auto& [other, ours] : kMeant)
    if (word == other && std::find(known.begin(), known.end(), ours) != known.end()) return ours;
  return "";
}

std::string unknown(const std::string& kind, const std::string& word, const std::vector<std::string>& known) {
  const std::string other = other_word_for(word, known);
  const std::string nearest = other.empty() ? nearest_name(word, known) : other;
  return "unknown " + kind + " '" + word + "'" + (nearest.empty() ? "" : "; did you mean '" + nearest + "'?");
}

// "spslam vocabulary train"
std::string full_name(const CLI::App& app) {
  const std::string above = app.get_parent() ? full_name(*app.get_parent()) + " " : "";
  return above + app.get_name();
}

}  // namespace

std::string usage_message(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& chosen = deepest_chosen(app);
  const std::string help = " See `" + full_name(chosen) + " --help`.";
  const std::vector<std::string> extra = app.remaining(true);
  for (const std::string& word : extra)
    if (word.size() > 1 && word[0] == '-')
      return unknown("option", word.substr(0, word.find('=')), option_flags(chosen)) + help;
  if (!extra.empty() && !subcommand_names(chosen).empty())
    return unknown("subcommand", extra.front(), subcommand_names(chosen)) + help;
  if (!extra.empty()) return "unexpected argument '" + extra.front() + "'." + help;
  return std::string(error.what()) + "." + help;
}

}  // namespace spslam
