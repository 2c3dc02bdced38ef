// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/mapping/patch_sighting.h"

namespace spslam {
namespace {

constexpr int kFirstLevel = 1;  // half size: alignment there bridges the few pixels a descriptor leaves open

}  // namespace

Eigen::Matrix2f patch_warp(const StereoRig& rig, const SE3& camera_from_host, const Eigen::Vector3d& bearing,
                           double inverse_depth) {
  const Eigen::Vector3d x =
      camera_from_host.rotation * bearing + inverse_depth * camera_from_host.translation;
  const double iz = 1 / x.z();
  Eigen::Matrix<double, 2, 3> by_x;
  by_x << rig.fx * iz, 0, -rig.fx * x.x() * iz * iz, 0, rig.fy * iz, -rig.fy * x.y() * iz * iz;
  Eigen::Matrix<double, 3, 2> by_pixel = camera_from_host.rotation.leftCols<2>();
  by_pixel.col(0) /= rig.fx;
  by_pixel.col(1) /= rig.fy;
  return (by_x * by_pixel).cast<float>();
}

std::optional<Eigen::Vector2d> find_patch(const StereoRig& rig, const Keyframe& host,
                                          const Landmark& landmark, const Keyframe& camera,
                                          const Eigen::Vector2d& start, double max_move,
                                          const AlignmentOptions& options) {
  if (host.left.empty() || camera.left.empty() || !start.allFinite()) return std::nullopt;
  const SE3 motion = camera.camera_from_world * host.camera_from_world.inverse();
  const Eigen::Vector3d x = motion.rotation * landmark.bearing + landmark.inverse_depth * motion.translation;
  if (!(x.z() > 1e-3)) return std::nullopt;
  const Eigen::Matrix2f warp = patch_warp(rig, motion, landmark.bearing, landmark.inverse_depth);
  const Alignment found =
      align_patch(host.left, landmark.pixel, camera.left, start.cast<float>(), warp, options, kFirstLevel);
  if (!found.ok()) return std::nullopt;
  const Eigen::Vector2d at = found.position.cast<double>();
  const bool is_inside = at.x() >= 0 && at.y() >= 0 && at.x() <= rig.width - 1 && at.y() <= rig.height - 1;
  if (!is_inside || !((at - start).norm() <= max_move)) return std::nullopt;
  return at;
}

}  // namespace spslam
