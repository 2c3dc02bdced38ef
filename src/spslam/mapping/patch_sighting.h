// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Where a keyframe sees the very point that another one hosts: a descriptor says which corner it is, to a
// pixel or two; aligning the host's patch says where it is, to a tenth.
#pragma once

#include <optional>

#include "spslam/alignment/patch_aligner.h"
#include "spslam/camera/stereo_rig.h"
#include "spslam/map/types.h"

namespace spslam {

// What the motion does to small offsets (px) around a point of the host: its derivative at the prediction.
Eigen::Matrix2f patch_warp(const StereoRig& rig, const SE3& camera_from_host, const Eigen::Vector3d& bearing,
                           double inverse_depth);

// The position (px) in `camera` of the landmark's patch in `host`, sought around `start`. Nothing if one of
// the keyframes has no image any more, the point is behind, nothing looks alike, or it is farther from the
// start than max_move.
std::optional<Eigen::Vector2d> find_patch(const StereoRig& rig, const Keyframe& host,
                                          const Landmark& landmark, const Keyframe& camera,
                                          const Eigen::Vector2d& start, double max_move,
                                          const AlignmentOptions& options);

}  // namespace spslam
