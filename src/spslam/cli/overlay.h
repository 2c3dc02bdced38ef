// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// What the distance segmentation makes of an image, drawn as the paper's Figures 9 and 10 do.
#pragma once

#include <span>

#include "spslam/features/types.h"
#include "spslam/segmentation/regions.h"

namespace spslam {

// The image in colour (BGR), its far region tinted red, its mirror image orange, and the keypoints as dots:
// near ones green, the others as their region. No region is drawn if `regions` is empty.
cv::Mat draw_overlay(const cv::Mat& grey, const RegionMap& regions, std::span<const Keypoint> keypoints);

}  // namespace spslam
