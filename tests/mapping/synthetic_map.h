// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// A synthetic world as a map: one keyframe a camera, whose own image is left out.
#pragma once

#include "spslam/map/map.h"
#include "spslam/optimize/synthetic.h"

namespace spslam::test {

struct MapWorld {
  Problem truth;
  std::vector<char> is_outlier;  // one an observation of the truth
  Map map;                       // true poses and inverse depths, noisy sightings
};

inline Landmark landmark_of(const Problem& truth, int l) {
  const LandmarkVariable& variable = truth.landmarks[static_cast<std::size_t>(l)];
  Landmark landmark;
  landmark.id = {l};
  landmark.host = {variable.host};
  landmark.bearing = variable.bearing;
  landmark.pixel = truth.rig.project(variable.bearing).cast<float>();
  landmark.inverse_depth = variable.inverse_depth;
  return landmark;
}

inline MapWorld make_map_world(const SyntheticOptions& options) {
  SyntheticWorld world = make_synthetic_world(options);
  MapWorld out{world.truth, world.is_outlier, {}};
  for (int l = 0; l < static_cast<int>(out.truth.landmarks.size()); ++l)
    out.map.add(landmark_of(out.truth, l));
  for (int k = 0; k < static_cast<int>(out.truth.poses.size()); ++k) {
    Keyframe keyframe;
    keyframe.id = {k};
    keyframe.frame = {10 * k};
    keyframe.timestamp = k;
    keyframe.camera_from_world = out.truth.poses[static_cast<std::size_t>(k)].camera_from_world;
    for (const Observation& z : out.truth.observations)
      if (z.pose == k) keyframe.sightings.push_back({{z.landmark}, z.measured, z.inverse_sigma, z.weight});
    out.map.add(std::move(keyframe));
  }
  return out;
}

// Moves all poses but the first `held` and all inverse depths away from the truth.
inline void disturb(Map& map, int held, double translation, double rotation, double inverse_depth) {
  int n = 0;
  for (const auto& [id, keyframe] : std::map(map.keyframes())) {
    const double sign = n % 2 == 0 ? 1 : -1;
    Vector6d xi;
    xi << sign * translation, -translation, sign * translation, rotation, -sign * rotation, rotation;
    if (n++ >= held) map.set_pose(id, SE3::exp(xi) * keyframe.camera_from_world);
  }
  for (const auto& [id, landmark] : std::map(map.landmarks()))
    map.set_estimate(id, landmark.inverse_depth + (n++ % 2 == 0 ? 1 : -1) * inverse_depth, 0);
}

}  // namespace spslam::test
