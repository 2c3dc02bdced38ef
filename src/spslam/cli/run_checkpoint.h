// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// What a run knows so far, on the disk, in case it is killed or the power goes.
#pragma once

#include <chrono>
#include <filesystem>

#include "spslam/system/slam.h"

namespace spslam {

class Checkpoint {
 public:
  // Each `seconds` at most (0: never): the trajectory to `trajectory` and, unless it is empty, the map to
  // `map`.
  Checkpoint(double seconds, std::filesystem::path trajectory, std::filesystem::path map);

  // Between two calls of track(). It reads, so the results are the same with it and without. The frames of
  // the tracker's window, and those of a gap that is still open, are not among what is known yet. What cannot
  // be written is said once, and tried again the next time.
  void write_if_due(const Slam& slam);

 private:
  using Clock = std::chrono::steady_clock;

  std::chrono::duration<double> interval_;
  std::filesystem::path trajectory_, map_;
  Clock::time_point last_ = Clock::now();  // when the last one was written
  std::chrono::duration<double> cost_{0};  // of writing it
  bool has_failed_ = false;
};

}  // namespace spslam
