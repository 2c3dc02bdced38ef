// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// `spslam check`: do a recording and its calibration fit? Asked before the first run.

#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "spslam/cli/commands.h"
#include "spslam/cli/reading_options.h"
#include "spslam/cli/sample_pairs.h"
#include "spslam/eval/recording_check.h"

namespace spslam {
namespace {

struct CheckArguments {
  std::string dataset;
  DatasetOptions reading;
  int frames = 20;
  bool json = false;
};

const char* judgement_name(Judgement judgement) {
  return option_names(judgement)[static_cast<std::size_t>(judgement)];
}

constexpr std::size_t kIndent = 22, kWidth = 120;  // columns

// Words in lines of kWidth columns, all but the first behind kIndent blanks.
std::string wrapped(const std::string& text) {
  std::string out;
  std::size_t column = kIndent;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (column > kIndent && column + 1 + word.size() > kWidth) {
      out += "\n" + std::string(kIndent, ' ');
      column = kIndent;
    } else if (column > kIndent) {
      out += " ";
      ++column;
    }
    out += word;
    column += word.size();
  }
  return out + "\n";
}

std::string table_text(const Dataset& dataset, std::span<const Finding> findings) {
  std::string text = dataset.description() + "\n";
  for (const std::string& warning : dataset.warnings()) text += "warning: " + warning + "\n";
  for (const Finding& finding : findings) {
    char head[32];
    std::snprintf(head, sizeof head, "%-12s %-8s ", finding.name.c_str(), judgement_name(finding.judgement));
    text += head + wrapped(finding.text);
    if (!finding.advice.empty()) text += std::string(kIndent, ' ') + wrapped("-> " + finding.advice);
  }
  return text + "in all       " + judgement_name(worst_judgement(findings)) + "\n";
}

std::string json_text(const Dataset& dataset, std::span<const Finding> findings) {
  nlohmann::ordered_json out;
  out["dataset"] = dataset.description();
  out["warnings"] = dataset.warnings();
  out["judgement"] = judgement_name(worst_judgement(findings));
  for (const Finding& finding : findings) {
    nlohmann::ordered_json& check = out["checks"][finding.name];
    check["judgement"] = judgement_name(finding.judgement);
    check["found"] = finding.text;
    check["advice"] = finding.advice;
    for (const auto& [name, value] : finding.values) check["values"][name] = value;
  }
  // Names of files need not be UTF-8.
  return out.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

int check(const CheckArguments& arguments) {
  const std::unique_ptr<Dataset> dataset = open_dataset(arguments.dataset, arguments.reading);
  const std::vector<Finding> findings = check_recording(sample_recording(*dataset, arguments.frames));
  const std::string text = arguments.json ? json_text(*dataset, findings) : table_text(*dataset, findings);
  std::fputs(text.c_str(), stdout);
  return worst_judgement(findings) == Judgement::kBad ? 1 : 0;
}

}  // namespace

void add_check(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand(
      "check", "Tell whether a recording and its calibration fit: rows, sides, instants, times, images");
  const auto arguments = std::make_shared<CheckArguments>();
  command->add_option("DATASET", arguments->dataset, "Folder: KITTI, EuRoC, USVInland or plain left/right")
      ->required();
  command->add_option("--frames", arguments->frames, "Pairs to look at, spread over the recording")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  add_reading_options(*command, arguments->reading);
  command->add_flag("--json", arguments->json, "Print one JSON object instead of text");
  command->footer(
      "The exit code is 0 if nothing is bad (there may be warnings) and 1 if something is; "
      "docs/RECORDINGS.md "
      "says what each line means.");
  command->callback([arguments, &chosen] { chosen = [arguments] { return check(*arguments); }; });
}

}  // namespace spslam
