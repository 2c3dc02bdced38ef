// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The image pyramid that patches are aligned in: each level half the size of the one below, with a border
// around it.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace spslam {

class AlignmentPyramid {
 public:
  static constexpr int kBorder =
      24;  // px around each level; a patch whose centre is inside may be read without checks

  AlignmentPyramid() = default;
  // grey: CV_8UC1, not empty. levels >= 1; fewer are made when the image gets smaller than a patch.
  // measure_noise: only AlignmentOptions::noise_factor asks for it.
  AlignmentPyramid(const cv::Mat& grey, int levels, bool measure_noise = false);

  // Level 0 blurred by a Gaussian (standard deviation in px, above 0), the coarser ones as they are and
  // shared. Not of an empty one.
  AlignmentPyramid softened(double sigma) const;

  int size() const { return static_cast<int>(levels_.size()); }
  bool empty() const { return levels_.empty(); }
  // The level without its border; a pixel x of the full-size image lies at x / 2^level.
  const cv::Mat& level(int i) const { return levels_[i]; }
  // Standard deviation of the full-size image's noise, grey values: from the second differences where it is
  // smoothest (Immerkaer, "Fast noise variance estimation", 1996). Overestimated where nothing is smooth; 0
  // if it was not measured.
  float noise() const { return noise_; }

 private:
  std::vector<cv::Mat> levels_;  // views into bordered images
  float noise_ = 0;
};

}  // namespace spslam
