// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// `spslam run`: a data set in, a folder of results out.

#include <spdlog/spdlog.h>

#include <cstdio>

#include "spslam/base/error.h"
#include "spslam/cli/commands.h"
#include "spslam/cli/reading_options.h"
#include "spslam/cli/run_loop.h"
#include "spslam/cli/run_map.h"
#include "spslam/cli/run_provenance.h"
#include "spslam/cli/run_results.h"
#include "spslam/cli/run_samples.h"
#include "spslam/cli/run_signal.h"
#include "spslam/cli/run_summary.h"
#include "spslam/cli/sample_pairs.h"

namespace spslam {
namespace {

// Says why it is not 0.
int exit_code(const RunArguments& arguments, const RunRecord& record, int signal) {
  if (signal != 0) {
    std::fprintf(stderr, "spslam: interrupted after %zu frames; their results are in %s\n",
                 record.frames.size(), arguments.output.c_str());
    return 128 + signal;
  }
  const std::string problem = nothing_tracked(record);
  if (problem.empty()) return 0;
  std::fprintf(stderr, "spslam: %s; %s/frames.csv has each\n", problem.c_str(), arguments.output.c_str());
  return 1;
}

SlamOptions options_of(const RunArguments& arguments) {
  SlamOptions options = effective_options(arguments.options);
  if (arguments.sequential) options.threads = Threads::kSequential;
  if (arguments.localize) options.localization.enabled = true;
  if (arguments.ahead && options.threads == Threads::kSequential)
    throw OptionError(
        "--ahead: with threads=sequential tracking cannot run ahead of its map; leave one of them out");
  return options;
}

int run_dataset(const RunArguments& arguments) {
  const SlamOptions options = options_of(arguments);
  const std::unique_ptr<Dataset> dataset = open_dataset(arguments.dataset, arguments.reading);
  check_map_target(arguments);
  RunRecord record;
  Map known = known_map(arguments, dataset->rig());
  for (const auto& [id, keyframe] : known.keyframes()) record.loaded.insert(id);
  Slam slam(dataset->rig(), options, std::move(known), read_vocabulary(arguments.vocabulary));
  Prefetcher frames(*dataset, arguments.start, arguments.end, 2);
  const ResultFolder folder(arguments.output, arguments.overwrite);
  const std::vector<std::string> origin = provenance(arguments, options);
  for (const std::string& line : origin) spdlog::info("{}", line);
  folder.write("config.yaml", config_text(origin, options));
  spdlog::info("{}", dataset->description());
  log_warnings(*dataset);
  warn_of_pairs(*dataset, arguments.start);
  watch_for_interruption();
  Checkpoint checkpoint(arguments.checkpoint, folder.path() / "trajectory_tum.txt", arguments.save_map);
  const std::exception_ptr failure = track_frames(arguments, *dataset, frames, slam, checkpoint, record);
  const int signal = interruption();
  Attempts attempts;
  if (failure) attempts.attempt([&] { std::rethrow_exception(failure); });
  const std::optional<Evaluation> evaluation = evaluate_run(*dataset, record);
  const std::string report = report_text(arguments.output, record, evaluation);
  spdlog::info("{} {} frames: {}", signal == 0 ? "done" : "interrupted after", record.frames.size(),
               state_counts(record));
  write_results(folder, *dataset, record, evaluation, attempts);
  if (!arguments.save_map.empty()) attempts.attempt([&] { slam.save(arguments.save_map); });
  if (signal == 0 && !failure && !record.frames.empty())
    attempts.attempt([&] {
      write_samples(folder, *dataset, options.tracker, record.frames.front().index,
                    record.frames.back().index, arguments.samples);
    });
  if (!arguments.quiet) std::fputs((dataset->description() + "\n" + report).c_str(), stdout);
  attempts.throw_failures();
  return exit_code(arguments, record, signal);
}

void add_range_options(CLI::App& command, RunArguments& arguments) {
  command.add_option("--start", arguments.start, "First frame, from 0")->type_name("INDEX");
  command.add_option("--end", arguments.end, "The frame before which to stop; the last unless given")
      ->type_name("INDEX");
}

}  // namespace

void add_run(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("run", "Compute the trajectory of a stereo data set");
  const auto arguments = std::make_shared<RunArguments>();
  command->add_option("DATASET", arguments->dataset, "Folder: KITTI, EuRoC, USVInland or plain left/right")
      ->required();
  command
      ->add_option("--output,-o", arguments->output,
                   "Folder for the results; what was computed is written when interrupted too")
      ->required()
      ->type_name("DIR");
  add_option_arguments(*command, arguments->options);
  add_reading_options(*command, arguments->reading);
  add_range_options(*command, *arguments);
  command
      ->add_option("--save-map", arguments->save_map,
                   "File for the map, at the end of the run; one that exists needs --overwrite")
      ->type_name("FILE");
  command
      ->add_option("--load-map", arguments->load_map,
                   "Map to continue: tracking begins once a frame is recognized in it; or see --localize")
      ->type_name("FILE");
  command
      ->add_flag("--localize", arguments->localize,
                 "Say where in that map the boat is and leave the map as it is (localization.enabled)")
      ->needs("--load-map")
      ->excludes("--save-map");
  command
      ->add_option("--vocabulary", arguments->vocabulary,
                   "What places are recognized with: a file of `spslam vocabulary train`, or .txt of DBoW2")
      ->type_name("FILE")
      ->capture_default_str();
  command
      ->add_option("--samples", arguments->samples,
                   "Pictures of the run's features, near and far, for its report")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command
      ->add_option(
          "--checkpoint", arguments->checkpoint,
          "Seconds after which trajectory_tum.txt, and the map of --save-map, are written as they are "
          "then, for when the run is killed; 0: never")
      ->check(CLI::Range(0.0, 1e6))
      ->type_name("SECONDS")
      ->capture_default_str();
  CLI::Option* sequential =
      command->add_flag("--sequential", arguments->sequential,
                        "All stages in order in one thread: the same bits on every run (threads=sequential)");
  CLI::Option* realtime =
      command->add_flag("--realtime", arguments->realtime, "Give each frame no earlier than at its time");
  command
      ->add_flag("--ahead", arguments->ahead,
                 "Do not wait for the map before the next frame: less accurate, to see how much")
      ->excludes(sequential)
      ->excludes(realtime);
  command->add_flag("--overwrite", arguments->overwrite,
                    "Replace the results that are in the folder, and the file of --save-map");
  command->add_flag("--quiet,-q", arguments->quiet, "No progress, no report");
  command->callback([arguments, &chosen] { chosen = [arguments] { return run_dataset(*arguments); }; });
}

}  // namespace spslam
