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
constexpr int kPreciseVoice = 2;           // places that are not precise that confirm as much as one that is

// What is known by both, as far as there is anything.
std::optional<UncertainPose> both(const std::optional<UncertainPose>& a,
                                  const std::optional<UncertainPose>& b) {
  if (!a || !b) return a ? a : b;
  return fused(*a, *b);
}

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
  const bool is_found = estimate().has_value();
  if (!precise && !is_found && measured.position_sigma() > options_.start_sigma)
    return FilterAnswer::kPending;
  if (estimate_ && agree(*estimate_, measured)) {
    estimate_ = fused(*estimate_, measured);
    if (precise) pending_.reset(), agreeing_ = 0;
    return FilterAnswer::kUsed;
  }
  if (!precise && is_found) return FilterAnswer::kPending;
  const bool confirms = pending_ && agree(*pending_, measured);
  agreeing_ = (confirms ? agreeing_ : 0) + (precise ? kPreciseVoice : 1);
  pending_ = confirms ? fused(*pending_, measured) : measured;
  if (agreeing_ < kPreciseVoice * options_.confirmations) return FilterAnswer::kPending;
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
  const std::size_t count = run.camera_from_session.size();
  std::vector<std::optional<UncertainPose>> before(count);  // by the places up to and with each frame
  std::optional<UncertainPose> known;
  const auto go = [&](std::size_t from, std::size_t to) {
    const SE3 motion = run.camera_from_session[to] * run.camera_from_session[from].inverse();
    if (known) known = moved(*known, motion, drift_covariance(motion, options));
  };
  auto next = run.places.begin();
  for (std::size_t f = 0; f < count; ++f) {
    if (f > 0) go(f - 1, f);
    for (; next != run.places.end() && next->frame == f; ++next) known = both(known, next->pose);
    before[f] = known;
  }
  if (!known) return {};
  std::vector<SE3> out(count);
  known.reset();
  auto last = run.places.rbegin();
  for (std::size_t f = count; f-- > 0;) {
    if (f + 1 < count) go(f + 1, f);
    out[f] = both(before[f], known)->camera_from_world;
    for (; last != run.places.rend() && last->frame == f; ++last) known = both(known, last->pose);
  }
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
