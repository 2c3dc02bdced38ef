// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Trajectories whose errors are known in advance.
#pragma once

#include <cmath>
#include <functional>
#include <string>

#include "spslam/base/error.h"
#include "spslam/base/random.h"
#include "spslam/eval/evaluation.h"

namespace spslam::testing_eval {

// A camera on a figure of eight in its own first frame (x right, y down, z forward), with a little heave,
// roll and pitch as a boat has them. 10 Hz, about 1 m/s.
inline Trajectory figure_of_eight(int count) {
  Trajectory poses;
  for (int i = 0; i < count; ++i) {
    const double t = 0.1 * i, a = 0.05 * t;
    const Eigen::Vector3d p(20 * std::sin(2 * a), 0.1 * std::sin(1.3 * t), 30 * std::sin(a));
    const Eigen::Vector3d turn(0.03 * std::sin(1.1 * t), 1.5 * a, 0.05 * std::sin(0.9 * t));
    poses.push_back({t, {so3_exp(turn), p}});
  }
  return poses;
}

// Along z at 1 m/s, 10 Hz, exactly straight.
inline Trajectory straight_line(int count) {
  Trajectory poses;
  for (int i = 0; i < count; ++i) poses.push_back({0.1 * i, {Eigen::Matrix3d::Identity(), {0, 0, 0.1 * i}}});
  return poses;
}

inline Trajectory transformed(const Trajectory& trajectory, const SE3& to_from_world, double scale = 1) {
  Trajectory moved;
  for (const StampedPose& pose : trajectory) {
    SE3 scaled = pose.world_from_camera;
    scaled.translation *= scale;
    moved.push_back({pose.timestamp, to_from_world * scaled});
  }
  return moved;
}

inline SE3 some_motion() {
  return {so3_exp({0.4, -1.1, 0.7}), {12, -5, 80}};
}

inline std::vector<AssociatedPose> paired(const Trajectory& estimate, const Trajectory& truth) {
  return associate(estimate, truth, {});
}

template <class E>
std::string message_of(const std::function<void()>& f) {
  try {
    f();
  } catch (const E& error) {
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace spslam::testing_eval
