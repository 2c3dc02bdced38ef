// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// A point that is known by its direction and inverse depth in one camera, as another one has it.
#pragma once

#include <algorithm>

#include "spslam/base/se3.h"

namespace spslam {

struct MovedPoint {
  Eigen::Vector3d bearing;  // (x, y, 1), if the depth ratio is positive
  double inverse_depth;     // 1/m along z
  double depth_ratio;       // of the depth there to that here; zero or less: behind the camera
  double information_gain;  // ratio of what is known of the inverse depth there to what is here
};

// With x = R b + w t the inverse depth becomes w / x_z, and so its derivative by w is (R b)_z / x_z^2.
inline MovedPoint move_point(const SE3& there_from_here, const Eigen::Vector3d& bearing,
                             double inverse_depth) {
  constexpr double kLeast = 1e-3;  // where the direction is across the other axis, all depths are one
  const Eigen::Vector3d turned = there_from_here.rotation * bearing,
                        x = turned + inverse_depth * there_from_here.translation;
  const double z = x.z(), slope = std::max(std::abs(turned.z()), kLeast) / (z * z);
  return {x / z, inverse_depth / z, z, 1 / (slope * slope)};
}

}  // namespace spslam
