// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/mapping/culling.h"

namespace spslam {
namespace {

// The keyframe `steps` before this one, or null.
const Keyframe* before(const Map& map, KeyframeId id, int steps) {
  auto it = map.keyframes().find(id);
  for (; it != map.keyframes().end() && steps > 0; --steps) {
    if (it == map.keyframes().begin()) return nullptr;
    --it;
  }
  return it == map.keyframes().end() ? nullptr : &it->second;
}

bool is_redundant(const Map& map, const Keyframe& keyframe, const CullingOptions& options) {
  int redundant = 0;
  for (const Sighting& sighting : keyframe.sightings)
    redundant += static_cast<int>(map.observers(sighting.landmark).size()) - 1 >= options.redundant_views;
  return redundant > options.redundant_share * static_cast<double>(keyframe.sightings.size());
}

// How differently two keyframes see what both see: the angle between the two rays to a landmark, in rad, or
// the logarithm of the ratio of its distances, whichever is more; three quarters of the landmarks have less.
double change_of_view(const Map& map, const Keyframe& a, const Keyframe& b) {
  std::vector<double> changes;
  const Eigen::Vector3d centre_a = a.camera_from_world.inverse().translation,
                        centre_b = b.camera_from_world.inverse().translation;
  for (const Sighting& sighting : a.sightings) {
    if (!find_sighting(b, sighting.landmark)) continue;
    const Landmark& landmark = *map.find(sighting.landmark);
    const SE3 world_from_host = map.find(landmark.host)->camera_from_world.inverse();
    // Scaled by the inverse depth, so that a point at infinity is no exception.
    const Eigen::Vector3d ray = world_from_host.rotation * landmark.bearing;
    const auto seen_from = [&](const Eigen::Vector3d& centre) -> Eigen::Vector3d {
      return ray + landmark.inverse_depth * (world_from_host.translation - centre);
    };
    const Eigen::Vector3d from_a = seen_from(centre_a), from_b = seen_from(centre_b);
    changes.push_back(std::max(std::atan2(from_a.cross(from_b).norm(), from_a.dot(from_b)),
                               std::abs(std::log(from_a.norm() / from_b.norm()))));
  }
  if (changes.empty()) return M_PI;
  const auto at = changes.begin() + static_cast<std::ptrdiff_t>(changes.size() * 3 / 4);
  std::nth_element(changes.begin(), at, changes.end());
  return *at;
}

// Whether a keyframe of an earlier visit sees the same place from nearly the same side.
bool was_here_before(const Map& map, const Keyframe& keyframe, const CullingOptions& options) {
  for (const Covisible& other : map.covisible(keyframe.id, options.revisit_shared)) {
    if (other.id.value + options.revisit_gap > keyframe.id.value) continue;
    const Keyframe& before = *map.find(other.id);
    const Eigen::Matrix3d turn =
        keyframe.camera_from_world.rotation * before.camera_from_world.rotation.transpose();
    if (so3_log(turn).norm() * 180 / M_PI > options.revisit_rotation) continue;
    if (change_of_view(map, keyframe, before) < options.revisit_change) return true;
  }
  return false;
}

bool ends_a_loop(const Map& map, KeyframeId id) {
  return std::any_of(map.loops().begin(), map.loops().end(),
                     [&](const LoopEdge& edge) { return edge.older == id || edge.newer == id; });
}

}  // namespace

int cull_landmarks(Map& map, KeyframeId newest, const CullingOptions& options) {
  const Keyframe* tried = before(map, newest, options.landmark_trial);
  if (!options.enabled || !tried) return 0;
  std::vector<LandmarkId> gone;
  for (const Sighting& sighting : tried->sightings)
    if (map.find(sighting.landmark)->host == tried->id &&
        static_cast<int>(map.observers(sighting.landmark).size()) < options.landmark_views)
      gone.push_back(sighting.landmark);
  for (const LandmarkId id : gone) map.erase(id);
  return static_cast<int>(gone.size());
}

std::vector<KeyframeId> cull_keyframes(Map& map, KeyframeId newest, const CullingOptions& options) {
  std::vector<KeyframeId> gone;
  const Keyframe* last_kept = before(map, newest, options.keep_newest - 1);
  if (!options.enabled || !last_kept) return gone;
  const KeyframeId limit = last_kept->id;
  const auto may_go = [&](const Keyframe& keyframe) {
    return keyframe.parent.valid() && !ends_a_loop(map, keyframe.id);
  };
  if (may_go(*last_kept) && was_here_before(map, *last_kept, options) && map.erase(limit)) return {limit};
  for (const Covisible& other : map.covisible(limit)) {
    const Keyframe& keyframe = *map.find(other.id);
    if (other.id >= limit || !may_go(keyframe)) continue;
    if (is_redundant(map, keyframe, options) && map.erase(other.id)) gone.push_back(other.id);
  }
  return gone;
}

}  // namespace spslam
