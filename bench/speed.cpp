// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// spslam_bench_speed DATASET: milliseconds a frame of the whole system in its sequential mode, images decoded
// beforehand, and their ratio to a fixed workload that is run between the frames, so that load and machine
// cancel.

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "reference_workload.h"
#include "spslam/base/error.h"
#include "spslam/io/dataset.h"
#include "spslam/system/slam.h"

namespace {

using namespace spslam;  // NOLINT

struct Settings {
  std::string dataset, config;
  std::vector<std::string> changes;  // key=value
  Preset preset = Preset::kSpSlam;
  int first = 0, frames = 200, threads = 0, reference_every = 5;
};

struct Times {
  std::vector<double> tracking, reference;  // ms
  StageTimes stages;                        // s, sums
  int tracked = 0;
};

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto at = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
  return values[at];
}

std::vector<StereoFrame> decode(const Dataset& dataset, const Settings& settings) {
  std::vector<StereoFrame> frames;
  for (int i = settings.first; i < std::min(dataset.size(), settings.first + settings.frames); ++i)
    frames.push_back(dataset.load(i));
  if (frames.empty())
    throw InputError(settings.dataset + ": no frames from " + std::to_string(settings.first));
  return frames;
}

SlamOptions options_of(const Settings& settings) {
  SlamOptions options = preset_options(settings.preset);
  options.threads = Threads::kSequential;
  if (!settings.config.empty()) apply_yaml_file(options, settings.config);
  for (const std::string& change : settings.changes) {
    const std::size_t equal = change.find('=');
    if (equal == std::string::npos) throw OptionError("--set " + change + ": give key=value");
    set_option(options, change.substr(0, equal), change.substr(equal + 1));
  }
  return options;
}

void add(const StageTimes& seconds, StageTimes& sum) {
  for (const auto stage : {&StageTimes::front_end, &StageTimes::follow, &StageTimes::motion,
                           &StageTimes::window, &StageTimes::keyframe, &StageTimes::total})
    sum.*stage += seconds.*stage;
}

Times run(const StereoRig& rig, const std::vector<StereoFrame>& frames, const Settings& settings) {
  bench::ReferenceWorkload reference;
  reference.run();  // warm
  Slam slam(rig, options_of(settings));
  Times times;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto begin = std::chrono::steady_clock::now();
    const TrackResult result = slam.track(frames[i]);
    const std::chrono::duration<double, std::milli> passed = std::chrono::steady_clock::now() - begin;
    times.tracking.push_back(passed.count());
    times.tracked += result.status == TrackStatus::kTracking;
    add(result.seconds, times.stages);
    if (i % static_cast<std::size_t>(settings.reference_every) == 0)
      times.reference.push_back(1000 * reference.run());
  }
  slam.finish();
  return times;
}

void print(const Times& times, const Settings& settings) {
  const double median = quantile(times.tracking, 0.5), p95 = quantile(times.tracking, 0.95),
               reference = quantile(times.reference, 0.5);
  const auto frames = static_cast<double>(times.tracking.size());
  const auto mean = [&](double StageTimes::*stage) { return 1000 * times.stages.*stage / frames; };
  fmt::print("dataset          {}\nframes           {} ({} tracked)\n", settings.dataset,
             times.tracking.size(), times.tracked);
  fmt::print("tracking median  {:.2f} ms\ntracking p95     {:.2f} ms\n", median, p95);
  fmt::print(
      "stages, mean     front end {:.2f}, follow {:.2f}, motion {:.2f}, window {:.2f}, keyframe {:.2f} ms\n",
      mean(&StageTimes::front_end), mean(&StageTimes::follow), mean(&StageTimes::motion),
      mean(&StageTimes::window), mean(&StageTimes::keyframe));
  fmt::print("reference median {:.2f} ms\n", reference);
  fmt::print("ratio median     {:.3f}\nratio p95        {:.3f}\n", median / reference, p95 / reference);
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  std::string preset = "sp-slam";
  CLI::App app("Milliseconds a frame of the sequential system, and their ratio to a fixed workload");
  app.add_option("dataset", settings.dataset, "folder of a sequence")->required();
  app.add_option("--preset", preset, "sp-slam, paper or baseline")
      ->check(CLI::IsMember({"sp-slam", "paper", "baseline"}));
  app.add_option("--config", settings.config, "YAML with options")->check(CLI::ExistingFile);
  app.add_option("--set", settings.changes, "key=value, any option")->take_all();
  app.add_option("--first", settings.first, "first frame")->check(CLI::NonNegativeNumber);
  app.add_option("--frames", settings.frames, "frames at most")->check(CLI::PositiveNumber);
  app.add_option("--threads", settings.threads, "worker threads, 0 for all cores")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--reference-every", settings.reference_every, "frames between two reference runs")
      ->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  for (const Preset value : {Preset::kSpSlam, Preset::kPaper, Preset::kBaseline})
    if (preset == option_names(value)[static_cast<std::size_t>(value)]) settings.preset = value;
  try {
    std::optional<tbb::global_control> limit;
    if (settings.threads > 0)
      limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(settings.threads));
    const std::unique_ptr<Dataset> dataset = open_dataset(settings.dataset);
    print(run(dataset->rig(), decode(*dataset, settings), settings), settings);
  } catch (const std::exception& error) {
    fmt::print(stderr, "spslam_bench_speed: {}\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
