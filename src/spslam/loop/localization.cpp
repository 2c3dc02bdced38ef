// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/loop/localization.h"

#include <algorithm>
#include <cmath>

namespace spslam {
namespace {

constexpr double kDegree = M_PI / 180;
constexpr double kMaxTurn = 40 * kDegree;  // between views that may show the same
constexpr double kMetresPerRadian = 5;     // a turn is as bad as so much way

}  // namespace

Matrix6d drift_covariance(const SE3& motion, const LocalizationOptions& options) {
  const double way = motion.translation.norm();
  Matrix6d out = Matrix6d::Zero();
  // A random walk whose steps are as long as errors stay alike.
  out.diagonal().head<3>().setConstant(options.drift * options.drift * way * options.correlation);
  out.diagonal().tail<3>().setConstant(std::pow(options.turn_drift * kDegree, 2) * way * options.correlation);
  return out;
}

MapPose LocalizationFilter::moved(const MapPose& pose, const SE3& motion, const Matrix6d& noise) const {
  const Matrix6d adjoint = motion.adjoint();
  return {(motion * pose.camera_from_world).normalized(),
          adjoint * pose.covariance * adjoint.transpose() + drift_covariance(motion, options_) + noise};
}

void LocalizationFilter::move(const SE3& present_from_before, const Matrix6d& noise) {
  if (estimate_) estimate_ = moved(*estimate_, present_from_before, noise);
  if (pending_) pending_ = moved(*pending_, present_from_before, noise);
}

Matrix6d LocalizationFilter::map_covariance() const {
  Matrix6d out = Matrix6d::Zero();
  out.diagonal().head<3>().setConstant(options_.map_sigma * options_.map_sigma);
  out.diagonal().tail<3>().setConstant(std::pow(options_.map_turn_sigma * kDegree, 2));
  return out;
}

bool LocalizationFilter::agree(const MapPose& a, const MapPose& b) const {
  const Vector6d off = (a.camera_from_world * b.camera_from_world.inverse()).log();
  const Matrix6d covariance = a.covariance + b.covariance + map_covariance();
  return off.dot(covariance.ldlt().solve(off)) <= options_.gate;
}

FilterAnswer LocalizationFilter::add(const MapPose& measured) {
  if (!measured.camera_from_world.is_finite() || !measured.covariance.allFinite())
    return FilterAnswer::kPending;
  if (estimate_ && agree(*estimate_, measured)) {
    const Vector6d innovation = (measured.camera_from_world * estimate_->camera_from_world.inverse()).log();
    const Matrix6d gain =
        (estimate_->covariance + measured.covariance).ldlt().solve(estimate_->covariance).transpose();
    // Joseph's form stays symmetric and positive.
    const Matrix6d rest = Matrix6d::Identity() - gain;
    estimate_->camera_from_world = (SE3::exp(gain * innovation) * estimate_->camera_from_world).normalized();
    estimate_->covariance =
        rest * estimate_->covariance * rest.transpose() + gain * measured.covariance * gain.transpose();
    pending_.reset();
    agreeing_ = 0;
    return FilterAnswer::kUsed;
  }
  agreeing_ = pending_ && agree(*pending_, measured) ? agreeing_ + 1 : 1;
  pending_ = measured;
  if (agreeing_ < options_.confirmations) return FilterAnswer::kPending;
  estimate_ = pending_;
  pending_.reset();
  agreeing_ = 0;
  return FilterAnswer::kRestarted;
}

std::optional<MapPose> LocalizationFilter::estimate() const {
  if (!estimate_) return std::nullopt;
  MapPose out = *estimate_;
  out.covariance += map_covariance();
  if (!(out.position_sigma() <= options_.max_uncertainty)) return std::nullopt;
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
