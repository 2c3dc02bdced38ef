// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Saving and loading a map of 500 keyframes with 1000 features, 500 sightings and an image of 40 kB each.

#include "spslam/system/map_file.h"

#include <benchmark/benchmark.h>

#include "system/made_up_map.h"

namespace {

using namespace spslam;  // NOLINT

const Map& big_map() {
  static const Map map =
      test::made_up_map({.keyframes = 500, .features = 1000, .sightings = 500, .image_bytes = 40000});
  return map;
}

std::filesystem::path scratch_file() {
  return std::filesystem::temp_directory_path() / "spslam_bench_map_file.map";
}

void report_size(benchmark::State& state) {
  state.counters["MB"] = static_cast<double>(std::filesystem::file_size(scratch_file())) / 1e6;
}

void save(benchmark::State& state) {
  for (auto _ : state) save_map(scratch_file(), big_map(), test::made_up_rig());
  report_size(state);
}
BENCHMARK(save)->Unit(benchmark::kMillisecond)->UseRealTime();

void load(benchmark::State& state) {
  save_map(scratch_file(), big_map(), test::made_up_rig());
  for (auto _ : state) benchmark::DoNotOptimize(load_map(scratch_file()));
  report_size(state);
  std::filesystem::remove(scratch_file());
}
BENCHMARK(load)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
