// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/eval/trajectory_error.h"

#include <cmath>
#include <limits>

#include "spslam/base/error.h"

namespace spslam {
namespace {

constexpr double kDegrees = 180 / M_PI;
constexpr int kKittiStep = 10;          // poses between two starts
constexpr double kTimeRounding = 1e-3;  // share of the interval by which the last pose may come too early

struct MotionError {
  double translation = 0;  // m
  double rotation = 0;     // rad
};

MotionError motion_error(const AssociatedPose& from, const AssociatedPose& to) {
  const SE3 estimate = from.estimate.inverse() * to.estimate;
  const SE3 truth = from.truth.inverse() * to.truth;
  const SE3 error = estimate.inverse() * truth;
  return {error.translation.norm(), so3_log(error.rotation).norm()};
}

void add(RpeResult& result, const AssociatedPose& from, const AssociatedPose& to, double divisor) {
  const MotionError error = motion_error(from, to);
  result.timestamps.push_back(from.timestamp);
  result.translation_errors.push_back(error.translation / divisor);
  result.rotation_errors.push_back(error.rotation * kDegrees / divisor);
}

void summarize(RpeResult& result) {
  result.translation = statistics_of(result.translation_errors);
  result.rotation = statistics_of(result.rotation_errors);
}

// The way along the truth up to each pose, m.
std::vector<double> distances_along(std::span<const AssociatedPose> poses) {
  std::vector<double> distances(poses.size(), 0.0);
  for (std::size_t i = 1; i < poses.size(); ++i)
    distances[i] = distances[i - 1] + (poses[i].truth.translation - poses[i - 1].truth.translation).norm();
  return distances;
}

}  // namespace

AteResult absolute_trajectory_error(std::span<const AssociatedPose> poses) {
  AteResult result;
  for (const AssociatedPose& pose : poses)
    result.errors.push_back((pose.estimate.translation - pose.truth.translation).norm());
  result.position = statistics_of(result.errors);
  return result;
}

RpeResult relative_pose_error_per_second(std::span<const AssociatedPose> poses, double interval) {
  if (!(interval > 0))
    throw OptionError("the interval of the relative error must be a positive number of seconds");
  RpeResult result;
  std::size_t end = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double target = poses[i].timestamp + interval;
    if (target > poses.back().timestamp + kTimeRounding * interval) break;
    end = std::max(end, i);
    while (end + 1 < poses.size() &&
           std::abs(poses[end + 1].timestamp - target) <= std::abs(poses[end].timestamp - target))
      ++end;
    const double elapsed = poses[end].timestamp - poses[i].timestamp;
    if (std::abs(elapsed - interval) <= 0.25 * interval) add(result, poses[i], poses[end], elapsed);
  }
  summarize(result);
  return result;
}

RpeResult relative_pose_error_per_frame(std::span<const AssociatedPose> poses, int step) {
  if (step < 1) throw OptionError("the step of the relative error must be at least one frame");
  RpeResult result;
  const auto ahead = static_cast<std::size_t>(step);
  for (std::size_t i = 0; i + ahead < poses.size(); ++i) add(result, poses[i], poses[i + ahead], 1);
  summarize(result);
  return result;
}

KittiResult kitti_error(std::span<const AssociatedPose> poses) {
  const std::vector<double> distances = distances_along(poses);
  KittiResult result;
  for (int hundreds = 1; hundreds <= 8; ++hundreds) {
    KittiLength at{100.0 * hundreds, 0, 0, 0};
    std::size_t end = 0;
    for (std::size_t start = 0; start < poses.size(); start += kKittiStep) {
      while (end < poses.size() && distances[end] <= distances[start] + at.length) ++end;
      if (end == poses.size()) break;
      const MotionError error = motion_error(poses[start], poses[end]);
      at.translation += 100 * error.translation / at.length;
      at.rotation += error.rotation * kDegrees * 100 / at.length;
      ++at.count;
    }
    if (at.count == 0) continue;
    result.count += at.count, result.t_rel += at.translation, result.r_rel += at.rotation;
    at.translation /= static_cast<double>(at.count), at.rotation /= static_cast<double>(at.count);
    result.lengths.push_back(at);
  }
  const double n =
      result.count ? static_cast<double>(result.count) : std::numeric_limits<double>::quiet_NaN();
  result.t_rel /= n, result.r_rel /= n;
  return result;
}

}  // namespace spslam
