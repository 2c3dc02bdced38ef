// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Where the water ends: lines along the way, with the side that is land.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "spslam/sim/scene_description.h"
#include "spslam/sim/way.h"

namespace spslam::sim {

struct ShorePoint {
  Eigen::Vector2d edge;     // m, at the water's edge
  Eigen::Vector2d outward;  // unit vector towards the land
  double s = 0;             // m along the shore
  double clearance = 0;     // m to the boat's way, for choosing how fine to build
};

struct Shoreline {
  BankOptions bank;
  std::uint32_t seed = 0;
  std::vector<ShorePoint>
      points;  // every kStep or a little less; the last one closes the line if it is closed
  static constexpr double kStep = 0.5;

  double length() const { return points.back().s; }
  ShorePoint at(double s) const;
  // `mixed` banks change every 28 m.
  BankKind kind(double s) const;
};

std::vector<Shoreline> make_shorelines(const SceneDescription& scene, const Way& way, std::uint32_t seed);

// The middle line of the channel, straight through a half turn; points every `step` m.
struct ChannelPoint {
  Eigen::Vector2d position;
  double heading = 0;  // rad
  double s = 0;        // m
};
std::vector<ChannelPoint> channel_middle(const SceneDescription& scene, const Way& way, double step);

}  // namespace spslam::sim
