// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/eval/run_folder.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>

#include "spslam/base/error.h"
#include "spslam/io/text.h"

namespace spslam {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// The fields of a line; one in double quotes may hold commas.
std::vector<std::string> csv_fields(std::string_view line) {
  std::vector<std::string> fields(1);
  bool in_quotes = false;
  for (const char c : line) {
    if (c == '"')
      in_quotes = !in_quotes;
    else if (c == ',' && !in_quotes)
      fields.emplace_back();
    else if (c != '\r')
      fields.back() += c;
  }
  return fields;
}

std::string csv_field(const std::vector<std::string>& fields, std::ptrdiff_t column) {
  return column >= 0 && column < std::ssize(fields) ? fields[static_cast<std::size_t>(column)]
                                                    : std::string();
}

double number_or_unknown(const std::string& text) {
  double value = kUnknown;
  const auto [stop, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  return code == std::errc() && stop == text.data() + text.size() ? value : kUnknown;
}

bool says_yes(const std::string& text) {
  return !text.empty() && text != "0" && text != "false" && text != "no" && text != "none";
}

Json parsed(std::string_view text, const std::string& name) {
  Json json = Json::parse(text, nullptr, false);
  if (!json.is_object())
    throw InputError(name + ": is not a JSON object; was the run stopped while it was written?");
  return json;
}

double member(const Json& object, const char* name) {
  for (const std::string& key : {std::string(name), std::string(name) + "_ms"})
    if (object.contains(key) && object[key].is_number()) return object[key].get<double>();
  return kUnknown;
}

bool is_stage(const Json& value) {
  return value.is_object() && !std::isnan(member(value, "mean"));
}

void add_stages(const Json& stages, ReportInput& report) {
  for (const auto& [name, stage] : stages.items())
    if (is_stage(stage))
      report.timing.push_back(
          {name, member(stage, "mean"), member(stage, "p50"), member(stage, "p95"), member(stage, "max")});
}

// Numbers and texts at the top of a JSON object as facts, objects' members with a dotted name.
void add_facts(const Json& object, const std::string& prefix, ReportInput& report) {
  for (const auto& [name, value] : object.items()) {
    if (value.is_string())
      report.facts.emplace_back(prefix + name, value.get<std::string>());
    else if (value.is_primitive() && !value.is_null())
      report.facts.emplace_back(
          prefix + name, value.is_number_float() ? fmt::format("{:.6g}", value.get<double>()) : value.dump());
    else if (value.is_object() && !is_stage(value) && name != "stages")
      add_facts(value, prefix + name + ".", report);
  }
}

void add_images(const std::filesystem::path& folder, ReportInput& report) {
  if (!std::filesystem::is_directory(folder)) return;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".png") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const std::filesystem::path& file : files)
    report.images.push_back({file.stem().string(), read_text_file(file)});
}

void add_frame_facts(ReportInput& report) {
  if (report.frames.empty()) return;
  const auto add = [&](const char* name, auto is_one) {
    const auto count = std::count_if(report.frames.begin(), report.frames.end(), is_one);
    report.facts.emplace_back(name, std::to_string(count));
  };
  add("frames", [](const ReportFrame&) { return true; });
  add("frames tracked", [](const ReportFrame& f) { return f.state == "tracking"; });
  add("frames coasting", [](const ReportFrame& f) { return f.state == "coasting"; });
  add("frames lost", [](const ReportFrame& f) { return f.state == "lost"; });
  add("frames initializing", [](const ReportFrame& f) { return f.state == "initializing"; });
  add("keyframes", [](const ReportFrame& f) { return f.keyframe; });
}

}  // namespace

std::vector<ReportFrame> parse_frames_csv(std::string_view text, const std::string& name) {
  std::vector<ReportFrame> frames;
  LineReader reader(text, name);
  if (!reader.next()) return frames;
  const std::vector<std::string> head = csv_fields(reader.line());
  const auto column = [&](const char* wanted) -> std::ptrdiff_t {
    const auto at = std::find(head.begin(), head.end(), wanted);
    return at == head.end() ? -1 : at - head.begin();
  };
  const std::ptrdiff_t time = column("timestamp"), state = column("state"), near = column("near"),
                       far = column("far"), keyframe = column("keyframe");
  if (time < 0) reader.fail("has no column 'timestamp'; the first line must name the columns");
  while (reader.next()) {
    const std::vector<std::string> fields = csv_fields(reader.line());
    if (fields.size() != head.size())
      reader.fail("has " + std::to_string(fields.size()) + " fields, the first line names " +
                  std::to_string(head.size()) + " columns; was the file cut off?");
    ReportFrame frame;
    frame.timestamp = reader.real(csv_field(fields, time));
    frame.state = csv_field(fields, state);
    frame.near = number_or_unknown(csv_field(fields, near));
    frame.far = number_or_unknown(csv_field(fields, far));
    frame.keyframe = says_yes(csv_field(fields, keyframe));
    frames.push_back(frame);
  }
  return frames;
}

void parse_timing_json(std::string_view text, const std::string& name, ReportInput& report) {
  const Json json = parsed(text, name);
  if (json.contains("stages") && json["stages"].is_object()) add_stages(json["stages"], report);
  add_stages(json, report);
  add_facts(json, "", report);
}

ReportInput read_run_folder(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder))
    throw InputError(folder.string() + " is not a folder; give the output folder of `spslam run`");
  ReportInput report;
  report.title = std::filesystem::absolute(folder).lexically_normal().filename().string();
  enum class Missing { kIsSaid, kIsUsual };
  const auto read = [&](const char* name, Missing missing, const auto& use) {
    const std::filesystem::path file = folder / name;
    if (!std::filesystem::exists(file)) {
      if (missing == Missing::kIsSaid)
        report.notes.push_back(std::string(name) + " is not there, was the run killed?");
      return;
    }
    try {
      use(read_text_file(file), file.string());
    } catch (const InputError& error) {
      report.notes.push_back(std::string("left out: ") + error.what());
    }
  };
  using Text = const std::string&;
  read("trajectory_tum.txt", Missing::kIsSaid,
       [&](Text text, Text name) { report.estimate = parse_tum(text, name); });
  read("frames.csv", Missing::kIsSaid,
       [&](Text text, Text name) { report.frames = parse_frames_csv(text, name); });
  if (report.estimate.empty() && report.frames.empty()) {
    std::string why;
    for (const std::string& note : report.notes) why += "; " + note;
    throw InputError(folder.string() +
                     " has neither a trajectory_tum.txt nor a frames.csv with anything in it" + why);
  }
  add_frame_facts(report);
  read("timing.json", Missing::kIsSaid, [&](Text text, Text name) { parse_timing_json(text, name, report); });
  read("metrics.json", Missing::kIsUsual,
       [&](Text text, Text name) { report.evaluation = parse_json_report(text, name); });
  read("config.yaml", Missing::kIsUsual, [&](Text text, Text) { report.config = text; });
  add_images(folder / "samples", report);
  return report;
}

}  // namespace spslam
