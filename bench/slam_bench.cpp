// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// spslam_bench_slam: each stage by itself (Google Benchmark), on frames and problems of a real run. Sequences
// are sought in the shared data; those that are not there are left out.

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <filesystem>
#include <numeric>

#include "spslam/io/dataset.h"
#include "spslam/odometry/follow.h"
#include "spslam/odometry/frame_problem.h"
#include "spslam/odometry/motion_model.h"
#include "spslam/odometry/new_landmarks.h"
#include "spslam/optimize/synthetic.h"
#include "spslam/segmentation/distance_segmenter.h"

namespace {

using namespace spslam;  // NOLINT

constexpr int kFrames = 12, kFramesToAKeyframe = 4;

// What the tracker has in its hands at frame kFrames: the same stages in the same order, in their plainest
// form.
struct RealRun {
  std::unique_ptr<Dataset> dataset;
  TrackerOptions options;
  StereoFrame pair;  // the newest
  Frame frame;
  ActiveMap before, map;  // without the newest frame, with it
  SE3 predicted;
  std::vector<Sighting> sightings;  // of the newest frame
};

std::vector<int> all_of(const ActiveMap& map) {
  std::vector<int> indices(map.landmarks.size());
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

void make_keyframe(RealRun& run, FrontEnd& front_end, WindowFrame& present) {
  present.keyframe = {present.id.value};
  run.map.hosts[present.keyframe] = {present.keyframe,          present.id,     present.timestamp,
                                     present.camera_from_world, run.frame.left, {}};
  for (NewLandmark& fresh :
       find_new_landmarks(run.map, run.frame, present.sightings, front_end, run.options)) {
    fresh.landmark.id = fresh.sighting.landmark = {static_cast<std::int64_t>(run.map.landmarks.size())};
    fresh.landmark.host = present.keyframe;
    present.sightings.push_back(fresh.sighting);
    run.map.landmarks.push_back({fresh.landmark, fresh.landmark.inverse_depth, 0, 0});
  }
}

void step(RealRun& run, int i, FrontEnd& front_end, MotionModel& motion) {
  run.pair = run.dataset->load(i);
  run.frame = front_end.process(run.pair, {i});
  run.before = run.map;
  run.predicted = motion.predict(run.pair.timestamp);
  run.sightings = follow_patches(run.map, all_of(run.map), run.frame, run.predicted,
                                 run.options.follow.scout_levels, run.options);
  const MotionEstimate estimate = estimate_motion(run.map, run.sightings, run.predicted, run.options.motion);
  const SE3 pose = estimate.solved ? estimate.camera_from_world : run.predicted;
  run.map.window.push_back({{i}, run.pair.timestamp, pose, {}, run.sightings});
  if (i % kFramesToAKeyframe == 0) make_keyframe(run, front_end, run.map.window.back());
  refine_window(run.map, run.options.window);
  update_information(run.map, run.options.window);
  shorten_window(run.map, run.options.window_frames, run.options.window);
  motion.add(run.pair.timestamp, run.map.window.back().camera_from_world);
}

std::shared_ptr<const RealRun> prepare(const std::filesystem::path& folder) {
  auto run = std::make_shared<RealRun>();
  run->dataset = open_dataset(folder);
  run->map.rig = run->dataset->rig();
  FrontEnd front_end(run->options);
  MotionModel motion;
  for (int i = 0; i < std::min(kFrames, run->dataset->size()); ++i) step(*run, i, front_end, motion);
  return run;
}

void decode(benchmark::State& state, const RealRun& run) {
  for (auto _ : state) benchmark::DoNotOptimize(run.dataset->load(kFrames / 2));
}

void extract(benchmark::State& state, const RealRun& run) {
  OrbExtractor extractor(run.options.orb);
  std::size_t features = 0;
  for (auto _ : state) features = extractor.extract(run.pair.left).keypoints.size();
  state.counters["features"] = static_cast<double>(features);
}

void segment(benchmark::State& state, const RealRun& run) {
  DistanceSegmenter segmenter(run.options.segmentation);
  for (auto _ : state) benchmark::DoNotOptimize(segmenter.update(run.pair.left));
}

void front_end(benchmark::State& state, const RealRun& run) {
  FrontEnd stage(run.options);
  for (auto _ : state) benchmark::DoNotOptimize(stage.process(run.pair, {0}));
}

// Both eyes' features and the paper's chain of coarse and fine matching.
void front_end_with_features(benchmark::State& state, const RealRun& run) {
  TrackerOptions options = run.options;
  options.stereo_by_descriptor = true;
  FrontEnd stage(options);
  for (auto _ : state) benchmark::DoNotOptimize(stage.process(run.pair, {0}));
}

// New corners, row search and alignment in the other eye.
void stereo(benchmark::State& state, const RealRun& run) {
  FrontEnd stage(run.options);
  const Frame frame = stage.process(run.pair, {0});
  std::size_t found = 0;
  for (auto _ : state) found = find_new_landmarks(run.before, frame, {}, stage, run.options).size();
  state.counters["landmarks"] = static_cast<double>(found);
}

void follow(benchmark::State& state, const RealRun& run) {
  const std::vector<int> landmarks = all_of(run.before);
  std::size_t found = 0;
  for (auto _ : state)
    found = follow_patches(run.before, landmarks, run.frame, run.predicted, run.options.follow.levels,
                           run.options)
                .size();
  state.counters["landmarks"] = static_cast<double>(landmarks.size());
  state.counters["found"] = static_cast<double>(found);
}

void pose_solver(benchmark::State& state, const RealRun& run) {
  for (auto _ : state)
    benchmark::DoNotOptimize(estimate_motion(run.before, run.sightings, run.predicted, run.options.motion));
  state.counters["sightings"] = static_cast<double>(run.sightings.size());
}

void window_solver(benchmark::State& state, const RealRun& run) {
  // As the tracker has it: the newest frame at its own estimate, everything else solved before.
  ActiveMap unsolved = run.before;
  const MotionEstimate estimate =
      estimate_motion(run.before, run.sightings, run.predicted, run.options.motion);
  unsolved.window.push_back({{kFrames}, run.pair.timestamp, estimate.camera_from_world, {}, run.sightings});
  for (auto _ : state) {
    state.PauseTiming();
    ActiveMap map = unsolved;
    state.ResumeTiming();
    benchmark::DoNotOptimize(refine_window(map, run.options.window));
  }
  state.counters["frames"] = static_cast<double>(unsolved.window.size());
  state.counters["landmarks"] = static_cast<double>(unsolved.landmarks.size());
}

// The bare solver, everywhere the same problem.
void synthetic_window(benchmark::State& state) {
  SyntheticOptions options;
  options.cameras = 10, options.hosts = 3, options.points = static_cast<int>(state.range(0));
  Problem start = make_synthetic_world(options).truth;
  disturb(start, {});
  for (auto _ : state) {
    Problem problem = start;
    benchmark::DoNotOptimize(solve(problem, SolverOptions{}, true));
  }
  state.counters["observations"] = static_cast<double>(start.observations.size());
}
BENCHMARK(synthetic_window)->Arg(300)->Arg(1200)->Unit(benchmark::kMillisecond)->UseRealTime();

void register_all(const std::string& name, const std::shared_ptr<const RealRun>& run) {
  using Stage = void (*)(benchmark::State&, const RealRun&);
  constexpr std::pair<const char*, Stage> kStages[] = {{"decode", decode},
                                                       {"extract", extract},
                                                       {"segment", segment},
                                                       {"front_end", front_end},
                                                       {"front_end_with_features", front_end_with_features},
                                                       {"stereo", stereo},
                                                       {"follow", follow},
                                                       {"pose_solver", pose_solver},
                                                       {"window_solver", window_solver}};
  for (const auto& [stage, function] : kStages)
    benchmark::RegisterBenchmark((std::string(stage) + "/" + name).c_str(),
                                 [run, f = function](benchmark::State& state) { f(state, *run); })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return EXIT_FAILURE;
  try {
    for (const char* name : {"kitti_raw", "nearshore_bank"}) {
      const std::filesystem::path folder = std::filesystem::path(SPSLAM_SHARED_DATA) / name;
      if (std::filesystem::is_directory(folder))
        register_all(name, prepare(folder));
      else
        fmt::print(stderr, "left out: {} (no such folder; set SPSLAM_SHARED_DATA for CMake)\n",
                   folder.string());
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "spslam_bench_slam: {}\n", error.what());
    return EXIT_FAILURE;
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return EXIT_SUCCESS;
}
