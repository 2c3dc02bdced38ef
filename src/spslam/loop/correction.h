// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// What a closed loop changes. It is found on copies, without any lock, and applied by the map's single
// writer.
#pragma once

#include <functional>
#include <optional>

#include "spslam/loop/two_view.h"
#include "spslam/map/map.h"

namespace spslam {

// A verified loop.
struct LoopClosure {
  LoopEdge edge;
  Matrix6d covariance = Matrix6d::Identity();  // of a left perturbation of newer_from_older, (m, rad)
  // What it rests on, by pixels of keyframes: the older side's keyframe, where it saw it, and where the newer
  // one did; features' own places, so that landmarks are found again by them.
  struct Pair {
    KeyframeId seen_by;
    Eigen::Vector2f seen_at = Eigen::Vector2f::Zero();  // px
    int feature = 0;                                    // of the newer keyframe
  };
  std::vector<Pair> pairs;
};

// Holds in the camera of that host: culling may give the landmark another one while the correction is made.
struct CorrectedDepth {
  LandmarkId landmark;
  KeyframeId host;
  double inverse_depth = 0;  // 1/m
};

struct MapCorrection {
  std::vector<std::pair<KeyframeId, SE3>> camera_from_world;  // ascending
  std::vector<CorrectedDepth> inverse_depths;                 // ascending
  std::vector<std::pair<LandmarkId, LandmarkId>> fused;       // kept, gone
  std::vector<std::pair<KeyframeId, Sighting>> sightings;     // new ones
  std::optional<LoopEdge> edge;

  bool empty() const { return camera_from_world.empty() && !edge; }
};

// Keyframes that the map got while the correction was made move rigidly with the newest one in it.
void extend(MapCorrection& correction, const Map& map);

// Writes it to what is still there: poses, inverse depths, then fusions and sightings, then the edge. What is
// not finite is left as it was.
void apply(const MapCorrection& correction, Map& map);

}  // namespace spslam
