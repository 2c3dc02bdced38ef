// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// `spslam run`: a data set in, a folder of results out.

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <thread>

#include "spslam/cli/commands.h"
#include "spslam/cli/reading_options.h"
#include "spslam/cli/run_folder.h"
#include "spslam/cli/run_options.h"
#include "spslam/cli/run_samples.h"
#include "spslam/cli/run_signal.h"
#include "spslam/cli/run_tables.h"
#include "spslam/eval/evaluation.h"
#include "spslam/io/prefetch.h"
#include "spslam/system/map_file.h"

namespace spslam {
namespace {

using Clock = std::chrono::steady_clock;

struct RunArguments {
  std::string dataset, output;
  OptionArguments options;
  DatasetOptions reading;
  int start = 0;
  int end = std::numeric_limits<int>::max();
  int samples = 6;
  std::string save_map, load_map;
  bool localize = false;
  bool sequential = false, realtime = false, ahead = false, overwrite = false, quiet = false;
};

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Sleeps in short pieces, so that a signal ends it.
void wait_until(Clock::time_point time) {
  constexpr auto kPiece = std::chrono::milliseconds(20);
  while (interruption() == 0 && Clock::now() < time)
    std::this_thread::sleep_until(std::min(time, Clock::now() + kPiece));
}

// One line on a terminal, a few times a second.
class ProgressLine {
 public:
  ProgressLine(bool wanted, int frames)
      : shown_(wanted && frames > 0 && isatty(fileno(stderr)) != 0), frames_(frames) {}
  ~ProgressLine() {
    if (shown_) std::fputs("\r\033[K", stderr);
  }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(int done, const TrackResult& result) {
    if (!shown_ || (done < frames_ && seconds_since(last_) < 0.1)) return;
    last_ = Clock::now();
    constexpr int kWidth = 24;
    const int filled = kWidth * done / frames_;
    const std::string bar = std::string(static_cast<std::size_t>(filled), '#') +
                            std::string(static_cast<std::size_t>(kWidth - filled), '.');
    const char* state = option_names(result.status)[static_cast<std::size_t>(result.status)];
    std::fprintf(stderr, "\r[%s] %d/%d  %.1f frames/s  %s  %d near\033[K", bar.c_str(), done, frames_,
                 done / std::max(1e-9, seconds_since(start_)), state, result.near);
    std::fflush(stderr);
  }

