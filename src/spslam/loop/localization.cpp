// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/loop/localization.h"

#include <algorithm>
#include <cmath>

#include "spslam/optimize/pose_graph.h"

namespace spslam {
namespace {

constexpr double kDegree = M_PI / 180;
constexpr double kMaxTurn = 40 * kDegree;  // between views that may show the same
constexpr double kMetresPerRadian = 5;     // a turn is as bad as so much way
constexpr double kStandingSigma = 1e-3;    // m and rad; odometry errs that much even where nothing moves

}  // namespace

Matrix6d drift_covariance(const SE3& motion, const LocalizationOptions& options) {
  const double way = motion.translation.norm();
  Matrix6d out = Matrix6d::Zero();
  // A random walk whose steps are as long as errors stay alike.
  out.diagonal().head<3>().setConstant(options.drift * options.drift * way * options.correlation);
  out.diagonal().tail<3>().setConstant(std::pow(options.turn_drift * kDegree, 2) * way * options.correlation);
  return out;
}

void LocalizationFilter::move(const SE3& present_from_before) {
  const Matrix6d drift = drift_covariance(present_from_before, options_);
  if (estimate_) estimate_ = moved(*estimate_, present_from_before, drift);
  if (pending_) pending_ = moved(*pending_, present_from_before, drift);
}

Matrix6d LocalizationFilter::map_covariance() const {
  Matrix6d out = Matrix6d::Zero();
  out.diagonal().head<3>().setConstant(options_.map_sigma * options_.map_sigma);
  out.diagonal().tail<3>().setConstant(std::pow(options_.map_turn_sigma * kDegree, 2));
  return out;
}

bool LocalizationFilter::agree(const UncertainPose& a, const UncertainPose& b) const {
  return squared_distance(a, b, map_covariance()) <= options_.gate;
}

FilterAnswer LocalizationFilter::add(const UncertainPose& measured, bool precise) {
  if (!measured.camera_from_world.is_finite() || !measured.covariance.allFinite())
    return FilterAnswer::kPending;
  if (estimate_ && agree(*estimate_, measured)) {
    estimate_ = fused(*estimate_, measured);
    pending_.reset();
    agreeing_ = 0;
    return FilterAnswer::kUsed;
  }
  if (!precise) return FilterAnswer::kPending;
  const bool confirms = pending_ && agree(*pending_, measured);
  agreeing_ = confirms ? agreeing_ + 1 : 1;
  pending_ = confirms ? fused(*pending_, measured) : measured;
  if (agreeing_ < options_.confirmations) return FilterAnswer::kPending;
  estimate_ = pending_;
  pending_.reset();
  agreeing_ = 0;
  return FilterAnswer::kRestarted;
}

std::optional<UncertainPose> LocalizationFilter::estimate() const {
  if (!estimate_) return std::nullopt;
  UncertainPose out = *estimate_;
  out.covariance += map_covariance();
  if (!(out.position_sigma() <= options_.max_uncertainty)) return std::nullopt;
  return out;
}

std::vector<SE3> smooth(const PlacedRun& run, const LocalizationOptions& options) {
  if (run.places.empty()) return {};
  PoseGraph graph;
  graph.poses.push_back({SE3{}, true});  // the map
  const PlacedRun::Place& anchor = run.places.front();
  const SE3 session_from_map =
      run.camera_from_session[anchor.frame].inverse() * anchor.pose.camera_from_world;
  for (std::size_t f = 0; f < run.camera_from_session.size(); ++f) {
    graph.poses.push_back({run.camera_from_session[f] * session_from_map, false});
    if (f == 0) continue;
    const SE3 motion = run.camera_from_session[f] * run.camera_from_session[f - 1].inverse();
    Matrix6d covariance = drift_covariance(motion, options);
    covariance.diagonal().array() += kStandingSigma * kStandingSigma;
    graph.edges.push_back({static_cast<int>(f), static_cast<int>(f) + 1, motion, covariance.inverse()});
  }
  for (const PlacedRun::Place& place : run.places)
    graph.edges.push_back(
        {0, place.frame + 1, place.pose.camera_from_world, place.pose.covariance.inverse(), true});
  if (solve(graph, SolverOptions{}).status == SolveStatus::kFailed) return {};
  std::vector<SE3> out;
  for (std::size_t p = 1; p < graph.poses.size(); ++p) out.push_back(graph.poses[p].camera_from_world);
  return out;
}

std::vector<KeyframeId> nearest_keyframes(const Map& map, const SE3& camera_from_world, int count) {
  std::vector<std::pair<double, KeyframeId>> ranked;
  const Eigen::Vector3d centre = camera_from_world.inverse().translation;
  for (const auto& [id, keyframe] : map.keyframes()) {
    const SE3& pose = keyframe.camera_from_world;
    const double turn = so3_log(camera_from_world.rotation * pose.rotation.transpose()).norm();
    if (turn > kMaxTurn) continue;
    ranked.emplace_back((pose.inverse().translation - centre).norm() + kMetresPerRadian * turn, id);
  }
  const std::size_t kept = std::min(ranked.size(), static_cast<std::size_t>(count));
  std::partial_sort(ranked.begin(), ranked.begin() + static_cast<std::ptrdiff_t>(kept), ranked.end());
  std::vector<KeyframeId> out;
  for (std::size_t i = 0; i < kept; ++i) out.push_back(ranked[i].second);
  return out;
}

}  // namespace spslam
