// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/stereo/stereo.h"

#include <string>

#include "spslam/base/error.h"
#include "spslam/stereo/block_matcher.h"
#include "spslam/stereo/coarse.h"
#include "spslam/stereo/refine.h"

namespace spslam {
namespace {

constexpr float kCoarseSigma = 0.6F;  // px, of a disparity taken from the keypoints alone

void check_levels(std::span<const cv::Mat> left, std::span<const cv::Mat> right) {
  const auto fail = [](const std::string& what) {
    throw InputError("stereo: " + what +
                     "; give the pyramids of one rectified pair, grey and of the same options");
  };
  if (left.size() != right.size())
    fail("left has " + std::to_string(left.size()) + " levels, right " + std::to_string(right.size()));
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (left[i].empty() || left[i].type() != CV_8UC1 || right[i].type() != CV_8UC1)
      fail("level " + std::to_string(i) + " is not an 8-bit grey image");
    if (left[i].size() != right[i].size())
      fail("level " + std::to_string(i) + " differs in size between the eyes");
  }
}

// The keypoints' own positions, the plainest measurement.
std::vector<StereoMeasurement> from_keypoints(const Features& left, const Features& right,
                                              std::span<const CoarseMatch> matches) {
  std::vector<StereoMeasurement> measurements(matches.size());
  for (std::size_t i = 0; i < matches.size(); ++i) {
    measurements[i].status = matches[i].status;
    if (matches[i].status != StereoStatus::kOk) continue;
    const Keypoint &l = left.keypoints[i], &r = right.keypoints[matches[i].right];
    measurements[i] = {l.x - r.x, kCoarseSigma, r.y - l.y, StereoStatus::kOk};
  }
  return measurements;
}

}  // namespace

StereoOptions paper_stereo_options() {
  StereoOptions options;
  options.block_matching = true;
  options.match_brightness = false;
  options.alignment = false;
  return options;
}

StereoOptions baseline_stereo_options() {
  StereoOptions options = paper_stereo_options();
  options.search_2d = false;
  options.interpolation = Interpolation::kParabola;
  return options;
}

std::vector<StereoMeasurement> measure_stereo(const StereoEye& left, const StereoEye& right,
                                              const StereoOptions& options) {
  check_levels(left.levels, right.levels);
  std::vector<StereoMeasurement> measurements(left.features.keypoints.size());
  if (left.levels.empty()) return measurements;
  const cv::Size size = left.levels[0].size();
  std::vector<double> pixel_sizes;
  for (const cv::Mat& level : left.levels)
    pixel_sizes.push_back(static_cast<double>(size.width) / level.cols);
  const std::vector<CoarseMatch> matches =
      match_rows(left.features, right.features, pixel_sizes, size.width, size.height, options);
  measurements = options.block_matching ? match_blocks(left.features, right.features, matches, left.levels,
                                                       right.levels, options)
                                        : from_keypoints(left.features, right.features, matches);
  if (options.alignment && left.alignment != nullptr && right.alignment != nullptr)
    align_stereo(left.features.keypoints, *left.alignment, *right.alignment, options, measurements);
  return measurements;
}

}  // namespace spslam
