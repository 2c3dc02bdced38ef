// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The boat's way over the water: a planar curve by arc length, twice differentiable, that can be prolonged
// past both ends.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "spslam/sim/scene_options.h"

namespace spslam::sim {

// 0 below 0, 1 above 1, with two continuous derivatives between.
double smooth_step(double x);

class Way {
 public:
  Way(const PathOptions& options, std::uint32_t seed);

  double heading(double s) const;            // rad, anticlockwise from world x, at arc length s in m
  Eigen::Vector2d position(double s) const;  // m, valid from -kPrologue to length + kEpilogue
  double length() const { return options_.length; }
  bool closed() const { return options_.shape == PathShape::kLoop; }
  double round_length() const;  // arc length of one round of a closed way
  double turn_start() const;    // arc length where the half turn begins (shape turn)
  double turn_length() const;

  static constexpr double kPrologue = 80, kEpilogue = 260;

 private:
  PathOptions options_;
  double phase_[2];
  std::vector<Eigen::Vector2d> points_;  // every kStep from -kPrologue
  static constexpr double kStep = 0.1;
};

}  // namespace spslam::sim
