// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/odometry/active_map.h"

#include <set>

#include "spslam/base/weighted_mean.h"

namespace spslam {
namespace {

// What one sighting says of its landmark's inverse depth while all poses stay where they are: the
// information, and the inverse depth that fits it best.
struct DepthEvidence {
  double information = 0, inverse_depth = 0;
};

DepthEvidence depth_evidence(const ActiveMap& map, const Landmark& landmark, const WindowFrame& frame,
                             const Sighting& sighting, const SolverOptions& options) {
  const Linearized at = linearize(map, landmark, frame.camera_from_world, sighting);
  if (!at.in_front) return {};
  const Eigen::Vector3d r = at.residual.cwiseProduct(sighting.inverse_sigma);
  const double position = robust(options.loss, options.loss_scale, r.head<2>().squaredNorm()).weight;
  const double disparity = robust(options.loss, options.loss_scale, r.z() * r.z()).weight;
  const Eigen::Vector3d w =
      sighting.weight *
      Eigen::Vector3d(position, position, disparity).cwiseProduct(sighting.inverse_sigma.cwiseAbs2());
  const double information = w.dot(at.by_inverse_depth.cwiseAbs2());
  if (!(information > 0)) return {};
  return {information,
          landmark.inverse_depth - w.cwiseProduct(at.by_inverse_depth).dot(at.residual) / information};
}

void keep_as_prior(ActiveMap& map, const WindowFrame& frame, const SolverOptions& options) {
  for (const Sighting& sighting : frame.sightings) {
    const int i = map.index_of(sighting.landmark);
    if (i < 0) continue;
    ActiveLandmark& active = map.landmarks[i];
    const DepthEvidence evidence = depth_evidence(map, active.landmark, frame, sighting, options);
    if (evidence.information <= 0) continue;
    add_to_mean(evidence.inverse_depth, evidence.information, active.prior_inverse_depth,
                active.prior_information);
    if (frame.keyframe.valid()) continue;
    // What the disparity alone says, of which the poses do not matter much.
    Sighting stereo = sighting;
    stereo.inverse_sigma.head<2>().setZero();
    if (const DepthEvidence alone = depth_evidence(map, active.landmark, frame, stereo, options);
        alone.information > 0)
      add_to_mean(alone.inverse_depth, alone.information, active.landmark.stereo_inverse_depth,
                  active.landmark.stereo_information);
  }
}

}  // namespace

int ActiveMap::index_of(LandmarkId id) const {
  const auto it = std::lower_bound(landmarks.begin(), landmarks.end(), id,
                                   [](const ActiveLandmark& a, LandmarkId b) { return a.landmark.id < b; });
  return it != landmarks.end() && it->landmark.id == id ? static_cast<int>(it - landmarks.begin()) : -1;
}

Linearized linearize(const ActiveMap& map, const Landmark& landmark, const SE3& camera_from_world,
                     const Sighting& sighting) {
  const SE3 camera_from_host = camera_from_world * map.hosts.at(landmark.host).camera_from_world.inverse();
  Linearized at =
      linearize(map.rig, camera_from_host, landmark.bearing, landmark.inverse_depth, sighting.measured);
  if (at.in_front)
    at.residual.z() += map.disparity_offset.at(map.rig, sighting.measured.x(), sighting.measured.y());
  return at;
}

void shorten_window(ActiveMap& map, int frames, const SolverOptions& options) {
  while (static_cast<int>(map.window.size()) > frames) {
    keep_as_prior(map, map.window.front(), options);
    map.window.pop_front();
  }
}

void update_information(ActiveMap& map, const SolverOptions& options) {
  for (ActiveLandmark& active : map.landmarks) active.landmark.information = active.prior_information;
  for (const WindowFrame& frame : map.window)
    for (const Sighting& sighting : frame.sightings)
      if (const int i = map.index_of(sighting.landmark); i >= 0)
        map.landmarks[i].landmark.information +=
            depth_evidence(map, map.landmarks[i].landmark, frame, sighting, options).information;
}

void forget(ActiveMap& map, int limit) {
  std::erase_if(map.landmarks, [&](const ActiveLandmark& active) { return active.missed > limit; });
  std::set<KeyframeId> needed;
  for (const ActiveLandmark& active : map.landmarks) needed.insert(active.landmark.host);
  for (const WindowFrame& frame : map.window) needed.insert(frame.keyframe);
  std::erase_if(map.hosts, [&](const auto& host) { return !needed.contains(host.first); });
}

}  // namespace spslam
