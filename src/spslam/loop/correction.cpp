// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/loop/correction.h"

namespace spslam {

void extend(MapCorrection& correction, const Map& map) {
  auto& poses = correction.camera_from_world;
  // The newest one may have been erased; then the newest that is still there leads.
  auto lead = poses.rbegin();
  while (lead != poses.rend() && !map.find(lead->first)) ++lead;
  if (lead == poses.rend()) return;
  const SE3 new_from_old_world =
      lead->second.inverse() * map.find(lead->first)->camera_from_world;  // both hold for the same camera
  const KeyframeId last = poses.back().first;
  for (auto it = map.keyframes().upper_bound(last); it != map.keyframes().end(); ++it)
    poses.emplace_back(it->first, (it->second.camera_from_world * new_from_old_world.inverse()).normalized());
}

void apply(const MapCorrection& correction, Map& map) {
  for (const auto& [id, camera_from_world] : correction.camera_from_world)
    if (camera_from_world.is_finite()) map.set_pose(id, camera_from_world);
  for (const CorrectedDepth& depth : correction.inverse_depths) {
    const Landmark* landmark = map.find(depth.landmark);
    if (landmark && landmark->host == depth.host && std::isfinite(depth.inverse_depth))
      map.set_estimate(depth.landmark, depth.inverse_depth, landmark->information);
  }
  for (const auto& [kept, gone] : correction.fused) map.fuse(map.resolve(kept), map.resolve(gone));
  for (auto [id, sighting] : correction.sightings) {
    sighting.landmark = map.resolve(sighting.landmark);
    const Keyframe* keyframe = map.find(id);
    if (keyframe && map.find(sighting.landmark) && !find_sighting(*keyframe, sighting.landmark))
      map.set_sighting(id, sighting);
  }
  const std::optional<LoopEdge>& edge = correction.edge;
  if (edge && map.find(edge->older) && map.find(edge->newer)) map.add(*edge);
}

}  // namespace spslam
