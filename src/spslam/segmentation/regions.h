// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The bright regions of an image above a threshold (paper 3.1.2, equation (2), and 4.1).
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "spslam/segmentation/options.h"

namespace spslam {

enum class Region : std::uint8_t {
  kNear = 0,
  kFar = 1,     // the sky and what borders on it
  kMirror = 2,  // a bright region below it, on water the sky's mirror image: no usable depth, and it does not
                // stand still
};

// The image smaller by a whole factor, each pixel the mean of those it stands for.
cv::Mat shrink(const cv::Mat& grey, int factor);

// Pixels of `grey` (CV_8UC1) above the threshold, the largest connected regions of them, dilated by the
// element and brought to `size` (px, that of the image `grey` is a smaller copy of, or its own). CV_8UC1 of
// Region values. Where two regions meet the upper one has the pixel: between sky and mirror image lies the
// far shore.
cv::Mat find_regions(const cv::Mat& grey, double threshold, const SegmentationOptions& options,
                     cv::Size size);

}  // namespace spslam
