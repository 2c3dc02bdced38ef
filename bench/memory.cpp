// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// spslam_bench_memory: does the map grow with the area or with the time? Plays a sequence forth and back so
// many times, as a boat that keeps to one basin, and prints the map's size and the memory after each passage,
// as Markdown.

#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>

#include "spslam/base/error.h"
#include "spslam/io/prefetch.h"
#include "spslam/system/slam.h"

namespace {

using namespace spslam;  // NOLINT

std::vector<StereoFrame> load(const std::string& folder) {
  const std::unique_ptr<Dataset> dataset = open_dataset(folder);
  Prefetcher frames(*dataset);
  std::vector<StereoFrame> all;
  while (auto frame = frames.next()) all.push_back(std::move(frame->pair));
  return all;
}

// Of the process now, MB.
double resident_mb() {
  std::ifstream statm("/proc/self/statm");
  double pages = 0, resident = 0;
  statm >> pages >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

void measure(const std::string& folder, int passages) {
  const std::vector<StereoFrame> frames = load(folder);
  SlamOptions options;
  options.threads = Threads::kSequential;
  Slam slam(open_dataset(folder)->rig(), options);
  const double images = resident_mb();
  fmt::print(
      "| passage | frames | keyframes | landmarks | memory MB, the images not counted "
      "|\n|---|---|---|---|---|\n");
  double time = 0;
  int count = 0;
  for (int passage = 0; passage < passages; ++passage) {
    for (std::size_t i = 0; i < frames.size(); ++i) {
      StereoFrame pair = frames[passage % 2 == 0 ? i : frames.size() - 1 - i];
      pair.timestamp = time += 0.1;
      slam.track(pair);
      ++count;
    }
    malloc_trim(0);  // what was given back is not the map's
    fmt::print("| {} | {} | {} | {} | {:.0f} |\n", passage + 1, count, slam.keyframes().size(),
               slam.landmark_count(), resident_mb() - images);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("How the map grows while a sequence is played forth and back");
  std::string folder;
  int passages = 13;
  app.add_option("SEQUENCE", folder, "Folder of a stereo sequence")->required();
  app.add_option("--passages", passages, "How often it is passed")
      ->capture_default_str()
      ->check(CLI::Range(1, 10000));
  CLI11_PARSE(app, argc, argv);
  try {
    measure(folder, passages);
    return 0;
  } catch (const Error& error) {
    fmt::print(stderr, "spslam_bench_memory: {}\n", error.what());
    return 1;
  }
}
