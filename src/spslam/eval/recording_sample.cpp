// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/eval/recording_sample.h"

#include <algorithm>
#include <cmath>

#include "spslam/base/median.h"

namespace spslam {
namespace {

bool are_equal(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::countNonZero(a != b) == 0;
}

bool is_usable(const StereoFrame& frame) {
  return !frame.left.empty() && !frame.right.empty();
}

}  // namespace

ImageStatistics measure_image(const cv::Mat& grey) {
  ImageStatistics result;
  const auto pixels = static_cast<double>(grey.total());
  result.saturated = cv::countNonZero(grey >= 254) / pixels;
  result.black = cv::countNonZero(grey <= 1) / pixels;
  cv::Scalar mean, deviation;
  cv::meanStdDev(grey, mean, deviation);
  result.mean = mean[0];
  result.contrast = deviation[0];
  return result;
}

TimeSteps measure_times(std::span<const double> times) {
  TimeSteps steps;
  if (times.size() < 2) return steps;
  std::vector<double> intervals, deviations;
  for (std::size_t i = 1; i < times.size(); ++i) intervals.push_back(times[i] - times[i - 1]);
  steps.intervals = static_cast<int>(intervals.size());
  steps.median = median(intervals);
  for (const double interval : intervals) {
    deviations.push_back(std::abs(interval - steps.median));
    steps.longest = std::max(steps.longest, interval);
    steps.gaps += interval > 1.75 * steps.median;
    steps.short_ones += interval < 0.5 * steps.median;
  }
  steps.jitter = 1.4826 * median(std::move(deviations));
  return steps;
}

SampledPair measure_pair(PairMatcher& matcher, const StereoFrame& pair, const StereoFrame& before,
                         const StereoFrame& after) {
  SampledPair result;
  result.left = measure_image(pair.left);
  result.right = measure_image(pair.right);
  result.eyes_are_equal = are_equal(pair.left, pair.right);
  const EyeFeatures left = matcher.prepare(pair.left), right = matcher.prepare(pair.right);
  result.corners = static_cast<int>(left.features.keypoints.size());
  result.matches = match_pair(left, right);
  result.has_neighbours = is_usable(before) && is_usable(after);
  if (!result.has_neighbours) return result;
  result.before = match_pair(matcher.prepare(before.left), right);
  result.after = match_pair(matcher.prepare(after.left), right);
  result.left_repeats = are_equal(pair.left, after.left);
  result.right_repeats = are_equal(pair.right, after.right);
  return result;
}

}  // namespace spslam
