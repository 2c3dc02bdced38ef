// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// What matches that assume nothing (pair_matches.h) say of a rig that is said to be rectified: whether rows
// correspond, whether disparities have the sign of points in front of the cameras, what there is to measure.
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "spslam/stereo/pair_matches.h"

namespace spslam {

// Row offsets as a plane over the left image, fitted robustly. A roll of one eye against the other is a slope
// over x, another focal length or pitch one over y.
struct RowOffsets {
  int matches = 0;
  double median = 0;        // px
  double spread = 0;        // px, of one offset about the plane: 1.4826 times the median deviation
  double centre = 0;        // px, the plane at the middle of the image
  double slope_x = 0;       // px per px, which is rad of roll
  double slope_y = 0;       // px per px
  double worst_corner = 0;  // px, the plane at the corner of the image where it is farthest from 0
  double corner_sigma = 0;  // px, how well that is known
  cv::Point2d middle = {};  // px, what the slopes are counted from

  double at(double x, double y) const { return centre + slope_x * (x - middle.x) + slope_y * (y - middle.y); }
};

RowOffsets measure_rows(std::span<const PairMatch> matches, cv::Size image);

// Without the matches that are not of the plane, beyond three spreads and half a pixel: most are wrong.
std::vector<PairMatch> on_rows(std::span<const PairMatch> matches, const RowOffsets& rows);

struct DisparityStatistics {
  int matches = 0;
  double quantile_1 = 0, quantile_5 = 0, median = 0, quantile_95 = 0;  // px
  double negative = 0, positive = 0;  // shares beyond -kClearDisparity and kClearDisparity
  double below_1 = 0, below_3 = 0;    // shares below 1 and 3 px
};

inline constexpr double kClearDisparity = 0.5;  // px: noise of aligned patches is a fifth of it

DisparityStatistics measure_disparities(std::span<const PairMatch> matches);

// Whether nearly all that is not at infinity lies behind the cameras.
bool seem_swapped(const DisparityStatistics& disparities);

}  // namespace spslam
