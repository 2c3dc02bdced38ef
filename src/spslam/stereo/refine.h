// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Disparities by gradient alignment of the left patch in the right image, gain and offset solved for: what
// replaces the interpolated SAD as the position of a match (SPEC, last section).
#pragma once

#include <span>
#include <vector>

#include "spslam/alignment/patch_aligner.h"
#include "spslam/features/types.h"
#include "spslam/stereo/options.h"
#include "spslam/stereo/types.h"

namespace spslam {

// Aligns every measured point from where it was measured and, with options.align_unmatched, every other point
// from what its neighbours measured. A point that does not align, does not lead back or moves too far loses
// its measurement. measurements: one a keypoint, in and out.
void align_stereo(std::span<const Keypoint> keypoints, const AlignmentPyramid& left,
                  const AlignmentPyramid& right, const StereoOptions& options,
                  std::span<StereoMeasurement> measurements);

}  // namespace spslam
