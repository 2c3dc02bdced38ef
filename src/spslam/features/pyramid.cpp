// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "spslam/features/pyramid.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace spslam {

void ScalePyramid::build(const cv::Mat& grey, int levels, double scale) {
  CV_Assert(grey.type() == CV_8UC1);
  levels_.resize(grey.empty() ? 0 : levels);
  ratio_.clear();
  for (int i = 0; i < static_cast<int>(levels_.size()); ++i) {
    const double shrink = std::pow(scale, -i);
    const cv::Size size(static_cast<int>(std::lround(grey.cols * shrink)),
                        static_cast<int>(std::lround(grey.rows * shrink)));
    if (size.width < 1 || size.height < 1) {
      levels_.resize(i);
      break;
    }
    if (i == 0) {
      levels_[0] = grey;
    } else {
      cv::resize(levels_[i - 1], levels_[i], size, 0, 0, cv::INTER_LINEAR);
    }
    ratio_.emplace_back(static_cast<float>(grey.cols) / static_cast<float>(size.width),
                        static_cast<float>(grey.rows) / static_cast<float>(size.height));
  }
}

}  // namespace spslam
