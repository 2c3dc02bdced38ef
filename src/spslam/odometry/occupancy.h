// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The places of an image that are taken, so that landmarks keep their distance.
#pragma once

#include <opencv2/core.hpp>

#include "spslam/camera/stereo_rig.h"

namespace spslam {

class Occupancy {
 public:
  Occupancy(const StereoRig& rig, double spacing)
      : taken_(rig.height, rig.width, CV_8UC1, cv::Scalar(0)), radius_(static_cast<int>(spacing)) {}
  // True outside of the image, too.
  bool is_taken(int x, int y) const {
    return !image().contains({x, y}) || taken_.at<unsigned char>(y, x) != 0;
  }
  void take(const Eigen::Vector2d& at) {
    const cv::Rect box(static_cast<int>(at.x()) - radius_, static_cast<int>(at.y()) - radius_,
                       2 * radius_ + 1, 2 * radius_ + 1);
    taken_(box & image()).setTo(255);
  }

 private:
  cv::Rect image() const { return {0, 0, taken_.cols, taken_.rows}; }

  cv::Mat taken_;
  int radius_;
};

}  // namespace spslam
