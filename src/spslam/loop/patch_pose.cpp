// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/loop/patch_pose.h"

#include <algorithm>
#include <cmath>

#include "spslam/map/keyframe_image.h"
#include "spslam/mapping/patch_sighting.h"
#include "spslam/optimize/problem.h"

namespace spslam {
namespace {

constexpr double kInlierSigmas = 3.5;
constexpr double kSecondMove = 0.25;  // of max_move, from where the pose found first puts a patch
constexpr int kPatchSolverSteps = 20;

// Copies with images and sightings.
std::vector<Keyframe> with_images(const Map& map, const StereoRig& rig, const std::vector<KeyframeId>& ids,
                                  const AlignmentOptions& options) {
  std::vector<Keyframe> out;
  for (const KeyframeId id : ids) {
    const Keyframe* keyframe = map.find(id);
    if (!keyframe) continue;
    Keyframe host = *keyframe;
    host.left = pyramid_of(host, rig, options);
    if (!host.left.empty()) out.push_back(std::move(host));
  }
  return out;
}

// The landmarks found near where `camera` should see them: pose 0 is the camera's, the hosts' are held.
Problem align_landmarks(const Map& map, const StereoRig& rig, const std::vector<Keyframe>& hosts,
                        const Keyframe& camera, double max_move, const PatchPoseOptions& options) {
  Problem problem;
  problem.rig = rig;
  problem.poses = {{camera.camera_from_world, false}};
  const double inverse_sigma = 1 / options.position_sigma;
  for (const Keyframe& host : hosts) {
    const auto place = static_cast<int>(problem.poses.size());
    problem.poses.push_back({host.camera_from_world, true});
    const SE3 motion = camera.camera_from_world * host.camera_from_world.inverse();
    for (const Sighting& sighting : host.sightings) {
      const Landmark& landmark = *map.find(sighting.landmark);
      if (landmark.host != host.id) continue;
      const Eigen::Vector3d x =
          motion.rotation * landmark.bearing + landmark.inverse_depth * motion.translation;
      if (!(x.z() > 0)) continue;
      const auto found = find_patch(rig, host, landmark, camera, rig.project(x), max_move, options.alignment);
      if (!found) continue;
      problem.observations.push_back({static_cast<int>(problem.landmarks.size()),
                                      0,
                                      {found->x(), found->y(), 0},
                                      {inverse_sigma, inverse_sigma, 0},
                                      1});
      problem.landmarks.push_back({place, landmark.bearing, landmark.inverse_depth, landmark.inverse_depth,
                                   landmark.information, false});
    }
  }
  return problem;
}

struct Agreement {
  int inliers = 0;
  double squares = 0;  // sum of their squared errors in sigma
};

Agreement agreement_of(const Problem& solved) {
  Agreement out;
  for (const Observation& z : solved.observations) {
    const LandmarkVariable& l = solved.landmarks[z.landmark];
    const SE3 motion = solved.poses[0].camera_from_world * solved.poses[l.host].camera_from_world.inverse();
    const Linearized at = linearize(solved.rig, motion, l.bearing, l.inverse_depth, z.measured);
    const double squared = at.in_front ? at.residual.cwiseProduct(z.inverse_sigma).squaredNorm() : 1e9;
    if (squared > kInlierSigmas * kInlierSigmas) continue;
    ++out.inliers;
    out.squares += squared;
  }
  return out;
}

}  // namespace

std::optional<UncertainPose> pose_by_patches(const Map& map, const StereoRig& rig,
                                             const AlignmentPyramid& left, const SE3& start,
                                             const std::vector<KeyframeId>& keyframes,
                                             const PatchPoseOptions& options) {
  if (!options.enabled || left.empty() || !start.is_finite()) return std::nullopt;
  const std::vector<Keyframe> hosts = with_images(map, rig, keyframes, options.alignment);
  Keyframe camera;
  camera.camera_from_world = start, camera.left = left;
  std::optional<UncertainPose> out;
  // Again from the pose found, whose warps and starts are better.
  for (const double move : {options.max_move, kSecondMove * options.max_move}) {
    Problem problem = align_landmarks(map, rig, hosts, camera, move, options);
    if (static_cast<int>(problem.landmarks.size()) < options.min_landmarks) return std::nullopt;
    SolverOptions solver;
    solver.iterations = kPatchSolverSteps;
    const SolveSummary summary = solve(problem, solver, true);
    const SE3& pose = problem.poses[0].camera_from_world;
    if (summary.status == SolveStatus::kFailed || summary.covariance.rows() != 6 || !pose.is_finite())
      return std::nullopt;
    const Agreement all = agreement_of(problem);
    if (all.inliers < options.min_landmarks ||
        all.inliers < options.min_inlier_share * static_cast<double>(problem.landmarks.size()))
      return std::nullopt;
    camera.camera_from_world = pose;
    // Two measures each, of which the inverse depths' priors leave more than one free.
    out = {pose, summary.covariance * std::max(1.0, all.squares / all.inliers)};
  }
  return out;
}

AlignmentPyramid pyramid_of(const Keyframe& keyframe, const StereoRig& rig, const AlignmentOptions& options) {
  if (!keyframe.left.empty() || !keyframe.image) return keyframe.left;
  const cv::Mat image = decompress(*keyframe.image, rig.width, rig.height);
  return image.empty() ? AlignmentPyramid()
                       : AlignmentPyramid(image, options.levels, options.noise_factor > 0);
}

std::vector<KeyframeId> keyframes_of_place(const Map& map, KeyframeId reference, int count,
                                           const std::set<KeyframeId>& exclude) {
  std::vector<KeyframeId> out = {reference};
  for (const Covisible& other : map.covisible(reference))
    if (static_cast<int>(out.size()) < count && !exclude.contains(other.id)) out.push_back(other.id);
  return out;
}

}  // namespace spslam
