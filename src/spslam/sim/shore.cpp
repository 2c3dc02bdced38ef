// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/sim/shore.h"

#include <algorithm>
#include <cmath>

#include "spslam/base/random.h"
#include "spslam/sim/hash.h"

namespace spslam::sim {

std::vector<ChannelPoint> channel_middle(const SceneDescription& scene, const Way& way, double step) {
  std::vector<ChannelPoint> points;
  if (way.closed()) {
    const int count = static_cast<int>(std::ceil(way.round_length() / step));
    for (int i = 0; i <= count; ++i) {
      const double s = way.round_length() * i / count;
      points.push_back({way.position(s), way.heading(s), s});
    }
  } else if (scene.path.shape == PathShape::kTurn) {
    const double middle = 0.5 * way.position(way.length()).y();
    for (double s = -60; s < 0.5 * way.length() + 160; s += step) points.push_back({{s, middle}, 0, s});
  } else {
    for (double s = -60; s < way.length() + 220; s += step)
      points.push_back({way.position(s), way.heading(s), s});
  }
  return points;
}

namespace {

double clearance(const SceneDescription& scene, const Way& way, double s, double distance) {
  if (way.closed()) return distance;
  const double end = scene.path.shape == PathShape::kTurn ? 0.5 * way.length() : way.length();
  return std::hypot(distance, std::max({0.0, -s - 4, s - end}));
}

Shoreline make_shoreline(const SceneDescription& scene, const Way& way, const BankOptions& bank, double side,
                         std::uint32_t seed) {
  Shoreline shore{bank, seed, {}};
  Random random(seed);
  const double phase[2] = {random.uniform(0, 2 * M_PI), random.uniform(0, 2 * M_PI)};
  const double round = way.closed() ? way.round_length() : 94;
  const double waves[2] = {std::max(1.0, std::round(round / 47)) / round,
                           std::max(2.0, std::round(round / 17)) / round};
  double along = 0;
  for (const ChannelPoint& middle : channel_middle(scene, way, Shoreline::kStep)) {
    const double swing = 0.7 * std::sin(2 * M_PI * waves[0] * middle.s + phase[0]) +
                         0.3 * std::sin(2 * M_PI * waves[1] * middle.s + phase[1]);
    const double distance = bank.distance * (1 + bank.distance_variation * swing);
    const Eigen::Vector2d outward =
        side * Eigen::Vector2d(-std::sin(middle.heading), std::cos(middle.heading));
    const Eigen::Vector2d edge = middle.position + outward * distance;
    if (!shore.points.empty()) along += (edge - shore.points.back().edge).norm();
    shore.points.push_back({edge, outward, along, clearance(scene, way, middle.s, distance)});
  }
  return shore;
}

}  // namespace

std::vector<Shoreline> make_shorelines(const SceneDescription& scene, const Way& way, std::uint32_t seed) {
  std::vector<Shoreline> shores;
  const bool lake = scene.shore.shape == ShoreShape::kLake;
  if (!lake && scene.shore.left.kind != BankKind::kNone)
    shores.push_back(make_shoreline(scene, way, scene.shore.left, 1, seed + 31));
  if (scene.shore.right.kind != BankKind::kNone)
    shores.push_back(make_shoreline(scene, way, scene.shore.right, -1, seed + 37));
  return shores;
}

ShorePoint Shoreline::at(double s) const {
  const auto after = std::lower_bound(points.begin() + 1, points.end() - 1, s,
                                      [](const ShorePoint& point, double value) { return point.s < value; });
  const ShorePoint &a = *(after - 1), &b = *after;
  const double x = std::clamp((s - a.s) / std::max(1e-9, b.s - a.s), 0.0, 1.0);
  return {a.edge + x * (b.edge - a.edge), (a.outward + x * (b.outward - a.outward)).normalized(), s,
          a.clearance + x * (b.clearance - a.clearance)};
}

BankKind Shoreline::kind(double s) const {
  if (bank.kind != BankKind::kMixed) return bank.kind;
  constexpr BankKind kinds[] = {BankKind::kRubble, BankKind::kMasonry, BankKind::kTimber, BankKind::kEarth,
                                BankKind::kBrick};
  const auto section = static_cast<std::uint32_t>(std::max(0.0, s) / 28);
  return kinds[(mix(seed, 5) + section * 2 + mix(seed, section / 5) % 2) % 5];
}

}  // namespace spslam::sim
