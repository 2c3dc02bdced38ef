// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Growing a region by a structuring element (paper 3.1.2, Figure 4).
#pragma once

#include <opencv2/core.hpp>

#include "spslam/segmentation/options.h"

namespace spslam {

// The element for an image of this width (px): discs of radius 25 or 15 px, a rectangle of 25 x 15 px, for
// 640 px, and scaled with the width. CV_8UC1, 1 inside, odd sides.
cv::Mat structuring_element(StructuringElement element, int width);

// A region, CV_8UC1, 0 or 255, found in an image smaller than `size`, dilated by the element of size.width
// and brought to `size`. Exact if the region already has this size; else its outline is interpolated between
// the small image's pixels.
cv::Mat dilate_region(const cv::Mat& region, StructuringElement element, cv::Size size);

}  // namespace spslam
