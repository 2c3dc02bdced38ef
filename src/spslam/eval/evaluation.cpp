// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/eval/evaluation.h"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "spslam/base/error.h"
#include "spslam/base/options.h"

namespace spslam {
namespace {

constexpr std::size_t kFewest = 3;  // pairs that determine a rigid motion

std::string span_text(const Trajectory& trajectory) {
  return fmt::format("{} poses from {:.3f} to {:.3f} s", trajectory.size(), trajectory.front().timestamp,
                     trajectory.back().timestamp);
}

void require_enough(std::size_t pairs, const Trajectory& estimate, const Trajectory& truth,
                    const AssociationOptions& options) {
  if (pairs >= kFewest) return;
  if (options.by_index)
    throw InputError(fmt::format("only {} poses: an evaluation needs at least {}", pairs, kFewest));
  throw InputError(
      fmt::format("only {} poses of the estimate ({}) have a pose of the ground truth ({}) within {} s; at "
                  "least {} are needed: are both on one clock? a larger tolerance or an offset may help",
                  pairs, span_text(estimate), span_text(truth), options.tolerance, kFewest));
}

double scale_ratio_of(std::span<const AssociatedPose> poses, bool planar) {
  const AlignResult similar = align_positions(poses, AlignMode::kSim3, planar);
  return similar.has_scale ? similar.truth_from_estimate.scale : std::numeric_limits<double>::quiet_NaN();
}

double extent_of(std::span<const AssociatedPose> poses) {
  Eigen::AlignedBox3d box;
  for (const AssociatedPose& pose : poses) box.extend(pose.truth.translation);
  return box.diagonal().norm();
}

// A truth of another sequence gives figures like any other; but then few poses have a partner in time, or the
// two ways have nothing in common, the scale neither.
std::vector<std::string> warnings_of(const Evaluation& e, std::span<const AssociatedPose> poses) {
  constexpr double kStandingStill = 0.5;  // m, of a truth whose noise has any scale
  std::vector<std::string> warnings;
  if (2 * poses.size() < std::min(e.estimate_poses, e.truth_poses))
    warnings.push_back(fmt::format(
        "only {} of {} poses have one of the {} poses of the ground truth at their time: are both of "
        "one sequence and on one clock?",
        poses.size(), e.estimate_poses, e.truth_poses));
  const bool other_scale = e.scale_ratio < 0.5 || e.scale_ratio > 2;  // false for NaN
  if (other_scale && extent_of(poses) > kStandingStill)
    warnings.push_back(fmt::format(
        "the estimate would have to be {:.3g} times as large to fit: is this the truth of the same "
        "sequence, and is the calibration's baseline right?",
        e.scale_ratio));
  return warnings;
}

// The metric knows no alignment, but planar headings can be compared in one world only; a rigid motion
// changes no figure.
KittiResult kitti_without_scale(std::span<const AssociatedPose> poses, bool planar) {
  if (!planar) return kitti_error(poses);
  std::vector<AssociatedPose> rigid =
      aligned_poses(align_positions(poses, AlignMode::kSe3, planar).truth_from_estimate, poses);
  align_headings(rigid);
  return kitti_error(rigid);
}

}  // namespace

Evaluation evaluate(const Trajectory& estimate, const Trajectory& truth, const EvaluationOptions& options) {
  check_options(options);
  Evaluation result;
  result.options = options;
  result.estimate_poses = estimate.size();
  result.truth_poses = truth.size();
  std::vector<AssociatedPose> poses = associate(estimate, truth, options.association);
  result.associated_poses = poses.size();
  require_enough(poses.size(), estimate, truth, options.association);
  if (options.planar) {
    poses = planar_poses(poses, options.up_estimate, options.up_truth);
    result.notes.emplace_back("planar: heights, roll and pitch are left out");
  }
  result.estimate_length = estimate_path_length(poses);
  result.truth_length = truth_path_length(poses);
  if (!options.association.by_index) result.duration = poses.back().timestamp - poses.front().timestamp;
  result.scale_ratio = scale_ratio_of(poses, options.planar);
  result.warnings = warnings_of(result, poses);

  const AlignResult aligned = align_positions(poses, options.align, options.planar);
  if (!aligned.degenerate.empty()) result.notes.push_back("degenerate alignment: " + aligned.degenerate);
  result.truth_from_estimate = aligned.truth_from_estimate;
  result.poses = aligned_poses(aligned.truth_from_estimate, poses);
  if (options.planar) align_headings(result.poses);
  result.ate = absolute_trajectory_error(result.poses);
  const auto right = std::count_if(result.ate.errors.begin(), result.ate.errors.end(),
                                   [&](double error) { return error <= options.within; });
  result.share_within = static_cast<double>(right) / static_cast<double>(truth.size());
  const std::span<const AssociatedPose> timed(result.poses.data(),
                                              options.association.by_index ? 0 : result.poses.size());
  result.rpe_per_second = relative_pose_error_per_second(timed, options.rpe_interval);
  result.rpe_per_frame = relative_pose_error_per_frame(result.poses);
  result.kitti = kitti_without_scale(poses, options.planar);
  return result;
}

SE3 laid_by_nearest(std::span<const AssociatedPose> map, const SE3& pose) {
  const auto distance = [&](const AssociatedPose& known) {
    return (known.estimate.translation - pose.translation).squaredNorm();
  };
  const auto nearest = std::min_element(
      map.begin(), map.end(),
      [&](const AssociatedPose& a, const AssociatedPose& b) { return distance(a) < distance(b); });
  return nearest == map.end() ? pose : nearest->truth * nearest->estimate.inverse() * pose;
}

}  // namespace spslam
