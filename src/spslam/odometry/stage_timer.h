// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Where a frame's time goes. Times are reported, never acted on.
#pragma once

#include <chrono>

#include "spslam/odometry/track_result.h"

namespace spslam {

class StageTimer {
 public:
  explicit StageTimer(StageTimes& times) : times_(times) {}
  // What has passed since the last stage ended belongs to `stage`.
  void end(double StageTimes::*stage) {
    const auto now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    times_.*stage += seconds;
    times_.total += seconds;
    last_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;
  StageTimes& times_;
  Clock::time_point last_ = Clock::now();
};

}  // namespace spslam
