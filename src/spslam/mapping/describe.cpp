// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/mapping/describe.h"

namespace spslam {
namespace {

struct Depth {
  float x, y;  // px
  float inverse_depth, information;
};

// Of the keyframe's sightings: where, and the inverse depth in this keyframe's camera.
std::vector<Depth> depths_of(const Map& map, const Keyframe& keyframe) {
  std::vector<Depth> out;
  for (const Sighting& sighting : keyframe.sightings) {
    const Landmark& landmark = *map.find(sighting.landmark);
    const Keyframe* host = map.find(landmark.host);
    if (!host) continue;
    const SE3 motion = keyframe.camera_from_world * host->camera_from_world.inverse();
    const double ratio =
        (motion.rotation * landmark.bearing + landmark.inverse_depth * motion.translation).z();
    if (!(ratio > 1e-3)) continue;
    out.push_back({static_cast<float>(sighting.measured.x()), static_cast<float>(sighting.measured.y()),
                   static_cast<float>(landmark.inverse_depth / ratio),
                   static_cast<float>(landmark.information * ratio * ratio)});
  }
  return out;
}

// The nearest of the depths within a radius, or null. Depths lie in columns of the image, by x.
const Depth* nearest_depth(const std::vector<Depth>& by_x, const Keypoint& at, float radius) {
  const Depth* best = nullptr;
  float distance = radius * radius;
  auto it = std::lower_bound(by_x.begin(), by_x.end(), at.x - radius,
                             [](const Depth& depth, float x) { return depth.x < x; });
  for (; it != by_x.end() && it->x <= at.x + radius; ++it) {
    const float d = (it->x - at.x) * (it->x - at.x) + (it->y - at.y) * (it->y - at.y);
    if (d <= distance) distance = d, best = &*it;
  }
  return best;
}

}  // namespace

std::shared_ptr<const KeyframeFeatures> describe(const Map& map, const Keyframe& keyframe,
                                                 OrbExtractor& extractor, const DescribeOptions& options) {
  if (keyframe.left.empty()) return nullptr;
  auto out = std::make_shared<KeyframeFeatures>();
  std::vector<Depth> depths = depths_of(map, keyframe);
  extractor.set_image(keyframe.left.level(0));
  std::vector<cv::Point2f> seen;
  for (const Depth& depth : depths) {
    if (static_cast<int>(out->keypoints.size()) >= options.count) break;
    out->keypoints.push_back({depth.x, depth.y, 0, 0, 0});
    seen.emplace_back(depth.x, depth.y);
  }
  extractor.orient(out->keypoints);
  OrbRequest rest;
  rest.count = options.count - static_cast<int>(out->keypoints.size());
  if (rest.count > 0)
    for (const Keypoint& corner : extractor.detect(rest))
      if (corner.octave > 0) out->keypoints.push_back(corner);
  out->descriptors = extractor.describe(out->keypoints);
  std::sort(depths.begin(), depths.end(), [](const Depth& a, const Depth& b) { return a.x < b.x; });
  for (const Keypoint& keypoint : out->keypoints) {
    const Depth* depth = nearest_depth(depths, keypoint, static_cast<float>(options.depth_radius));
    out->inverse_depths.push_back(depth ? depth->inverse_depth : 0);
    out->information.push_back(depth ? depth->information : 0);
  }
  return out;
}

}  // namespace spslam
