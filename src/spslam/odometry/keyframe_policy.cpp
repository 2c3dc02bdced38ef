// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/odometry/keyframe_policy.h"

#include <Eigen/Cholesky>
#include <numeric>

namespace spslam {

double differential_entropy(const Matrix6d& covariance) {
  const Eigen::LLT<Matrix6d> factor(covariance);
  if (factor.info() != Eigen::Success) return std::nan("");
  const Matrix6d l = factor.matrixL();
  const double half_log_determinant = l.diagonal().array().log().sum();
  return 0.5 * 6 * (1 + std::log(2 * M_PI)) + half_log_determinant;
}

std::string KeyframeDecision::reason() const {
  std::string all;
  const auto add = [&](bool holds, const char* name) {
    if (holds && !all.empty()) all += '+';
    if (holds) all += name;
  };
  add(too_many_frames, "frames");
  add(moved_enough, "motion");
  add(keyframe_points_lost, "keyframe-points");
  add(previous_points_lost, "previous-points");
  add(entropy_changed, "entropy");
  add(too_few_points, "floor");
  return all;
}

KeyframeDecision KeyframePolicy::decide(const KeyframeEvidence& e, const KeyframeOptions& options) {
  KeyframeDecision decision;
  decision.too_few_points = e.tracked < options.min_tracked;
  decision.entropy_changed = options.entropy && entropy_changed(e.entropy, options);
  if (e.frames_since_keyframe >= options.min_frames) {
    decision.too_many_frames = !e.mapper_is_busy && e.frames_since_keyframe >= options.max_frames;
    decision.moved_enough =
        !e.mapper_is_busy && (e.rotation > options.max_rotation || e.parallax > options.max_parallax);
    decision.keyframe_points_lost = 1 - e.share_of_keyframe > options.lost_of_keyframe;
    decision.previous_points_lost = e.tracked < (1 - options.lost_of_previous) * e.tracked_before;
  } else {
    decision.entropy_changed = false;
  }
  if (decision.insert()) entropies_.clear();
  return decision;
}

// ln det changes its sign with the units and a ratio of entropies means nothing there. A difference does not:
// the motion's uncertainty, as the geometric mean of its six standard deviations, has changed by the factor
// exp(difference / 6).
bool KeyframePolicy::entropy_changed(double entropy, const KeyframeOptions& options) {
  if (!std::isfinite(entropy)) return true;
  bool changed = false;
  if (!entropies_.empty()) {
    const double mean =
        std::accumulate(entropies_.begin(), entropies_.end(), 0.0) / static_cast<double>(entropies_.size());
    changed = std::exp((entropy - mean) / 6) > 1 + options.entropy_change;
  }
  entropies_.push_back(entropy);
  if (static_cast<int>(entropies_.size()) > options.entropy_window) entropies_.pop_front();
  return changed;
}

}  // namespace spslam
