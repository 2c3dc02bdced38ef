// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The rigid motion or similarity that lays an estimated trajectory on the true one. (Umeyama, "Least-squares
// estimation of transformation parameters between two point patterns", PAMI 1991.)
#pragma once

#include <span>
#include <string>

#include "spslam/eval/association.h"

namespace spslam {

enum class AlignMode { kNone, kSe3, kSim3 };
std::span<const char* const> option_names(AlignMode);  // none, se3, sim3

// x_in_truth = scale * rotation * x_in_estimate + translation.
struct Similarity {
  double scale = 1;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  // m

  SE3 operator*(const SE3& pose) const {
    return {rotation * pose.rotation, scale * rotation * pose.translation + translation};
  }
};

struct AlignResult {
  Similarity truth_from_estimate;
  std::string degenerate;  // why the positions do not determine the alignment; empty if they do
  bool has_scale = false;  // false where it was not asked for or the boat stands still
};

// Least squares over the positions of all pairs; kNone gives the identity. With planar only rotations about z
// are considered and z is left alone (the poses are planar_poses'). A straight run leaves the turn about its
// line open, one that stands still every turn and the scale: both are said in the result, whose error is
// nevertheless the smallest possible.
AlignResult align_positions(std::span<const AssociatedPose> poses, AlignMode mode, bool planar);

// The same pairs with each estimate taken to the world of the truth.
std::vector<AssociatedPose> aligned_poses(const Similarity& truth_from_estimate,
                                          std::span<const AssociatedPose> poses);

}  // namespace spslam
