// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Images to find features in, the same on every run.
#pragma once

#include <algorithm>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "spslam/base/random.h"

namespace spslam::test {

// Overlapping rectangles and discs of random grey on grey ground, as corners and edges of all sizes.
inline cv::Mat shapes_image(cv::Size size, std::uint64_t seed, int count = 400) {
  Random random(seed);
  cv::Mat image(size, CV_8UC1, cv::Scalar(128));
  for (int i = 0; i < count; ++i) {
    const cv::Point centre(static_cast<int>(random.below(size.width)),
                           static_cast<int>(random.below(size.height)));
    const double side = random.uniform(4, 40);
    const cv::Scalar grey(random.uniform(20, 235));
    if (i % 3 == 0) {
      cv::circle(image, centre, static_cast<int>(side / 2), grey, cv::FILLED, cv::LINE_AA);
    } else {
      const cv::RotatedRect box(
          centre, {static_cast<float>(side), static_cast<float>(side * random.uniform(0.3, 1.0))},
          static_cast<float>(random.uniform(0, 180)));
      cv::Point2f corners[4];
      box.points(corners);
      const cv::Point polygon[4] = {corners[0], corners[1], corners[2], corners[3]};
      cv::fillConvexPoly(image, polygon, 4, grey, cv::LINE_AA);
    }
  }
  return image;
}

// gain * image + offset + normal noise, clipped to 8 bit.
inline cv::Mat with_noise(const cv::Mat& image, double sigma, std::uint64_t seed, double gain = 1,
                          double offset = 0) {
  Random random(seed);
  cv::Mat result = image.clone();
  for (int y = 0; y < result.rows; ++y) {
    for (int x = 0; x < result.cols; ++x) {
      auto& pixel = result.at<std::uint8_t>(y, x);
      pixel = cv::saturate_cast<std::uint8_t>(gain * pixel + offset + sigma * random.normal());
    }
  }
  return result;
}

}  // namespace spslam::test
