// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/stereo/block_matcher.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "spslam/base/median.h"
#include "spslam/stereo/block.h"

namespace spslam {
namespace {

constexpr int kReverseRadius = 2;          // px, how far about the left keypoint the way back is looked for
constexpr std::size_t kMinForMedian = 10;  // fewer SADs have no median worth comparing with

struct BlockMatch {
  StereoStatus status = StereoStatus::kOutside;
  double du = 0, dv = 0;  // px of the level: where the block is in the right image, from the left one's place
  double residual = 0;    // SAD a pixel, grey values
  double uncertainty = 0;  // px of the level: residual over curvature
};

// Full-size pixels in one of the level. The level shows the whole image, so that pixel borders, not centres,
// scale; its size is rounded, so that the two directions differ a little.
cv::Point2d pixel_size(std::span<const cv::Mat> levels, int level) {
  return {static_cast<double>(levels[0].cols) / levels[level].cols,
          static_cast<double>(levels[0].rows) / levels[level].rows};
}

// The level's pixel nearest to a keypoint.
cv::Point to_level(const Keypoint& k, const cv::Point2d& pixel) {
  return {static_cast<int>(std::lround((k.x + 0.5) / pixel.x - 0.5)),
          static_cast<int>(std::lround((k.y + 0.5) / pixel.y - 0.5))};
}

struct BlockMatcher {
  std::span<const cv::Mat> left_levels, right_levels;
  const StereoOptions& options;
  int radius_v;

  // Whether the best place of the right block about the left keypoint is the keypoint: within a pixel.
  bool leads_back(const cv::Mat& left, const cv::Mat& right, const cv::Point& l, const cv::Point& r) const {
    const int margin_v = std::min(radius_v, 1);
    if (!block_inside(left, l, options.block_radius, kReverseRadius, margin_v)) return true;
    Block block = cut_block(right, r, options.block_radius);
    if (options.match_brightness) match_brightness(block, cut_block(left, l, options.block_radius));
    const cv::Point back = search_block(block, left, l, kReverseRadius, margin_v).best();
    return std::abs(back.x) <= 1 && std::abs(back.y) <= 1;
  }

  BlockMatch match(const Keypoint& l, const Keypoint& r) const {
    const cv::Mat &left = left_levels[l.octave], &right = right_levels[l.octave];
    const cv::Point2d pixel = pixel_size(left_levels, l.octave);
    const cv::Point at = to_level(l, pixel), start = to_level(r, pixel);
    BlockMatch result;
    if (!block_inside(left, at, options.block_radius, 0, 0)) return result;
    const cv::Point place = options.search_2d ? start : cv::Point(start.x, at.y);
    if (!block_inside(right, place, options.block_radius, options.search_radius, radius_v)) return result;
    Block block = cut_block(left, at, options.block_radius);
    if (options.match_brightness) match_brightness(block, cut_block(right, place, options.block_radius));
    const CostWindow window = search_block(block, right, place, options.search_radius, radius_v);
    const cv::Point best = window.best();
    result.status = StereoStatus::kWindowEdge;
    if (window.on_edge(best)) return result;
    const FiveSamples samples = window.around(best);
    const auto minimum = interpolate(samples, options.interpolation);
    result.status = StereoStatus::kNotConvex;
    if (!minimum) return result;
    const double count = (2 * options.block_radius + 1) * (2 * options.block_radius + 1);
    result.du = place.x + best.x + minimum->du - at.x;
    result.dv = place.y + best.y + minimum->dv - at.y;
    result.residual = samples.centre / count;
    result.uncertainty = samples.centre / minimum->curvature;
    const bool back = !options.left_right_check || leads_back(left, right, at, place + best);
    result.status = back ? StereoStatus::kOk : StereoStatus::kLeftRight;
    return result;
  }

  StereoMeasurement measure(const BlockMatch& match, const Keypoint& l) const {
    const cv::Point2d pixel = pixel_size(left_levels, l.octave);
    StereoMeasurement m;
    m.status = match.status;
    m.disparity = static_cast<float>(-match.du * pixel.x);
    m.row_offset = static_cast<float>(match.dv * pixel.y);
    m.sigma = static_cast<float>(
        pixel.x * std::hypot(options.block_noise.floor, options.block_noise.slope * match.uncertainty));
    const bool inside = m.disparity >= options.min_disparity * pixel.x &&
                        m.disparity <= options.max_disparity_share * left_levels[0].cols &&
                        std::abs(m.row_offset) <= options.row_tolerance * pixel.y;
    if (m.ok() && !inside) m.status = StereoStatus::kOutOfRange;
    return m;
  }
};

// A SAD far above the frame's median is a mismatch: the block found is not the same piece of the world.
void drop_outliers(std::span<StereoMeasurement> measurements, std::span<const BlockMatch> blocks,
                   double max_ratio) {
  std::vector<double> residuals;
  for (std::size_t i = 0; i < blocks.size(); ++i)
    if (measurements[i].ok()) residuals.push_back(blocks[i].residual);
  if (residuals.size() < kMinForMedian) return;
  const double limit =
      max_ratio * std::max(median(std::move(residuals)), 1.0);  // identical images have a median of 0
  for (std::size_t i = 0; i < blocks.size(); ++i)
    if (measurements[i].ok() && blocks[i].residual > limit)
      measurements[i].status = StereoStatus::kBlockOutlier;
}

}  // namespace

std::vector<StereoMeasurement> match_blocks(const Features& left, const Features& right,
                                            std::span<const CoarseMatch> matches,
                                            std::span<const cv::Mat> left_levels,
                                            std::span<const cv::Mat> right_levels,
                                            const StereoOptions& options) {
  std::vector<StereoMeasurement> measurements(matches.size());
  std::vector<BlockMatch> blocks(matches.size());
  const BlockMatcher matcher{left_levels, right_levels, options,
                             options.search_2d ? options.search_radius_rows : 0};
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, matches.size(), 64), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      measurements[i].status = matches[i].status;
      if (matches[i].status != StereoStatus::kOk) continue;
      const Keypoint& l = left.keypoints[i];
      blocks[i] = matcher.match(l, right.keypoints[matches[i].right]);
      measurements[i] = matcher.measure(blocks[i], l);
    }
  });
  drop_outliers(measurements, blocks, options.max_block_ratio);
  return measurements;
}

}  // namespace spslam
