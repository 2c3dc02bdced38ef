// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// A synthetic world as the tracker keeps it: one host keyframe (the first camera), its landmarks, and what
// the other cameras see of them.
#pragma once

#include "spslam/odometry/active_map.h"
#include "spslam/optimize/synthetic.h"

namespace spslam::test {

struct SyntheticMap {
  Problem truth;
  ActiveMap map;                                 // true poses and inverse depths, window empty
  std::vector<std::vector<Sighting>> sightings;  // one list a camera
};

inline Landmark landmark_of(const Problem& truth, std::size_t l) {
  const LandmarkVariable& variable = truth.landmarks[l];
  Landmark landmark;
  landmark.id = {static_cast<std::int64_t>(l)};
  landmark.host = {variable.host};
  landmark.bearing = variable.bearing;
  landmark.pixel = truth.rig.project(variable.bearing).cast<float>();
  landmark.inverse_depth = variable.inverse_depth;
  landmark.region = variable.inverse_depth == 0 ? Region::kFar : Region::kNear;
  return landmark;
}

inline SyntheticMap make_synthetic_map(const SyntheticOptions& options) {
  SyntheticMap out;
  out.truth = make_synthetic_world(options).truth;
  out.map.rig = out.truth.rig;
  for (int host = 0; host < options.hosts; ++host)
    out.map.hosts[{host}] = {{host}, {host}, 0.1 * host, out.truth.poses[host].camera_from_world, {}, {}};
  for (std::size_t l = 0; l < out.truth.landmarks.size(); ++l)
    out.map.landmarks.push_back({landmark_of(out.truth, l), 0, 0, 0});
  out.sightings.resize(out.truth.poses.size());
  for (const Observation& z : out.truth.observations)
    out.sightings[z.pose].push_back({{z.landmark}, z.measured, z.inverse_sigma, z.weight});
  return out;
}

// The window holds all cameras, each a frame; the hosts are its keyframes.
inline void fill_window(SyntheticMap& world) {
  for (std::size_t i = 0; i < world.truth.poses.size(); ++i) {
    const auto id = static_cast<std::int64_t>(i);
    const bool is_host = world.map.hosts.contains({id});
    world.map.window.push_back({{id},
                                0.1 * static_cast<double>(i),
                                world.truth.poses[i].camera_from_world,
                                is_host ? KeyframeId{id} : KeyframeId{},
                                world.sightings[i]});
  }
}

}  // namespace spslam::test
