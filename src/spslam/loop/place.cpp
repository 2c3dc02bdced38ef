// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/loop/place.h"

#include "spslam/map/feature_depths.h"
#include "spslam/map/moved_point.h"

namespace spslam {
namespace {

constexpr double kLeastRatio = 0.2;  // of depths in the place's camera to those in the source's
constexpr double kWidest = 3;        // tangent of the direction from the optical axis

bool is_finite(const Keypoint& keypoint, const FeatureDepth& depth) {
  return std::isfinite(keypoint.x) && std::isfinite(keypoint.y) && std::isfinite(keypoint.angle) &&
         std::isfinite(depth.inverse_depth) && std::isfinite(depth.information);
}

// The depths that the features came with.
std::vector<FeatureDepth> own_depths(const KeyframeFeatures& features) {
  std::vector<FeatureDepth> out;
  out.reserve(features.size());
  for (std::size_t i = 0; i < features.size(); ++i)
    out.push_back({features.inverse_depths[i], features.information[i]});
  return out;
}

// Those of the landmarks as the map knows them now, which have been seen more often since.
std::vector<FeatureDepth> present_depths(const Map& map, const Keyframe& keyframe) {
  std::vector<FeatureDepth> out = own_depths(*keyframe.features);
  const std::vector<FeatureDepth> present = feature_depths(map, keyframe, keyframe.features->keypoints);
  for (std::size_t i = 0; i < out.size(); ++i)
    if (present[i].information > 0) out[i] = present[i];
  return out;
}

// Adds the features of a source, seen from the place, with motion = place_from_source.
void add_source(const StereoRig& rig, KeyframeId id, std::shared_ptr<const KeyframeFeatures> features,
                const std::vector<FeatureDepth>& depths, const SE3& motion, Place& place) {
  const bool is_own = place.sources.empty();
  PlaceSource source{id, std::move(features), {}};
  source.point.assign(source.features->size(), -1);
  for (std::size_t i = 0; i < source.features->size(); ++i) {
    const Keypoint& keypoint = source.features->keypoints[i];
    const FeatureDepth& depth = depths[i];
    if (!is_finite(keypoint, depth)) continue;
    const bool is_known = depth.information > 0;
    if (!is_known && !is_own) continue;
    PlacePoint point{rig.bearing(keypoint.x, keypoint.y), is_known ? depth.inverse_depth : 0,
                     is_known ? depth.information : 0, static_cast<int>(place.sources.size()),
                     static_cast<int>(i)};
    if (!is_own) {
      const MovedPoint moved = move_point(motion, point.bearing, point.inverse_depth);
      if (!(moved.depth_ratio > kLeastRatio) || moved.bearing.head<2>().norm() > kWidest) continue;
      point.bearing = moved.bearing;
      point.inverse_depth = moved.inverse_depth;
      point.information *= moved.information_gain;
    }
    source.point[i] = static_cast<int>(place.points.size());
    place.points.push_back(point);
  }
  place.sources.push_back(std::move(source));
}

}  // namespace

Place place_of(const StereoRig& rig, KeyframeId id, std::shared_ptr<const KeyframeFeatures> features) {
  Place place;
  place.id = id;
  if (!features) return place;
  const std::vector<FeatureDepth> depths = own_depths(*features);
  add_source(rig, id, std::move(features), depths, SE3{}, place);
  return place;
}

Place place_of(const Map& map, const StereoRig& rig, KeyframeId id, int neighbours) {
  const Keyframe* keyframe = map.find(id);
  if (!keyframe || !keyframe->features) return {id, {}, {}};
  Place place;
  place.id = id;
  add_source(rig, id, keyframe->features, present_depths(map, *keyframe), SE3{}, place);
  for (const Covisible& near : map.covisible(id)) {
    if (static_cast<int>(place.sources.size()) > neighbours) break;
    const Keyframe& other = *map.find(near.id);
    const SE3 motion = keyframe->camera_from_world * other.camera_from_world.inverse();
    if (other.features && motion.is_finite())
      add_source(rig, near.id, other.features, present_depths(map, other), motion, place);
  }
  return place;
}

}  // namespace spslam
