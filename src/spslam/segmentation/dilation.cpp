// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "spslam/segmentation/dilation.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace spslam {
namespace {

constexpr double kWidth = 640;  // px, the image width that the sizes are meant for

double disc_radius(StructuringElement element, int width) {
  return (element == StructuringElement::kDisc15 ? 15 : 25) * width / kWidth;
}

cv::Mat disc(double radius) {
  const int half = static_cast<int>(std::floor(radius));
  cv::Mat element(2 * half + 1, 2 * half + 1, CV_8UC1);
  for (int y = -half; y <= half; ++y) {
    for (int x = -half; x <= half; ++x)
      element.at<std::uint8_t>(y + half, x + half) = std::hypot(x, y) <= radius ? 1 : 0;
  }
  return element;
}

cv::Size rectangle_size(int width) {
  const auto odd = [&](int half) { return 2 * static_cast<int>(std::lround(half * width / kWidth)) + 1; };
  return {odd(12), odd(7)};
}

cv::Mat enlarge(const cv::Mat& small, cv::Size size) {
  if (small.size() == size) return small;
  cv::Mat large;
  cv::resize(small, large, size, 0, 0, cv::INTER_LINEAR);
  return large;
}

// A disc's dilation is what lies no farther than its radius from the region; that takes one distance
// transform for any radius, and the distance can be interpolated.
cv::Mat dilate_by_disc(const cv::Mat& region, double radius, cv::Size size) {
  const double scale = static_cast<double>(size.width) / region.cols;
  cv::Mat outside, distance, near;
  cv::compare(region, 0, outside, cv::CMP_EQ);
  cv::distanceTransform(outside, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  if (scale == 1) return distance <= radius;
  // 128 at the radius, 16 steps a small pixel: bytes are enlarged faster than floats.
  distance.convertTo(near, CV_8U, -16, 128.5 + 16 * radius / scale);
  return enlarge(near, size) >= 128;
}

}  // namespace

cv::Mat structuring_element(StructuringElement element, int width) {
  if (element == StructuringElement::kRect25x15) return cv::Mat::ones(rectangle_size(width), CV_8UC1);
  return disc(disc_radius(element, width));
}

cv::Mat dilate_region(const cv::Mat& region, StructuringElement element, cv::Size size) {
  if (cv::countNonZero(region) == 0) return cv::Mat(size, CV_8UC1, cv::Scalar(0));
  if (element != StructuringElement::kRect25x15)
    return dilate_by_disc(region, disc_radius(element, size.width), size);
  cv::Mat dilated;
  cv::dilate(enlarge(region, size) >= 128, dilated, structuring_element(element, size.width));
  return dilated;
}

}  // namespace spslam
