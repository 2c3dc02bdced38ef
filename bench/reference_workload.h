// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// A fixed piece of image work to compare times with: machines differ, and so does one machine from hour to
// hour. Change nothing here, or old figures mean nothing any more.
#pragma once

#include <chrono>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "spslam/base/random.h"

namespace spslam::bench {

class ReferenceWorkload {
 public:
  // 640 x 360 px, 1500 grey boxes, noise of 4 grey values; the same on every machine.
  ReferenceWorkload() : image_(360, 640, CV_8UC1, cv::Scalar(128)) {
    Random random(1);
    for (int i = 0; i < 1500; ++i) {
      const cv::Point at(static_cast<int>(random.below(640)), static_cast<int>(random.below(360)));
      const cv::Size size(4 + static_cast<int>(random.below(36)), 4 + static_cast<int>(random.below(36)));
      cv::rectangle(image_, cv::Rect(at, size), cv::Scalar(20 + random.below(215)), cv::FILLED);
    }
    for (auto it = image_.begin<std::uint8_t>(); it != image_.end<std::uint8_t>(); ++it)
      *it = cv::saturate_cast<std::uint8_t>(*it + 4 * random.normal());
  }

  // Seconds of wall time for ten times Gaussian blur (7 x 7, sigma 2) and FAST (threshold 20, suppressed) on
  // one core.
  double run() {
    const int threads = cv::getNumThreads();
    cv::setNumThreads(1);
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < 10; ++i) {
      cv::GaussianBlur(image_, smoothed_, cv::Size(7, 7), 2, 2);
      cv::FAST(smoothed_, corners_, 20, true);
      cv::FAST(image_, corners_, 20, true);
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    cv::setNumThreads(threads);
    return seconds;
  }
  std::size_t corners() const { return corners_.size(); }

 private:
  cv::Mat image_, smoothed_;
  std::vector<cv::KeyPoint> corners_;
};

}  // namespace spslam::bench
