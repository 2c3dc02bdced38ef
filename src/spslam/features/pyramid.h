// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The image pyramid that corners are sought in.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace spslam {

class ScalePyramid {
 public:
  // Builds `levels` levels, each smaller by `scale`, from a CV_8UC1 image; buffers are reused from call to
  // call. Level 0 refers to the image itself. Levels that would be smaller than one pixel are left out.
  void build(const cv::Mat& grey, int levels, double scale);

  int size() const { return static_cast<int>(levels_.size()); }
  const cv::Mat& operator[](int level) const { return levels_[level]; }

  // Positions between a level and the full size: resizing keeps the outer edges of the image, so that pixel
  // centres shift by half a pixel. The ratio is that of the true (rounded) sizes.
  cv::Point2f to_full(cv::Point2f at, int level) const {
    return {(at.x + 0.5F) * ratio_[level].x - 0.5F, (at.y + 0.5F) * ratio_[level].y - 0.5F};
  }
  cv::Point2f to_level(cv::Point2f at, int level) const {
    return {(at.x + 0.5F) / ratio_[level].x - 0.5F, (at.y + 0.5F) / ratio_[level].y - 0.5F};
  }

 private:
  std::vector<cv::Mat> levels_;
  std::vector<cv::Point2f> ratio_;  // full size over level
};

}  // namespace spslam
