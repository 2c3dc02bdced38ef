// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Stereo pairs per second of the simulator, for each named scene as it is (640 x 320, default quality);
// building the scene is not counted.

#include <benchmark/benchmark.h>

#include "spslam/sim/simulator.h"

namespace {

using namespace spslam::sim;  // NOLINT

void render(benchmark::State& state, const std::string& scene) {
  Simulator simulator(load_scene(scene), 1);
  for (auto _ : state)
    if (!simulator.next()) state.SkipWithError("the way is too short for the time given");
  state.counters["pairs"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["quads"] = static_cast<double>(simulator.quad_count());
}

}  // namespace

int main(int argc, char** argv) {
  for (const std::string& scene : scene_names())
    benchmark::RegisterBenchmark(scene.c_str(), [scene](benchmark::State& state) { render(state, scene); })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime()
        ->Iterations(12);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
