// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/optimize/problem.h"

namespace spslam {

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

}  // namespace spslam