 private:
  bool shown_;
  int frames_;
  Clock::time_point start_ = Clock::now(), last_ = {};
};

void log_frame(const FrameRecord& frame, TrackStatus before) {
  const TrackResult& result = frame.result;
  if (result.status != before || !result.reason.empty())
    spdlog::info("frame {}: {}{}{}", frame.index,
                 option_names(result.status)[static_cast<std::size_t>(result.status)],
                 result.reason.empty() ? "" : ": ", result.reason);
}

// Gives the frames to slam until their end, a signal or an exception, which is returned so that what was done
// before it can be written.
std::exception_ptr track_frames(const RunArguments& arguments, const Dataset& dataset, Prefetcher& frames,
                                Slam& slam, RunRecord& record) {
  ProgressLine progress(!arguments.quiet, std::min(arguments.end, dataset.size()) - arguments.start);
  const Clock::time_point start = Clock::now();
  TrackStatus before = TrackStatus::kInitializing;
  std::exception_ptr failure;
  try {
    while (interruption() == 0) {
      const std::optional<LoadedFrame> frame = frames.next();
      if (!frame) break;
      const double time = frame->pair.timestamp - dataset.timestamp(arguments.start);
      if (arguments.realtime)
        wait_until(start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(time)));
      else if (!arguments.ahead)
        slam.wait_for_map();
      if (interruption() != 0) break;
      record.frames.push_back({frame->index, frame->seconds, slam.track(frame->pair)});
      log_frame(record.frames.back(), before);
      before = record.frames.back().result.status;
      progress.show(static_cast<int>(record.frames.size()), record.frames.back().result);
    }
    slam.finish();
  } catch (const std::exception& error) {
    spdlog::error("the run ends after {} frames: {}", record.frames.size(), error.what());
    failure = std::current_exception();
  }
  record.wall_seconds = seconds_since(start);
  record.trajectory = slam.trajectory();
  record.keyframes = slam.keyframes();
  record.mapping = slam.mapping();
  record.loops = slam.loops();
  record.landmarks = slam.landmark_count();
  return failure;
}

// Against the data set's truth. Nothing without one, or if too little of it belongs to what was done.
std::optional<Evaluation> evaluate_run(const Dataset& dataset, const RunRecord& record) {
  if (!dataset.ground_truth()) return std::nullopt;
  EvaluationOptions options;
  options.planar = dataset.planar_ground_truth();
  options.association.interpolate = options.planar;  // a GNSS receiver is slower than the camera
  try {
    return evaluate(stamped_trajectory(record), *dataset.ground_truth(), options);
  } catch (const InputError& error) {
    spdlog::warn("no errors are computed: {}", error.what());
    return std::nullopt;
  }
}

// Every file is tried, whatever became of the others; throws the first failure.
void write_results(const ResultFolder& folder, const Dataset& dataset, const RunRecord& record,
                   const std::optional<Evaluation>& evaluation) {
  std::exception_ptr failure;
  const auto write = [&](const char* name, const std::string& text) {
    try {
      folder.write(name, text);
    } catch (const OutputError& error) {
      spdlog::error("{}", error.what());
      if (!failure) failure = std::current_exception();
    }
  };
  write("trajectory_tum.txt", format_tum(stamped_trajectory(record)));
  write("trajectory_kitti.txt", format_kitti_poses(trajectory_of_every_frame(record)));
  write("frames.csv", frames_csv(record));
  write("keyframes.csv", keyframes_csv(record));
  write("mapping.csv", mapping_csv(record));
  write("loops.csv", loops_csv(record));
  write("timing.json", timing_json(record, dataset.description()));
  if (evaluation) write("metrics.json", json_report(*evaluation));
  if (failure) std::rethrow_exception(failure);
}

std::string report_text(const std::string& folder, const RunRecord& record,
                        const std::optional<Evaluation>& evaluation) {
  std::string text = fmt::format(
      "frames       {} ({}); {} keyframes, {} landmarks\n"
      "way          {:.3f} m\n"
      "speed        {:.1f} frames/s, median {:.1f} ms a frame, peak memory {:.0f} MB\n",
      record.frames.size(), state_counts(record), record.keyframes.size(), record.landmarks,
      path_length(stamped_trajectory(record)),
      static_cast<double>(record.frames.size()) / std::max(1e-9, record.wall_seconds),
      median_frame_ms(record), peak_memory_mb());
  if (evaluation) text += brief_report(*evaluation);
  if (record.trajectory.empty()) text += "note: no frame could be tracked; frames.csv says why\n";
  return text + "results      " + folder + "\n";
}

// The map to continue, if one is given; refused if it is of another rig.
Map known_map(const RunArguments& arguments, const StereoRig& rig) {
  if (arguments.load_map.empty()) return {};
  SavedMap saved = load_map(arguments.load_map);
  check_same_rig(saved.rig, rig);
  return std::move(saved.map);
}

int run_dataset(const RunArguments& arguments) {
  SlamOptions options = effective_options(arguments.options);
  if (arguments.sequential) options.threads = Threads::kSequential;
  if (arguments.localize) options.localization.enabled = true;
  const std::unique_ptr<Dataset> dataset = open_dataset(arguments.dataset, arguments.reading);
  Slam slam(dataset->rig(), options, known_map(arguments, dataset->rig()));
  Prefetcher frames(*dataset, arguments.start, arguments.end, 2);
  const ResultFolder folder(arguments.output, arguments.overwrite);
  folder.write("config.yaml", std::string("# spslam " SPSLAM_VERSION ", preset ") +
                                  preset_name(arguments.options.preset) +
                                  "; spslam run --config reads this file\n" + to_yaml(options));
  spdlog::info("spslam " SPSLAM_VERSION ", preset {}", preset_name(arguments.options.preset));
  spdlog::info("{}", dataset->description());
  log_warnings(*dataset);
  watch_for_interruption();
  RunRecord record;
  const std::exception_ptr failure = track_frames(arguments, *dataset, frames, slam, record);
  const int signal = interruption();
  const std::optional<Evaluation> evaluation = evaluate_run(*dataset, record);
  const std::string report = report_text(arguments.output, record, evaluation);
  spdlog::info("{} {} frames: {}", signal == 0 ? "done" : "interrupted after", record.frames.size(),
               state_counts(record));
  write_results(folder, *dataset, record, evaluation);
  if (!arguments.save_map.empty()) slam.save(arguments.save_map);
  if (signal == 0 && !failure && !record.frames.empty())
    write_samples(folder, *dataset, options.tracker, record.frames.front().index, record.frames.back().index,
                  arguments.samples);
  if (!arguments.quiet) std::fputs((dataset->description() + "\n" + report).c_str(), stdout);
  if (failure) std::rethrow_exception(failure);
  if (signal == 0) return 0;
  std::fprintf(stderr, "spslam: interrupted after %zu frames; their results are in %s\n",
               record.frames.size(), arguments.output.c_str());
  return 128 + signal;
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
  command->add_option("--save-map", arguments->save_map, "File for the map, at the end of the run")
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
      ->add_option("--samples", arguments->samples,
                   "Pictures of the run's features, near and far, for its report")
      ->check(CLI::Range(0, 1000))
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
  command->add_flag("--overwrite", arguments->overwrite, "Replace the results that are in the folder");
  command->add_flag("--quiet,-q", arguments->quiet, "No progress, no report");
  command->callback([arguments, &chosen] { chosen = [arguments] { return run_dataset(*arguments); }; });
}

}  // namespace spslam
