// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/eval/planar.h"

#include <Eigen/LU>
#include <cmath>

namespace spslam {
namespace {

constexpr double kConstant = 1e-9;  // m, range of a coordinate that was never measured
constexpr double kLevel =
    1e-4;  // share of the motion's variance at which the cameras' attitude counts as much

// The axis of the one coordinate that is the same in all poses, or zero.
Eigen::Vector3d constant_axis(std::span<const SE3> poses) {
  Eigen::Vector3d low = poses.front().translation, high = low;
  for (const SE3& pose : poses) low = low.cwiseMin(pose.translation), high = high.cwiseMax(pose.translation);
  const Eigen::Array<bool, 3, 1> constant = (high - low).array() < kConstant;
  if (constant.count() != 1) return Eigen::Vector3d::Zero();
  if (constant[0]) return Eigen::Vector3d::UnitX();
  return constant[1] ? Eigen::Vector3d(0, -1, 0) : Eigen::Vector3d(0, 0, 1);
}

Eigen::Vector3d automatic_up(std::span<const SE3> poses) {
  Eigen::Vector3d camera_up = Eigen::Vector3d::Zero(), mean = Eigen::Vector3d::Zero();
  for (const SE3& pose : poses) camera_up -= pose.rotation.col(1), mean += pose.translation;
  camera_up.normalize();
  mean /= static_cast<double>(poses.size());
  const Eigen::Vector3d axis = constant_axis(poses);
  if (!axis.isZero()) return axis.dot(camera_up) < -0.5 ? Eigen::Vector3d(-axis) : axis;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const SE3& pose : poses)
    covariance += (pose.translation - mean) * (pose.translation - mean).transpose();
  if (covariance.trace() <= 0) return camera_up;
  covariance /= covariance.trace();
  // Minimizes u' C u + kLevel |u - camera_up|^2.
  const Eigen::Matrix3d system = covariance + kLevel * Eigen::Matrix3d::Identity();
  return system.llt().solve(camera_up).normalized();
}

// The turn about z in a rotation (its twist), in rad.
double heading(const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond q(rotation);
  return 2 * std::atan2(q.z(), q.w());
}

Eigen::Matrix3d about_z(double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

SE3 flatten(const SE3& pose, const Eigen::Matrix3d& level, const Eigen::Matrix3d& first_rotation) {
  SE3 flat;
  flat.translation = level * pose.translation;
  flat.translation.z() = 0;
  flat.rotation = about_z(heading(level * pose.rotation * first_rotation.transpose() * level.transpose()));
  return flat;
}

}  // namespace

std::span<const char* const> option_names(UpAxis) {
  static constexpr const char* names[] = {"auto", "x", "y", "z", "-x", "-y", "-z"};
  return names;
}

Eigen::Vector3d up_direction(std::span<const SE3> poses, UpAxis axis) {
  switch (axis) {
    case UpAxis::kX:
      return Eigen::Vector3d::UnitX();
    case UpAxis::kY:
      return Eigen::Vector3d::UnitY();
    case UpAxis::kZ:
      return Eigen::Vector3d::UnitZ();
    case UpAxis::kMinusX:
      return -Eigen::Vector3d::UnitX();
    case UpAxis::kMinusY:
      return -Eigen::Vector3d::UnitY();
    case UpAxis::kMinusZ:
      return -Eigen::Vector3d::UnitZ();
    case UpAxis::kAuto:
      break;
  }
  return poses.empty() ? Eigen::Vector3d(-Eigen::Vector3d::UnitY()) : automatic_up(poses);
}

Eigen::Matrix3d level_from_world(const Eigen::Vector3d& up) {
  return Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

std::vector<AssociatedPose> planar_poses(std::span<const AssociatedPose> poses, UpAxis up_estimate,
                                         UpAxis up_truth) {
  std::vector<SE3> estimates, truths;
  for (const AssociatedPose& pose : poses) estimates.push_back(pose.estimate), truths.push_back(pose.truth);
  const Eigen::Matrix3d level_estimate = level_from_world(up_direction(estimates, up_estimate));
  const Eigen::Matrix3d level_truth = level_from_world(up_direction(truths, up_truth));
  std::vector<AssociatedPose> flat;
  for (const AssociatedPose& pose : poses)
    flat.push_back({pose.timestamp, flatten(pose.estimate, level_estimate, estimates.front().rotation),
                    flatten(pose.truth, level_truth, truths.front().rotation)});
  return flat;
}

void align_headings(std::vector<AssociatedPose>& aligned_planar_poses) {
  double sine = 0, cosine = 0;
  for (const AssociatedPose& pose : aligned_planar_poses) {
    const double difference = heading(pose.estimate.rotation.transpose() * pose.truth.rotation);
    sine += std::sin(difference), cosine += std::cos(difference);
  }
  const Eigen::Matrix3d turn = about_z(std::atan2(sine, cosine));
  for (AssociatedPose& pose : aligned_planar_poses) pose.estimate.rotation = pose.estimate.rotation * turn;
}

}  // namespace spslam
