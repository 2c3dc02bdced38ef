// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/map/feature_depths.h"

#include <algorithm>

#include "spslam/map/moved_point.h"

namespace spslam {
namespace {

struct DepthAt {
  float x, y;  // px
  FeatureDepth depth;
};

// Of the keyframe's sightings, by x: where, and the inverse depth in this keyframe's camera.
std::vector<DepthAt> sighted_depths(const Map& map, const Keyframe& keyframe) {
  std::vector<DepthAt> out;
  for (const Sighting& sighting : keyframe.sightings) {
    const Landmark* landmark = map.find(sighting.landmark);
    const Keyframe* host = landmark ? map.find(landmark->host) : nullptr;
    if (!host) continue;
    const SE3 motion = keyframe.camera_from_world * host->camera_from_world.inverse();
    const MovedPoint point = move_point(motion, landmark->bearing, landmark->inverse_depth);
    if (!(point.depth_ratio > 1e-3)) continue;
    out.push_back({static_cast<float>(sighting.measured.x()),
                   static_cast<float>(sighting.measured.y()),
                   {point.inverse_depth, landmark->information * point.information_gain}});
  }
  std::sort(out.begin(), out.end(), [](const DepthAt& a, const DepthAt& b) { return a.x < b.x; });
  return out;
}

FeatureDepth nearest_depth(const std::vector<DepthAt>& by_x, const Keypoint& at) {
  FeatureDepth best;
  float distance = kDepthRadius * kDepthRadius;
  auto it = std::lower_bound(by_x.begin(), by_x.end(), at.x - kDepthRadius,
                             [](const DepthAt& depth, float x) { return depth.x < x; });
  for (; it != by_x.end() && it->x <= at.x + kDepthRadius; ++it) {
    const float d = (it->x - at.x) * (it->x - at.x) + (it->y - at.y) * (it->y - at.y);
    if (d <= distance) distance = d, best = it->depth;
  }
  return best;
}

}  // namespace

std::vector<FeatureDepth> feature_depths(const Map& map, const Keyframe& keyframe,
                                         std::span<const Keypoint> keypoints) {
  const std::vector<DepthAt> by_x = sighted_depths(map, keyframe);
  std::vector<FeatureDepth> out;
  out.reserve(keypoints.size());
  for (const Keypoint& keypoint : keypoints) out.push_back(nearest_depth(by_x, keypoint));
  return out;
}

}  // namespace spslam
