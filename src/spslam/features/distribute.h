// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Which corners become features: spread over levels and over the image, the best ones of each place first.
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "spslam/features/fast.h"
#include "spslam/features/orb_options.h"

namespace spslam {

// The candidates of one level, ordered so that the wanted ones are taken from the front.
struct RankedCorners {
  std::vector<Corner> corners;
  int strong = 0;  // so many of them pass the threshold of their cell; the rest only the lowest threshold
};

// Thins the corners to the spacing (the better one stays), gives each cell its threshold (from
// start_threshold down, until `wanted` corners spread evenly over the cells would be reached, but not below
// minimum_threshold, which the corners already passed) and orders them by rounds: first the best of each
// cell, then each cell's second, and so on; within a round by score.
RankedCorners rank_corners(std::span<const Corner> corners, cv::Size size, int wanted,
                           const OrbOptions& options);

// How many features each level gets: shares proportional to scale^(-level_exponent * level); what a level
// cannot supply goes to the others in the same proportions. The sum is `count` unless all levels together
// have less.
std::vector<int> level_quotas(std::span<const int> available, int count, const OrbOptions& options);

}  // namespace spslam
