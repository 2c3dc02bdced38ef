// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The sky as seen from anywhere in the scene: a gradient, clouds and the sun. Radiance 1 is a clear horizon.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "spslam/sim/scene_options.h"

namespace spslam::sim {

class Sky {
 public:
  Sky(const SkyOptions& options, std::uint32_t seed);

  // Without the sun's disc. `direction` of any length; below the horizon it counts as the horizon.
  float radiance(const Eigen::Vector3f& direction) const;
  // The sun's image in a ripple: its disc widened by what is too small to be modelled as waves. Unit
  // direction.
  float glint(const Eigen::Vector3f& direction) const;

  const Eigen::Vector3f& sun_direction() const { return sun_direction_; }
  float sun() const { return sun_; }          // radiance of a white surface facing the sun
  float ambient() const { return ambient_; }  // of one under the open sky alone
  float horizon() const { return horizon_; }  // mean radiance there, which is what fog looks like

 private:
  static constexpr int kSize = 1024;
  // Stereographic: (x, y) / (1 + z) of a unit direction, the horizon on the unit circle; no trigonometry to
  // look it up.
  std::vector<float> dome_;
  Eigen::Vector3f sun_direction_;
  float sun_ = 0, ambient_ = 0, horizon_ = 0;
};

}  // namespace spslam::sim
