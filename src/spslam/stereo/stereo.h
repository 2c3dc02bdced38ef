// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The stereo stage (3.1.3 of the paper; SPEC part 3): features of a rectified pair in, a disparity with its
// deviation for each left keypoint out. Coarse by descriptor, fine by blocks, then by gradient alignment if
// there are pyramids for it.
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "spslam/alignment/pyramid.h"
#include "spslam/features/types.h"
#include "spslam/stereo/options.h"
#include "spslam/stereo/types.h"

namespace spslam {

// One eye. What it points to must outlive the call only.
struct StereoEye {
  const Features& features;
  std::span<const cv::Mat> levels;  // CV_8UC1, the features' pyramid, level 0 full size
  const AlignmentPyramid* alignment =
      nullptr;  // needed for options.alignment; without it, blocks have the last word
};

// One measurement a left keypoint. Throws InputError if the pyramids' levels do not fit each other; empty
// features give an empty or unmeasured result. Same bits at any number of threads.
std::vector<StereoMeasurement> measure_stereo(const StereoEye& left, const StereoEye& right,
                                              const StereoOptions& options);

}  // namespace spslam
