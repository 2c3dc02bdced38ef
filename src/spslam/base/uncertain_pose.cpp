// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/base/uncertain_pose.h"

#include <Eigen/Cholesky>

namespace spslam {

UncertainPose moved(const UncertainPose& pose, const SE3& present_from_before, const Matrix6d& noise) {
  const Matrix6d adjoint = present_from_before.adjoint();
  return {(present_from_before * pose.camera_from_world).normalized(),
          adjoint * pose.covariance * adjoint.transpose() + noise};
}

double squared_distance(const UncertainPose& a, const UncertainPose& b, const Matrix6d& more) {
  const Vector6d off = (b.camera_from_world * a.camera_from_world.inverse()).log();
  return off.dot(Matrix6d(a.covariance + b.covariance + more).ldlt().solve(off));
}

UncertainPose fused(const UncertainPose& a, const UncertainPose& b) {
  const Vector6d off = (b.camera_from_world * a.camera_from_world.inverse()).log();
  const Matrix6d gain = Matrix6d(a.covariance + b.covariance).ldlt().solve(a.covariance).transpose();
  // Joseph's form stays symmetric and positive.
  const Matrix6d rest = Matrix6d::Identity() - gain;
  return {(SE3::exp(gain * off) * a.camera_from_world).normalized(),
          rest * a.covariance * rest.transpose() + gain * b.covariance * gain.transpose()};
}

}  // namespace spslam
