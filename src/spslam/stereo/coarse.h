// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Coarse stereo matching (3.1.3): for each left keypoint the right one with the nearest descriptor along the
// row.
#pragma once

#include <span>
#include <vector>

#include "spslam/features/types.h"
#include "spslam/stereo/options.h"
#include "spslam/stereo/types.h"

namespace spslam {

struct CoarseMatch {
  int right = -1;      // index of the right keypoint, -1 without one
  int distance = 256;  // Hamming distance, equation (3)
  StereoStatus status = StereoStatus::kNone;
};

// One entry a left keypoint. pixel_sizes: size of a pixel of each level in full-size pixels (1, 1.2, ...);
// keypoints of octaves beyond it are not matched. width and height of the full-size image in px.
std::vector<CoarseMatch> match_rows(const Features& left, const Features& right,
                                    std::span<const double> pixel_sizes, int width, int height,
                                    const StereoOptions& options);

}  // namespace spslam
