// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "spslam/features/orb_extractor.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "spslam/base/error.h"
#include "spslam/features/brief.h"
#include "spslam/features/orientation.h"

namespace spslam {
namespace {

constexpr int kGrain = 128;  // features a task describes

std::string size_text(cv::Size size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

// Sets the pixels of a disc to 0 where it lies in the image.
void block_disc(cv::Mat& free, cv::Point2f centre, float radius) {
  const int top = std::max(0, static_cast<int>(std::ceil(centre.y - radius)));
  const int bottom = std::min(free.rows - 1, static_cast<int>(std::floor(centre.y + radius)));
  for (int y = top; y <= bottom; ++y) {
    const float dy = static_cast<float>(y) - centre.y;
    const float half = std::sqrt(std::max(0.0F, radius * radius - dy * dy));
    const int left = std::max(0, static_cast<int>(std::ceil(centre.x - half)));
    const int right = std::min(free.cols - 1, static_cast<int>(std::floor(centre.x + half)));
    if (left <= right) std::fill_n(free.ptr<std::uint8_t>(y) + left, right - left + 1, std::uint8_t{0});
  }
}

}  // namespace

OrbExtractor::OrbExtractor(const OrbOptions& options) : options_(options) {
  check_options(options_);
}

void OrbExtractor::set_image(const cv::Mat& grey) {
  if (!grey.empty() && grey.type() != CV_8UC1) {
    throw InputError("features: the image must be 8-bit grey (CV_8UC1), but has type " +
                     std::to_string(grey.type()) + "; convert it first");
  }
  pyramid_.build(grey, options_.levels, options_.scale);
  levels_.resize(pyramid_.size());
  for (Level& level : levels_) level.is_smooth = false;
}

Features OrbExtractor::extract(const cv::Mat& grey, const OrbRequest& request) {
  set_image(grey);
  Features features;
  features.keypoints = detect(request);
  features.descriptors = describe(features.keypoints);
  return features;
}

// The mask of the request with the occupied places cut out; empty if nothing is excluded.
cv::Mat OrbExtractor::free_places(const OrbRequest& request) {
  const cv::Size size = pyramid_[0].size();
  if (!request.allowed.empty() && (request.allowed.size() != size || request.allowed.type() != CV_8UC1)) {
    throw InputError("features: the mask (" + size_text(request.allowed.size()) +
                     ") must be CV_8UC1 of the image's size " + size_text(size));
  }
  if (request.occupied.empty()) return request.allowed;
  if (request.allowed.empty()) {
    free_.create(size, CV_8UC1);
    free_.setTo(255);
  } else {
    request.allowed.copyTo(free_);
  }
  for (const cv::Point2f& at : request.occupied) block_disc(free_, at, request.radius);
  return free_;
}

void OrbExtractor::find_corners(int index, int wanted, const cv::Mat& free) {
  Level& level = levels_[index];
  const cv::Mat& grey = pyramid_[index];
  fast_scores(grey, std::min(options_.minimum_threshold, options_.start_threshold), level.scores);
  collect_corners(level.scores, options_.border, level.corners);
  if (!free.empty()) {
    std::erase_if(level.corners, [&](const Corner& corner) {
      const cv::Point2f at = pyramid_.to_full(cv::Point2f(corner.x, corner.y), index);
      return free.at<std::uint8_t>(std::min(cvRound(at.y), free.rows - 1),
                                   std::min(cvRound(at.x), free.cols - 1)) == 0;
    });
  }
  level.ranked = rank_corners(level.corners, grey.size(), wanted, options_);
}

Keypoint OrbExtractor::make_keypoint(const Corner& corner, int level) const {
  cv::Point2f at(corner.x, corner.y);
  if (options_.subpixel) at += refine_corner(levels_[level].scores, corner);
  at = pyramid_.to_full(at, level);
  Patch patch;
  copy_patch(pyramid_[level], corner.x, corner.y, patch);
  return {at.x, at.y, patch_orientation(patch), static_cast<float>(corner.score),
          static_cast<std::uint8_t>(level)};
}

std::vector<Keypoint> OrbExtractor::detect(const OrbRequest& request) {
  const int count = request.count > 0 ? request.count : options_.count;
  const int level_count = pyramid_.size();
  if (level_count == 0) return {};
  const cv::Mat free = free_places(request);
  const std::vector<int> plenty(level_count, count);
  const std::vector<int> wanted = level_quotas(plenty, count, options_);
  tbb::parallel_for(0, level_count, [&](int i) { find_corners(i, wanted[i], free); });

  std::vector<int> available(level_count);
  for (int i = 0; i < level_count; ++i) available[i] = static_cast<int>(levels_[i].ranked.corners.size());
  const std::vector<int> quota = level_quotas(available, count, options_);
  std::vector<int> begin(level_count, 0);
  std::exclusive_scan(quota.begin(), quota.end(), begin.begin(), 0);
  std::vector<Keypoint> keypoints(begin.back() + quota.back());
  tbb::parallel_for(0, level_count, [&](int i) {
    for (int k = 0; k < quota[i]; ++k)
      keypoints[begin[i] + k] = make_keypoint(levels_[i].ranked.corners[k], i);
  });
  return keypoints;
}

cv::Point OrbExtractor::pixel_of(const Keypoint& keypoint) const {
  if (keypoint.octave >= pyramid_.size()) {
    throw InputError("features: keypoint on level " + std::to_string(keypoint.octave) +
                     ", but the image has only " + std::to_string(pyramid_.size()));
  }
  const cv::Point2f at = pyramid_.to_level({keypoint.x, keypoint.y}, keypoint.octave);
  const cv::Size size = pyramid_[keypoint.octave].size();
  // Half a pixel of a level is up to two of the full size, so the edge itself may round outwards.
  const bool inside = at.x >= -1.0F && at.y >= -1.0F && at.x <= static_cast<float>(size.width) &&
                      at.y <= static_cast<float>(size.height);
  if (!inside) {
    throw InputError("features: keypoint at (" + std::to_string(keypoint.x) + ", " +
                     std::to_string(keypoint.y) + ") lies outside the image of " +
                     size_text(pyramid_[0].size()));
  }
  return {std::clamp(cvRound(at.x), 0, size.width - 1), std::clamp(cvRound(at.y), 0, size.height - 1)};
}

void OrbExtractor::orient(std::span<Keypoint> keypoints) const {
  for (Keypoint& keypoint : keypoints) {
    const cv::Point pixel = pixel_of(keypoint);
    Patch patch;
    copy_patch(pyramid_[keypoint.octave], pixel.x, pixel.y, patch);
    keypoint.angle = patch_orientation(patch);
  }
}

std::vector<Descriptor> OrbExtractor::describe(std::span<const Keypoint> keypoints) {
  std::vector<bool> used(pyramid_.size(), false);
  std::vector<cv::Point> pixels(keypoints.size());
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    pixels[i] = pixel_of(keypoints[i]);
    used[keypoints[i].octave] = true;
  }
  tbb::parallel_for(0, pyramid_.size(), [&](int i) {
    if (!used[i] || levels_[i].is_smooth) return;
    smooth(pyramid_[i], levels_[i].smoothed);
    levels_[i].is_smooth = true;
  });
  std::vector<Descriptor> descriptors(keypoints.size());
  const tbb::blocked_range<std::size_t> all(0, keypoints.size(), kGrain);
  tbb::parallel_for(all, [&](const tbb::blocked_range<std::size_t>& range) {
    Patch patch;
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      copy_patch(levels_[keypoints[i].octave].smoothed, pixels[i].x, pixels[i].y, patch);
      descriptors[i] = describe_patch(patch, keypoints[i].angle);
    }
  });
  return descriptors;
}

}  // namespace spslam
