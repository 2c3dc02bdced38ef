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
  for (const Covisible& other : map.covisible(limit)) {
    const Keyframe& keyframe = *map.find(other.id);
    if (other.id >= limit || !keyframe.parent.valid() || ends_a_loop(map, other.id)) continue;
    if (is_redundant(map, keyframe, options) && map.erase(other.id)) gone.push_back(other.id);
  }
  return gone;
}

}  // namespace spslam
