// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// A camera's pose and what is known of it. The error is a left perturbation, T_measured = exp(xi) T_true with
// T = camera_from_world, so the covariance is in the camera's own axes, (m, rad). (Sola, Deray, Atchuthan, "A
// micro Lie theory", 2018.)
#pragma once

#include "spslam/base/se3.h"

namespace spslam {

struct UncertainPose {
  SE3 camera_from_world;
  Matrix6d covariance = Matrix6d::Identity();

  // Root of the sum of the three variances, m.
  double position_sigma() const { return std::sqrt(covariance.topLeftCorner<3, 3>().trace()); }
};

// 0.1 % of a chi-square with 6 degrees of freedom are above it.
inline constexpr double kPoseGate = 22.46;

// After the camera has moved; `noise`: of the motion, of a left perturbation of it.
UncertainPose moved(const UncertainPose& pose, const SE3& present_from_before, const Matrix6d& noise);

// How far the two are apart by their covariances and `more`: the squared Mahalanobis distance.
double squared_distance(const UncertainPose& a, const UncertainPose& b,
                        const Matrix6d& more = Matrix6d::Zero());

// Both together, if their errors are independent: Kalman's update of the one by the other.
UncertainPose fused(const UncertainPose& a, const UncertainPose& b);

}  // namespace spslam
