// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/mapping/local_adjustment.h"

#include "spslam/base/sort_unique.h"

namespace spslam {
namespace {

void add_landmark(const Landmark& landmark, int host, AdjustmentProblem& out) {
  LandmarkVariable variable;
  variable.host = host;
  variable.bearing = landmark.bearing;
  variable.inverse_depth = landmark.inverse_depth;
  variable.prior_inverse_depth = landmark.stereo_inverse_depth;
  variable.prior_information = landmark.stereo_information;
  out.problem.landmarks.push_back(variable);
  out.landmarks.push_back(landmark.id);
}

// Ascending ids of the landmarks that the free keyframes see.
std::vector<LandmarkId> seen_by(const Map& map, const std::vector<KeyframeId>& keyframes) {
  std::vector<LandmarkId> out;
  for (const KeyframeId id : keyframes)
    for (const Sighting& sighting : map.find(id)->sightings) out.push_back(sighting.landmark);
  sort_unique(out);
  return out;
}

}  // namespace

AdjustmentProblem copy_problem(const Map& map, const StereoRig& rig, const std::vector<KeyframeId>& keyframes,
                               const std::vector<KeyframeId>& free, bool uniform_weights) {
  AdjustmentProblem out;
  out.problem.rig = rig;
  out.keyframes = keyframes;
  for (const KeyframeId id : keyframes)
    out.problem.poses.push_back(
        {map.find(id)->camera_from_world, !std::binary_search(free.begin(), free.end(), id)});
  const auto place = [&](KeyframeId id) {
    const auto at = std::lower_bound(keyframes.begin(), keyframes.end(), id);
    return at != keyframes.end() && *at == id ? static_cast<int>(at - keyframes.begin()) : -1;
  };
  for (const LandmarkId id : seen_by(map, free)) {
    const Landmark& landmark = *map.find(id);
    const int host = place(landmark.host);
    if (host < 0) continue;
    add_landmark(landmark, host, out);
    for (const KeyframeId observer : map.observers(id)) {
      const int pose = place(observer);
      if (pose < 0) continue;
      const Sighting& s = *find_sighting(*map.find(observer), id);
      out.problem.observations.push_back({static_cast<int>(out.landmarks.size()) - 1, pose, s.measured,
                                          s.inverse_sigma, uniform_weights ? 1 : s.weight});
    }
  }
  return out;
}

AdjustmentProblem copy_neighbourhood(const Map& map, const StereoRig& rig, KeyframeId newest,
                                     const AdjustmentOptions& options) {
  std::vector<KeyframeId> free = {newest};
  for (const Covisible& other : map.covisible(newest))
    if (static_cast<int>(free.size()) < options.keyframes) free.push_back(other.id);
  sort_unique(free);
  std::vector<KeyframeId> all = free;
  for (const LandmarkId id : seen_by(map, free)) {
    all.push_back(map.find(id)->host);
    for (const KeyframeId observer : map.observers(id)) all.push_back(observer);
  }
  sort_unique(all);
  if (all.size() == free.size()) free.erase(free.begin());
  return copy_problem(map, rig, all, free, options.uniform_weights);
}

void write_back(const AdjustmentProblem& solved, Map& map) {
  for (std::size_t i = 0; i < solved.keyframes.size(); ++i) {
    const PoseVariable& pose = solved.problem.poses[i];
    if (!pose.fixed && pose.camera_from_world.is_finite())
      map.set_pose(solved.keyframes[i], pose.camera_from_world);
  }
  for (std::size_t l = 0; l < solved.landmarks.size(); ++l) {
    const double inverse_depth = solved.problem.landmarks[l].inverse_depth;
    const Landmark* landmark = map.find(solved.landmarks[l]);
    if (landmark && std::isfinite(inverse_depth))
      map.set_estimate(landmark->id, inverse_depth, landmark->information);
  }
}

int erase_outliers(const AdjustmentProblem& solved, double sigmas, Map& map) {
  const Problem& p = solved.problem;
  int erased = 0;
  for (const Observation& z : p.observations) {
    const LandmarkVariable& landmark = p.landmarks[z.landmark];
    if (landmark.host == z.pose) continue;
    const SE3 motion = p.poses[z.pose].camera_from_world * p.poses[landmark.host].camera_from_world.inverse();
    const Linearized at = linearize(p.rig, motion, landmark.bearing, landmark.inverse_depth, z.measured);
    const Eigen::Vector3d r = at.residual.cwiseProduct(z.inverse_sigma);
    const bool is_inlier = at.in_front && r.head<2>().norm() <= sigmas && std::abs(r.z()) <= sigmas;
    if (is_inlier) continue;
    map.erase_sighting(solved.keyframes[z.pose], solved.landmarks[z.landmark]);
    ++erased;
  }
  return erased;
}

}  // namespace spslam
