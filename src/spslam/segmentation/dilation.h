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

// A region (CV_8UC1, 0 or 255) that was found in an image smaller than one of `width` px, dilated by the
// element of that width. CV_8UC1 of the region's size: at least kInside within the dilation; where the region
// has its full size exactly so, else rising towards the region, so that its outline can be interpolated.
// Empty if the region is.
constexpr int kInside = 128;
cv::Mat dilate_region(const cv::Mat& region, StructuringElement element, int width);

// Such a field at pixel (x, y) of an image of the full size, which is where it must lie.
bool is_inside(const cv::Mat& field, cv::Size size, int x, int y);

}  // namespace spslam
