// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// FAST-9 corners (Rosten, Drummond, "Machine learning for high-speed corner detection", 2006) with their
// scores. The score of every pixel is computed without branches, many pixels at a time; this costs less than
// the tests that avoid it, takes the same time for every image, and gives every threshold at once, so that
// each cell can have its own.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace spslam {

struct Corner {
  std::int16_t x = 0, y = 0;  // px
  std::uint8_t score = 0;     // the largest threshold it is still a corner at, plus one
};

// Scores of a CV_8UC1 image: CV_8UC1 of its size, 0 where the score is not above `minimum` and in a margin of
// 3 px. A pixel is a corner at threshold t if 9 contiguous pixels of the 16 on a circle of radius 3 are all
// brighter than it by more than t, or all darker; that is, if its score is above t.
void fast_scores(const cv::Mat& grey, int minimum, cv::Mat& scores);

// The local maxima (3 x 3) of the scores, at least `border` px (>= 1) from the edge, in raster order. Of
// equal neighbours the first in raster order counts.
void collect_corners(const cv::Mat& scores, int border, std::vector<Corner>& corners);

// Offset of the maximum of a corner's scores from the whole pixel: parabolas through it and its neighbours in
// x and y, each less than half a pixel.
cv::Point2f refine_corner(const cv::Mat& scores, const Corner& corner);

}  // namespace spslam
