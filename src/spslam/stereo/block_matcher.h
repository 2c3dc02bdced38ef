// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Fine stereo matching (3.1.3): blocks around coarse matches, compared on the keypoint's level, to part of a
// pixel.
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "spslam/features/types.h"
#include "spslam/stereo/coarse.h"
#include "spslam/stereo/options.h"
#include "spslam/stereo/types.h"

namespace spslam {

// Disparity and row offset of every coarse match, one entry a left keypoint; those without a match keep its
// status. Levels: CV_8UC1, each the whole image at another size, level 0 full size, the same sizes left and
// right.
std::vector<StereoMeasurement> match_blocks(const Features& left, const Features& right,
                                            std::span<const CoarseMatch> matches,
                                            std::span<const cv::Mat> left_levels,
                                            std::span<const cv::Mat> right_levels,
                                            const StereoOptions& options);

}  // namespace spslam
