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

// `shrunk` px of the image stand for one of the region.
cv::Size rectangle_size(int width, double shrunk = 1) {
  const auto odd = [&](int half) {
    return 2 * static_cast<int>(std::lround(half * width / (kWidth * shrunk))) + 1;
  };
  return {odd(12), odd(7)};
}

// A disc's dilation is what lies no farther than its radius from the region; that takes one distance
// transform for any radius, and the distance can be interpolated.
cv::Mat dilate_by_disc(const cv::Mat& region, double radius, double shrunk) {
  cv::Mat outside, distance, field;
  cv::compare(region, 0, outside, cv::CMP_EQ);
  cv::distanceTransform(outside, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  if (shrunk == 1) return distance <= radius;
  distance.convertTo(field, CV_8U, -16, kInside + 16 * radius / shrunk);
  return field;
}

}  // namespace

cv::Mat structuring_element(StructuringElement element, int width) {
  if (element == StructuringElement::kRect25x15) return cv::Mat::ones(rectangle_size(width), CV_8UC1);
  return disc(disc_radius(element, width));
}

cv::Mat dilate_region(const cv::Mat& region, StructuringElement element, int width) {
  if (cv::countNonZero(region) == 0) return {};
  const double shrunk = static_cast<double>(width) / region.cols;
  if (element != StructuringElement::kRect25x15)
    return dilate_by_disc(region, disc_radius(element, width), shrunk);
  cv::Mat field;
  cv::dilate(region, field, cv::Mat::ones(rectangle_size(width, shrunk), CV_8UC1));
  return field;
}

bool is_inside(const cv::Mat& field, cv::Size size, int x, int y) {
  if (field.empty()) return false;
  if (field.size() == size) return field.at<std::uint8_t>(y, x) >= kInside;
  // Half pixels as in cv::resize, then between the four around.
  const float u = std::clamp((x + 0.5F) * field.cols / size.width - 0.5F, 0.0F, field.cols - 1.0F);
  const float v = std::clamp((y + 0.5F) * field.rows / size.height - 0.5F, 0.0F, field.rows - 1.0F);
  const int left = static_cast<int>(u), top = static_cast<int>(v);
  const int right = std::min(left + 1, field.cols - 1), bottom = std::min(top + 1, field.rows - 1);
  const float du = u - static_cast<float>(left), dv = v - static_cast<float>(top);
  const std::uint8_t *above = field.ptr<std::uint8_t>(top), *below = field.ptr<std::uint8_t>(bottom);
  const float upper = above[left] * (1 - du) + above[right] * du;
  const float lower = below[left] * (1 - du) + below[right] * du;
  return upper * (1 - dv) + lower * dv >= kInside;
}

}  // namespace spslam
