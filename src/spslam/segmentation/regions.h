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

// Where the regions of an image lie, kept as small as they were found: two fields of dilate_region, empty for
// a region that is not there.
struct RegionMap {
  cv::Size size;        // px, of the image
  cv::Mat far, mirror;  // CV_8UC1

  bool empty() const { return far.empty() && mirror.empty(); }
  // The region of the nearest pixel; near outside of the image. Where two regions meet the upper one has the
  // pixel: between the sky and its mirror image lies the far shore.
  Region at(float x, float y) const;
  // Region values of all pixels, CV_8UC1 of `size`.
  cv::Mat labels() const;
  // 255 where the pixel is not near (sky and mirror image, as the paper has it), else 0; CV_8UC1 of `size`.
  cv::Mat mask() const;
};

// Pixels of `grey` (CV_8UC1) above the threshold and the largest connected regions of them, dilated. `size`
// is that of the image which `grey` is a smaller copy of, or its own.
RegionMap find_regions(const cv::Mat& grey, double threshold, const SegmentationOptions& options,
                       cv::Size size);

}  // namespace spslam
