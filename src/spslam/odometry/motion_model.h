// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Constant velocity, scaled by time: what is expected of a frame before it is looked at (paper 3.1.4).
#pragma once

#include <optional>

#include "spslam/base/se3.h"

namespace spslam {

class MotionModel {
 public:
  // The pose that the last two imply at a time; the last one where there is only one.
  SE3 predict(double timestamp) const;
  void add(double timestamp, const SE3& camera_from_world);
  // Stands still here: what was known of the velocity is forgotten.
  void restart(double timestamp, const SE3& camera_from_world) {
    has_pose_ = false;
    velocity_.setZero();
    add(timestamp, camera_from_world);
  }
  void correct(const SE3& camera_from_world) { last_ = camera_from_world; }
  double last_timestamp() const { return last_time_; }
  const SE3& last_pose() const { return last_; }

 private:
  SE3 last_;
  double last_time_ = 0;
  Vector6d velocity_ = Vector6d::Zero();  // twist per second, left: T(t + dt) = exp(dt v) T(t)
  bool has_pose_ = false;
};

}  // namespace spslam
