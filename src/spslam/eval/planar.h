// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Poses in the horizontal plane, for ground truth without a height (USVInland's RTK): a 3D alignment of such
// a run, often nearly straight, is degenerate.
#pragma once

#include <span>
#include <string>

#include "spslam/eval/association.h"

namespace spslam {

enum class UpAxis { kAuto, kX, kY, kZ, kMinusX, kMinusY, kMinusZ };
std::span<const char* const> option_names(UpAxis);  // auto, x, y, z, -x, -y, -z

// The unit vector that points up in the world of the given poses (world_from_camera). kAuto: if one
// coordinate is the same in all poses, its axis (y counts down, as a camera's y does); else the cameras' mean
// up (-y), turned as little as makes the motion level, since a camera may be mounted with a pitch but a boat
// neither climbs nor sinks.
Eigen::Vector3d up_direction(std::span<const SE3> poses, UpAxis axis);

// The rotation that takes up to z by the shortest way: what is seen from above is then x to the right and y
// up the page.
Eigen::Matrix3d level_from_world(const Eigen::Vector3d& up);

// The same pairs with z up, z = 0 and rotations about z only, each relative to its first. The mean heading of
// the estimate is still its own: align_headings follows once the positions are aligned.
std::vector<AssociatedPose> planar_poses(std::span<const AssociatedPose> poses, UpAxis up_estimate,
                                         UpAxis up_truth);

// Turns every estimate about its own z by one angle so that its heading agrees with the truth's on average:
// the truth's body axes need not be the camera's.
void align_headings(std::vector<AssociatedPose>& aligned_planar_poses);

}  // namespace spslam
