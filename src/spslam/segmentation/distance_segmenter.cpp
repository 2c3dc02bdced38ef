// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "spslam/segmentation/distance_segmenter.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "spslam/base/error.h"
#include "spslam/segmentation/regions.h"

namespace spslam {

std::vector<Region> label_keypoints(const RegionMap& regions, std::span<const Keypoint> keypoints) {
  std::vector<Region> labels;
  labels.reserve(keypoints.size());
  for (const Keypoint& keypoint : keypoints) labels.push_back(regions.at(keypoint.x, keypoint.y));
  return labels;
}

DistanceSegmenter::DistanceSegmenter(const SegmentationOptions& options) : options_(options) {
  check_options(options_);
}

// OTSU's threshold of the averaged histogram, refined, and no farther from the last one than the rate limit.
Split DistanceSegmenter::next_split(const Histogram& present) {
  window_.push_back(present);
  while (static_cast<int>(window_.size()) > options_.window) window_.pop_front();
  Histogram average{};
  for (const Histogram& past : window_) {
    for (int i = 0; i < 256; ++i) average[i] += past[i] / static_cast<double>(window_.size());
  }
  const Split best = refine_threshold(average, otsu(average));
  if (is_first()) return best;
  const double limited = std::clamp(best.threshold, last_.threshold - options_.rate_limit,
                                    last_.threshold + options_.rate_limit);
  return split_at(average, limited);
}

// Whether the bright share jumped as no motion of a boat lets it.
bool DistanceSegmenter::is_upset(double bright_share) const {
  return !is_first() && held_ < options_.hold_frames &&
         std::abs(bright_share - last_.bright_share) > options_.share_jump;
}

SegmentationResult DistanceSegmenter::update(const cv::Mat& left) {
  if (left.empty()) return {};
  if (left.type() != CV_8UC1) {
    throw InputError("segmentation: the image must be 8-bit grey (CV_8UC1), but has type " +
                     std::to_string(left.type()) + "; convert it first");
  }
  if (!is_first() && last_.regions.size != left.size()) *this = DistanceSegmenter(options_);
  const cv::Mat small = shrink(left, options_.downscale);
  const Histogram present = histogram(small);
  const Split split = next_split(present);

  SegmentationResult result;
  result.threshold = split.threshold;
  result.bimodality = split.bimodality;
  result.contrast = split.contrast();
  result.bright_share = split_at(present, split.threshold).bright_share;
  result.held = is_upset(result.bright_share);
  if (result.held) {
    // The share the mask belongs to stays, too: the jump is measured from it.
    ++held_;
    result.has_far = last_.has_far;
    result.regions = last_.regions;
    last_.threshold = result.threshold;
    return result;
  }
  held_ = 0;
  const bool is_bimodal = split.bimodality >= options_.minimum_bimodality;
  const bool has_contrast = split.contrast() >= options_.minimum_contrast;
  const bool has_both = std::min(result.bright_share, 1 - result.bright_share) >= options_.minimum_share;
  result.regions.size = left.size();
  if (is_bimodal && has_contrast && has_both) {
    result.regions = find_regions(small, split.threshold, options_, left.size());
  }
  result.has_far = !result.regions.empty();
  last_ = result;
  return result;
}

}  // namespace spslam
