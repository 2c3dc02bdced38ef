// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// What a frame's tracking says to the caller.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "spslam/base/ids.h"
#include "spslam/base/se3.h"
#include "spslam/odometry/keyframe_policy.h"

namespace spslam {

enum class TrackStatus {
  kInitializing,  // no usable frame yet
  kTracking,      // the pose was measured
  kCoasting,      // carried by constant velocity; the covariance grows
  kLost           // coasted too long, or the place has never been connected since: dead reckoning only
};

inline std::span<const char* const> option_names(TrackStatus) {
  static constexpr const char* names[] = {"initializing", "tracking", "coasting", "lost"};
  return names;
}

// Seconds spent in each stage of the frame.
struct StageTimes {
  double front_end = 0, follow = 0, motion = 0, window = 0, keyframe = 0, total = 0;
};

struct TrackResult {
  static constexpr double kLostVariance = 1e6;  // m^2 and rad^2: nothing is known

  FrameId frame;
  double timestamp = 0;  // s
  TrackStatus status = TrackStatus::kInitializing;
  std::string reason;  // why the status is not tracking, or what was special; "" otherwise
  // World is the first usable frame's left camera. Later corrections change the past: Slam::trajectory() has
  // them.
  SE3 world_from_camera;
  // Of a perturbation (translation m, rotation rad) in the camera's own axes: T_measured = T_true exp(xi). Of
  // the motion against the local map, not of the drift since the start; kLostVariance
  // when lost.
  Matrix6d covariance = Matrix6d::Identity();
  double entropy = 0;      // nats, equation (10)
  double far_weight = 1;   // w_t, equation (8)
  int followed = 0;        // landmarks looked for
  int near = 0, far = 0;   // found ones by region
  int with_disparity = 0;  // found ones whose disparity was measured
  int on_trial = 0;        // found ones that say nothing yet (trial.h)
  int moving = 0;          // found ones that turned out to move by themselves (movers.h), and are let go
  int inliers = 0;         // found ones that agree with the pose
  KeyframeDecision keyframe;
  KeyframeId keyframe_id;  // valid if the frame became one
  StageTimes seconds;
};

}  // namespace spslam
