// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// `spslam report`: a run's result folder as one HTML page.

#include <cstdio>

#include "spslam/cli/commands.h"
#include "spslam/eval/run_folder.h"
#include "spslam/eval/trajectory_pair.h"
#include "spslam/io/text.h"

namespace spslam {
namespace {

struct ReportArguments {
  std::filesystem::path folder;
  std::filesystem::path output;  // empty: report.html in the folder
  std::filesystem::path truth;   // empty: the errors that the run computed
  TrajectoryFormat truth_format = TrajectoryFormat::kAuto;
  std::string title;
  EvaluationOptions options;
};

int write_report(const ReportArguments& arguments) {
  ReportInput report = read_run_folder(arguments.folder);
  for (const std::string& note : report.notes) std::fprintf(stderr, "spslam: %s\n", note.c_str());
  if (!arguments.title.empty()) report.title = arguments.title;
  if (!arguments.truth.empty()) {
    TrajectoryPairFiles files;
    files.estimate = arguments.folder / "trajectory_tum.txt";
    files.truth = arguments.truth;
    files.truth_format = arguments.truth_format;
    const TrajectoryPair pair = read_trajectory_pair(files);
    report.evaluation = evaluate(pair.estimate, pair.truth, arguments.options);
  }
  const std::filesystem::path output =
      arguments.output.empty() ? arguments.folder / "report.html" : arguments.output;
  write_text_file(output, html_report(report));
  std::printf("%s\n", output.string().c_str());
  return 0;
}

}  // namespace

void add_report(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("report", "Make one HTML page of a run's result folder");
  const auto arguments = std::make_shared<ReportArguments>();
  command->add_option("RUN_DIR", arguments->folder, "Output folder of `spslam run`")->required();
  command
      ->add_option("--truth", arguments->truth,
                   "True trajectory, for errors over time; without it those that the run computed")
      ->type_name("FILE");
  command
      ->add_option("--format-truth", arguments->truth_format,
                   "Its format: auto, tum, kitti, euroc or usvinland")
      ->transform(enum_names<TrajectoryFormat>())
      ->type_name("FORMAT");
  command->add_option("--output", arguments->output, "The page (default: RUN_DIR/report.html)")
      ->type_name("FILE");
  command->add_option("--title", arguments->title, "Its title (default: the folder's name)");
  command->add_option("--align", arguments->options.align, "se3 (default), sim3 or none")
      ->transform(enum_names<AlignMode>())
      ->type_name("MODE");
  command->add_flag("--planar", arguments->options.planar, "Errors in the horizontal plane only");
  command->add_flag("--interpolate", arguments->options.association.interpolate,
                    "Interpolate the truth in time");
  command->callback([arguments, &chosen] { chosen = [arguments] { return write_report(*arguments); }; });
}

}  // namespace spslam
