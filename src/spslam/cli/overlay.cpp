// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/cli/overlay.h"

#include <opencv2/imgproc.hpp>

namespace spslam {
namespace {

const cv::Scalar kGreen(0, 220, 0), kRed(0, 0, 255), kOrange(0, 150, 255);  // BGR

cv::Scalar colour(Region region) {
  if (region == Region::kFar) return kRed;
  return region == Region::kMirror ? kOrange : kGreen;
}

}  // namespace

cv::Mat draw_overlay(const cv::Mat& grey, const RegionMap& regions, std::span<const Keypoint> keypoints) {
  cv::Mat picture;
  cv::cvtColor(grey, picture, cv::COLOR_GRAY2BGR);
  for (const Region region : {Region::kFar, Region::kMirror}) {
    if (regions.empty()) break;
    cv::Mat tinted;
    cv::addWeighted(picture, 0.8, cv::Mat(picture.size(), CV_8UC3, colour(region)), 0.2, 0, tinted);
    tinted.copyTo(picture, regions.labels() == static_cast<int>(region));
  }
  const int radius = std::max(1, picture.cols / 320);
  for (const Keypoint& keypoint : keypoints) {
    const cv::Point at(cvRound(keypoint.x), cvRound(keypoint.y));
    cv::circle(picture, at, radius, colour(regions.at(keypoint.x, keypoint.y)), cv::FILLED, cv::LINE_AA);
  }
  return picture;
}

}  // namespace spslam
