// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/loop/place.h"

namespace spslam {
namespace {

constexpr double kLeastRatio = 0.2;  // of depths in the place's camera to those in the source's
constexpr double kWidest = 3;        // tangent of the direction from the optical axis

bool is_finite(const Keypoint& keypoint, float inverse_depth, float information) {
  return std::isfinite(keypoint.x) && std::isfinite(keypoint.y) && std::isfinite(keypoint.angle) &&
         std::isfinite(inverse_depth) && std::isfinite(information);
}

// Adds the features of a source, seen from the place, with motion = place_from_source.
void add_source(const StereoRig& rig, KeyframeId id, std::shared_ptr<const KeyframeFeatures> features,
                const SE3& motion, Place& place) {
  const bool is_own = place.sources.empty();
  PlaceSource source{id, std::move(features), {}};
  source.point.assign(source.features->size(), -1);
  for (std::size_t i = 0; i < source.features->size(); ++i) {
    const Keypoint& keypoint = source.features->keypoints[i];
    const float inverse_depth = source.features->inverse_depths[i];
    const float information = source.features->information[i];
    if (!is_finite(keypoint, inverse_depth, information)) continue;
    const bool is_known = information > 0;
    if (!is_known && !is_own) continue;
    PlacePoint point{rig.bearing(keypoint.x, keypoint.y), is_known ? inverse_depth : 0,
                     is_known ? information : 0, static_cast<int>(place.sources.size()), static_cast<int>(i)};
    if (!is_own) {
      const Eigen::Vector3d x = motion.rotation * point.bearing + point.inverse_depth * motion.translation;
      if (!(x.z() > kLeastRatio) || x.head<2>().norm() > kWidest * x.z()) continue;
      point.bearing = x / x.z();
      point.inverse_depth /= x.z();
      point.information *= x.z() * x.z();
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
  if (features) add_source(rig, id, std::move(features), SE3{}, place);
  return place;
}

Place place_of(const Map& map, const StereoRig& rig, KeyframeId id, int neighbours) {
  const Keyframe* keyframe = map.find(id);
  if (!keyframe || !keyframe->features) return {id, {}, {}};
  Place place = place_of(rig, id, keyframe->features);
  for (const Covisible& near : map.covisible(id)) {
    if (static_cast<int>(place.sources.size()) > neighbours) break;
    const Keyframe& other = *map.find(near.id);
    const SE3 motion = keyframe->camera_from_world * other.camera_from_world.inverse();
    if (other.features && motion.is_finite()) add_source(rig, near.id, other.features, motion, place);
  }
  return place;
}

}  // namespace spslam
