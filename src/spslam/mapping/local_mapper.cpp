// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/mapping/local_mapper.h"

namespace spslam {

LocalMapView LocalMapper::insert(KeyframeProposal proposal) {
  for (Landmark& landmark : proposal.new_landmarks) map_.add(std::move(landmark));
  for (const Landmark& landmark : proposal.known_landmarks)
    map_.set_estimate(landmark.id, landmark.inverse_depth, landmark.information);
  // The patches of the keyframe stay with whoever still follows them; a map needs none, and would grow by an
  // image each.
  proposal.keyframe.left = {};
  proposal.keyframe.right = {};
  map_.add(std::move(proposal.keyframe));
  ++revision_;
  return view();
}

LocalMapView LocalMapper::view() const {
  LocalMapView out;
  out.revision = revision_;
  int count = options_.view_keyframes;
  for (auto it = map_.keyframes().rbegin(); it != map_.keyframes().rend() && count-- > 0; ++it) {
    out.keyframes.push_back(it->second);
    for (const Sighting& sighting : it->second.sightings)
      if (const Landmark* landmark = map_.find(sighting.landmark); landmark && landmark->host == it->first)
        out.landmarks.push_back(*landmark);
  }
  return out;
}

}  // namespace spslam
