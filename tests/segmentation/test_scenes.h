// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Drawn scenes near a shore: sky over land over water, with the sky's mirror image in the water.
#pragma once

#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "spslam/base/random.h"

namespace spslam::test {

inline const cv::Size kSceneSize(640, 360);

struct Scene {
  static constexpr double kRoot3 = 1.7320508;
  double sky = 200, land = 60, water = 50, mirror = 170;  // grey
  double noise = 6;                                       // grey, deviation; uniform, which is drawn fast
  double gain = 1, offset = 0;                            // of the exposure

  // The sky is above a wavy outline about 0.35 of the height, the mirror image an ellipse below 0.7 of it.
  static int outline(cv::Size size, int x) {
    return static_cast<int>(size.height * (0.35 + 0.05 * std::sin(12.0 * x / size.width)));
  }
  static cv::Rect mirror_box(cv::Size size) {
    return {size.width / 4, size.height * 7 / 10, size.width / 2, size.height / 5};
  }
  cv::Mat draw(cv::Size size, std::uint64_t seed) const {
    cv::Mat image(size, CV_8UC1, cv::Scalar(land));
    image.rowRange(size.height * 11 / 20, size.height).setTo(water);
    if (mirror > 0) {
      const cv::Rect box = mirror_box(size);
      const cv::RotatedRect oval((box.tl() + box.br()) / 2, box.size(), 0);
      cv::ellipse(image, oval, cv::Scalar(mirror), cv::FILLED);
    }
    Random random(seed);
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        auto& pixel = image.at<std::uint8_t>(y, x);
        const double grey = sky > 0 && y < outline(size, x) ? sky : pixel;
        pixel =
            cv::saturate_cast<std::uint8_t>(gain * (grey + noise * random.uniform(-kRoot3, kRoot3)) + offset);
      }
    }
    return image;
  }
};

// Intersection over union of two masks.
inline double overlap(const cv::Mat& a, const cv::Mat& b) {
  const int both = cv::countNonZero(a & b), either = cv::countNonZero(a | b);
  return either == 0 ? 1.0 : static_cast<double>(both) / either;
}

}  // namespace spslam::test
