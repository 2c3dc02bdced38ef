// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The threshold between the dark and the bright class of a histogram.
#pragma once

#include <array>
#include <opencv2/core.hpp>

namespace spslam {

using Histogram = std::array<double, 256>;  // share of the pixels of each grey value; sums to 1

Histogram histogram(const cv::Mat& grey);  // CV_8UC1, not empty

// How a histogram falls apart at a threshold: dark <= threshold < bright.
struct Split {
  double threshold = 0;                     // grey
  double dark_share = 0, bright_share = 0;  // w0, w1
  double dark_mean = 0, bright_mean = 0;    // u0, u1
  double between = 0;                       // g of equation (1): variance between the classes
  double bimodality = 0;                    // g over the total variance, 0 to 1; 0 for a flat image

  double contrast() const { return bright_mean - dark_mean; }
};

Split split_at(const Histogram& histogram, double threshold);

// The threshold of greatest g (Otsu, "A threshold selection method from gray-level histograms", 1979;
// equation (1)); the lowest of equals.
Split otsu(const Histogram& histogram);

// From a first threshold to the one in the middle between the means of its own classes, by iteration (Ridler,
// Calvard, "Picture thresholding using an iterative selection method", 1978).
Split refine_threshold(const Histogram& histogram, const Split& first);

}  // namespace spslam
