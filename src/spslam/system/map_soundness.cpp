// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/system/map_soundness.h"

#include <algorithm>
#include <cmath>

namespace spslam {
namespace {

template <class Id>
bool ascending(const std::vector<Id>& ids) {
  return std::adjacent_find(ids.begin(), ids.end(), [](Id a, Id b) { return a >= b; }) == ids.end();
}

template <class Id>
bool contains(const std::vector<Id>& ids, Id id) {
  return std::binary_search(ids.begin(), ids.end(), id);
}

bool is_amount(double value) {
  return std::isfinite(value) && value >= 0;
}

bool is_rigid(const SE3& motion) {
  constexpr double kDrift = 1e-6;  // that many products of rotations may leave; an estimate has 1e-12
  return motion.is_finite() && motion.rotation.determinant() > 0 &&
         (motion.rotation * motion.rotation.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <
             kDrift;
}

template <class Id>
std::string named(const char* what, Id id) {
  return std::string(what) + " " + std::to_string(id.value);
}

MapProblem problem_of(const Sighting& sighting) {
  if (!sighting.measured.allFinite()) return "a position that is not finite";
  for (const double inverse_sigma : sighting.inverse_sigma)
    if (!is_amount(inverse_sigma)) return "an error that is not a finite, positive number";
  if (!is_amount(sighting.weight)) return "a weight that is not a finite, positive number";
  return std::nullopt;
}

MapProblem problem_of(const KeyframeFeatures& features) {
  const std::size_t size = features.size();
  if (features.descriptors.size() != size || features.inverse_depths.size() != size ||
      features.information.size() != size)
    return "features whose lists differ in length";
  if (!(features.level_scale >= 1 && features.level_scale <= 4)) return "a pyramid whose scale is not 1 to 4";
  for (const Keypoint& keypoint : features.keypoints)
    for (const float value : {keypoint.x, keypoint.y, keypoint.angle, keypoint.response})
      if (!std::isfinite(value)) return "a feature at a place that is not finite";
  for (std::size_t i = 0; i < size; ++i)
    if (!std::isfinite(features.inverse_depths[i]) ||
        !is_amount(static_cast<double>(features.information[i])))
      return "a feature's depth that is not finite";
  return std::nullopt;
}

MapProblem problem_of_sightings(const Keyframe& keyframe, const MapIds& ids) {
  LandmarkId last;
  for (const Sighting& sighting : keyframe.sightings) {
    if (sighting.landmark <= last) return "sightings that are not in order";
    last = sighting.landmark;
    if (!contains(ids.landmarks, last))
      return "a sighting of " + named("landmark", last) + ", which is not in the map";
    if (const MapProblem problem = problem_of(sighting))
      return "a sighting of " + named("landmark", last) + " with " + *problem;
  }
  return std::nullopt;
}

}  // namespace

MapProblem problem_of(const MapIds& ids) {
  if (!ids.keyframes.empty() && !ids.keyframes.front().valid()) return "a keyframe has a negative id";
  if (!ids.landmarks.empty() && !ids.landmarks.front().valid()) return "a landmark has a negative id";
  if (!ascending(ids.keyframes)) return "keyframes are not in the order of their ids";
  if (!ascending(ids.landmarks)) return "landmarks are not in the order of their ids";
  return std::nullopt;
}

MapProblem problem_of(const Landmark& landmark, const MapIds& ids) {
  const std::string has = named("landmark", landmark.id) + " has ";
  if (!contains(ids.keyframes, landmark.host))
    return has + named("keyframe", landmark.host) + " as its host, which is not in the map";
  if (!landmark.pixel.allFinite() || !landmark.bearing.allFinite() ||
      std::abs(landmark.bearing.z() - 1) > 1e-9)
    return has + "a direction that is not finite, or not (x, y, 1)";
  if (!std::isfinite(landmark.inverse_depth) || !std::isfinite(landmark.stereo_inverse_depth))
    return has + "an inverse depth that is not finite";
  if (!is_amount(landmark.information) || !is_amount(landmark.stereo_information))
    return has + "an information that is not a finite, positive number";
  if (landmark.region > Region::kMirror) return has + "a region that is not known";
  return std::nullopt;
}

MapProblem problem_of(const Keyframe& keyframe, const MapIds& ids) {
  const std::string has = named("keyframe", keyframe.id) + " has ";
  if (!std::isfinite(keyframe.timestamp)) return has + "a time that is not finite";
  if (!is_rigid(keyframe.camera_from_world)) return has + "a pose that is not finite, or no rigid motion";
  if (const MapProblem problem = problem_of_sightings(keyframe, ids)) return has + *problem;
  if (!keyframe.features) return std::nullopt;
  if (const MapProblem problem = problem_of(*keyframe.features)) return has + *problem;
  return std::nullopt;
}

MapProblem problem_of(const LoopEdge& edge, const MapIds& ids) {
  for (const KeyframeId id : {edge.older, edge.newer})
    if (!contains(ids.keyframes, id))
      return "a loop ends at " + named("keyframe", id) + ", which is not in the map";
  if (edge.older == edge.newer) return "a loop goes from " + named("keyframe", edge.older) + " to itself";
  if (!is_rigid(edge.newer_from_older)) return "a loop's motion is not finite, or no rigid motion";
  if (!is_amount(edge.weight)) return "a loop's weight is not a finite, positive number";
  return std::nullopt;
}

MapProblem problem_of_tree(const std::vector<KeyframeId>& parents, const MapIds& ids) {
  const std::vector<KeyframeId>& keyframes = ids.keyframes;
  if (std::count_if(parents.begin(), parents.end(), [](KeyframeId id) { return !id.valid(); }) !=
      std::ptrdiff_t(!keyframes.empty()))
    return "not exactly one keyframe is without a parent in the spanning tree";
  // Each chain is followed until it meets one that is known to end at the root.
  std::vector<std::size_t> met_by(keyframes.size(), keyframes.size());
  for (std::size_t start = 0; start < keyframes.size(); ++start)
    for (std::size_t i = start; met_by[i] == keyframes.size();) {
      met_by[i] = start;
      if (!parents[i].valid()) break;
      const auto parent = std::lower_bound(keyframes.begin(), keyframes.end(), parents[i]);
      if (parent == keyframes.end() || *parent != parents[i])
        return named("keyframe", keyframes[i]) + " has " + named("keyframe", parents[i]) +
               " as its parent, which is not in the map";
      i = static_cast<std::size_t>(parent - keyframes.begin());
      if (met_by[i] == start)
        return named("keyframe", keyframes[i]) + " is its own ancestor in the spanning tree";
    }
  return std::nullopt;
}

}  // namespace spslam
