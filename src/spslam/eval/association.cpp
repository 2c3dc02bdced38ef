// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/eval/association.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "spslam/base/error.h"
#include "spslam/base/options.h"

namespace spslam {
namespace {

void check_trajectory(const Trajectory& trajectory, const char* name, bool times_matter) {
  if (trajectory.empty())
    throw InputError(fmt::format("the {} has no pose; give a file with at least three", name));
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const StampedPose& pose = trajectory[i];
    if (!std::isfinite(pose.timestamp) || !pose.world_from_camera.is_finite())
      throw InputError(
          fmt::format("pose {} (t = {:.6f}) of the {} is not finite; leave lost frames out of the file",
                      i + 1, pose.timestamp, name));
    if (times_matter && i > 0 && pose.timestamp < trajectory[i - 1].timestamp)
      throw InputError(
          fmt::format("pose {} of the {} goes back in time (from {:.6f} to {:.6f} s); sort the file by time",
                      i + 1, name, trajectory[i - 1].timestamp, pose.timestamp));
  }
}

// The index of the pose nearest in time; of two as near, the earlier.
std::size_t nearest_in_time(const Trajectory& trajectory, double time) {
  const auto later = std::lower_bound(trajectory.begin(), trajectory.end(), time,
                                      [](const StampedPose& pose, double t) { return pose.timestamp < t; });
  if (later == trajectory.begin()) return 0;
  const std::size_t after = static_cast<std::size_t>(later - trajectory.begin());
  if (after == trajectory.size()) return after - 1;
  return time - trajectory[after - 1].timestamp <= trajectory[after].timestamp - time ? after - 1 : after;
}

std::vector<AssociatedPose> associate_by_index(const Trajectory& estimate, const Trajectory& truth) {
  if (estimate.size() != truth.size())
    throw InputError(fmt::format(
        "the estimate has {} poses and the ground truth {}: without times the n-th belongs to the "
        "n-th and both must have as many; give times",
        estimate.size(), truth.size()));
  std::vector<AssociatedPose> pairs;
  for (std::size_t i = 0; i < estimate.size(); ++i)
    pairs.push_back({estimate[i].timestamp, estimate[i].world_from_camera, truth[i].world_from_camera});
  return pairs;
}

std::vector<AssociatedPose> associate_nearest(const Trajectory& estimate, const Trajectory& truth,
                                              const AssociationOptions& options) {
  std::vector<AssociatedPose> pairs;
  std::size_t last_truth = truth.size();
  double last_difference = 0;
  for (const StampedPose& pose : estimate) {
    const std::size_t j = nearest_in_time(truth, pose.timestamp - options.offset);
    const double difference = std::abs(truth[j].timestamp + options.offset - pose.timestamp);
    if (difference > options.tolerance) continue;
    const bool shared = j == last_truth;
    if (shared && difference >= last_difference) continue;
    if (shared) pairs.pop_back();
    pairs.push_back({pose.timestamp, pose.world_from_camera, truth[j].world_from_camera});
    last_truth = j, last_difference = difference;
  }
  return pairs;
}

std::vector<AssociatedPose> associate_interpolated(const Trajectory& estimate, const Trajectory& truth,
                                                   const AssociationOptions& options) {
  std::vector<AssociatedPose> pairs;
  for (const StampedPose& pose : estimate) {
    const double time = pose.timestamp - options.offset;
    const auto after = std::lower_bound(truth.begin(), truth.end(), time,
                                        [](const StampedPose& p, double t) { return p.timestamp < t; });
    if (after == truth.end() || (after == truth.begin() && after->timestamp > time)) continue;
    const StampedPose& b = *after;
    const StampedPose& a = after == truth.begin() ? b : *(after - 1);
    const double gap = b.timestamp - a.timestamp;
    if (gap > options.longest_gap) continue;
    const double share = gap > 0 ? (time - a.timestamp) / gap : 0;
    const Eigen::Vector3d turn =
        share * so3_log(a.world_from_camera.rotation.transpose() * b.world_from_camera.rotation);
    const SE3 between{
        a.world_from_camera.rotation * so3_exp(turn),
        (1 - share) * a.world_from_camera.translation + share * b.world_from_camera.translation};
    pairs.push_back({pose.timestamp, pose.world_from_camera, between});
  }
  return pairs;
}

}  // namespace

std::vector<AssociatedPose> associate(const Trajectory& estimate, const Trajectory& truth,
                                      const AssociationOptions& options) {
  check_options(options);
  check_trajectory(estimate, "estimate", !options.by_index);
  check_trajectory(truth, "ground truth", !options.by_index);
  if (options.by_index) return associate_by_index(estimate, truth);
  if (options.interpolate) return associate_interpolated(estimate, truth, options);
  return associate_nearest(estimate, truth, options);
}

double path_length(const Trajectory& trajectory) {
  double length = 0;
  for (std::size_t i = 1; i < trajectory.size(); ++i)
    length += (trajectory[i].world_from_camera.translation - trajectory[i - 1].world_from_camera.translation)
                  .norm();
  return length;
}

double estimate_path_length(std::span<const AssociatedPose> poses) {
  double length = 0;
  for (std::size_t i = 1; i < poses.size(); ++i)
    length += (poses[i].estimate.translation - poses[i - 1].estimate.translation).norm();
  return length;
}

double truth_path_length(std::span<const AssociatedPose> poses) {
  double length = 0;
  for (std::size_t i = 1; i < poses.size(); ++i)
    length += (poses[i].truth.translation - poses[i - 1].truth.translation).norm();
  return length;
}

}  // namespace spslam
