// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/odometry/motion_model.h"

namespace spslam {

SE3 MotionModel::predict(double timestamp) const {
  return SE3::exp((timestamp - last_time_) * velocity_) * last_;
}

void MotionModel::add(double timestamp, const SE3& camera_from_world) {
  if (has_pose_ && timestamp > last_time_)
    velocity_ = (camera_from_world * last_.inverse()).log() / (timestamp - last_time_);
  last_ = camera_from_world;
  last_time_ = timestamp;
  has_pose_ = true;
}

}  // namespace spslam
