// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/optimize/problem.h"

namespace spslam {
namespace {

// d(exp(ratio log T)) by a left perturbation of T: ratio J(ratio xi) J(xi)^-1 with xi = log T and J = I + ad
// / 2 + ..., to second order in xi; exact for a ratio of 1.
Matrix6d by_scaled_motion(const Vector6d& xi, double ratio) {
  Matrix6d ad = Matrix6d::Zero();
  ad.topLeftCorner<3, 3>() = ad.bottomRightCorner<3, 3>() = cross_matrix(xi.tail<3>());
  ad.topRightCorner<3, 3>() = cross_matrix(xi.head<3>());
  return ratio * (Matrix6d::Identity() + 0.5 * (ratio - 1) * ad);
}

}  // namespace

Linearized linearize(const StereoRig& rig, const SE3& camera_from_host, const Eigen::Vector3d& bearing,
                     double inverse_depth, const Eigen::Vector3d& measured) {
  Linearized out;
  const Eigen::Vector3d& t = camera_from_host.translation;
  const Eigen::Vector3d x = camera_from_host.rotation * bearing + inverse_depth * t;
  if (!(x.z() > 1e-6)) return out;
  out.in_front = true;
  const double fb = rig.disparity_per_inverse_depth(), iz = 1 / x.z();
  const double u = rig.fx * x.x() * iz, v = rig.fy * x.y() * iz, d = fb * inverse_depth * iz;
  out.residual = Eigen::Vector3d(u + rig.cx, v + rig.cy, d) - measured;
  out.by_point << rig.fx * iz, 0, -u * iz, 0, rig.fy * iz, -v * iz, 0, 0, -d * iz;
  for (int row = 0; row < 3; ++row) {
    const Eigen::Vector3d j = out.by_point.row(row);
    out.by_relative.row(row) << inverse_depth * j.transpose(), x.cross(j).transpose();
  }
  out.by_inverse_depth = out.by_point * t;
  out.by_inverse_depth.z() += fb * iz;
  return out;
}

LinearizedMotion linearize(const MotionPrior& prior, const SE3& first, const SE3& second, const SE3& third) {
  const SE3 before = second * first.inverse(), after = third * second.inverse();
  const Vector6d twist = before.log();
  const SE3 expected = SE3::exp(prior.time_ratio * twist);
  LinearizedMotion out;
  out.residual = (after * expected.inverse()).log();
  const Matrix6d by_before = -by_scaled_motion(twist, prior.time_ratio);
  out.by_pose[2] = Matrix6d::Identity();
  out.by_pose[1] = by_before - after.adjoint();
  out.by_pose[0] = -by_before * before.adjoint();
  return out;
}

}  // namespace spslam
