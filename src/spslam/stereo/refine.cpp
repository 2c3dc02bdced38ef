// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/stereo/refine.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "spslam/stereo/neighbours.h"

namespace spslam {
namespace {

constexpr float kSameStart = 1.0F;  // px: alignment from a start this near ends in the same place
constexpr int kUnmatchedLevel = 1;  // half size, where alignment from the neighbours' disparity starts

struct Aligner {
  const AlignmentPyramid& left;
  const AlignmentPyramid& right;
  const StereoOptions& options;

  // known: the start is a measurement of this very point, so that only the fine levels are searched and the
  // result may not go far; otherwise it is a guess.
  StereoMeasurement align(const Keypoint& k, const StereoMeasurement& start, bool known) const {
    StereoMeasurement m = start;  // what a point that does not align keeps
    m.status = StereoStatus::kNotAligned;
    const Eigen::Vector2f point(k.x, k.y), guess(k.x - start.disparity, k.y + start.row_offset);
    AlignmentOptions patch = options.align;
    if (start.disparity > options.align_near_disparity) patch.patch_radius = options.align_near_radius;
    const Eigen::Matrix2f no_warp = Eigen::Matrix2f::Identity();
    const int first = known ? options.align_first_level : kUnmatchedLevel;
    const Alignment there = align_patch(left, point, right, guess, no_warp, patch, first);
    if (!there.ok()) return m;
    const Alignment back = align_patch(right, there.position, left, point, no_warp, patch, 0);
    if (!back.ok() || (back.position - point).norm() > static_cast<float>(options.align_max_return)) return m;
    if (known && (there.position - guess).norm() > static_cast<float>(options.align_max_move)) return m;
    // The mean of the way there and the way back: each one's error from its own template's noise is halved.
    const Eigen::Vector2f shift = there.position - point - 0.5F * (back.position - point);
    m.disparity = -shift.x();
    m.row_offset = shift.y();
    m.sigma = sigma(there, back);
    const bool inside = m.disparity >= options.min_disparity &&
                        m.disparity <= options.max_disparity_share * left.level(0).cols &&
                        std::abs(m.row_offset) <= options.align_max_row_offset;
    m.status = inside ? StereoStatus::kOk : StereoStatus::kOutOfRange;
    return m;
  }

  float sigma(const Alignment& there, const Alignment& back) const {
    const double predicted = std::sqrt(0.5 * (there.covariance(0, 0) + back.covariance(0, 0)));
    return static_cast<float>(std::hypot(options.align_noise.floor, options.align_noise.slope * predicted));
  }
};

}  // namespace

void align_stereo(std::span<const Keypoint> keypoints, const AlignmentPyramid& left,
                  const AlignmentPyramid& right, const StereoOptions& options,
                  std::span<StereoMeasurement> measurements) {
  if (left.empty() || right.empty()) return;
  const Aligner aligner{left, right, options};
  const cv::Size size = left.level(0).size();
  const auto align_if = [&](auto&& start_of) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, keypoints.size(), 32), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) start_of(i);
    });
  };
  align_if([&](std::size_t i) {
    if (measurements[i].ok()) measurements[i] = aligner.align(keypoints[i], measurements[i], true);
  });
  if (!options.align_unmatched) return;
  const Neighbours neighbours(keypoints, measurements, size);
  align_if([&](std::size_t i) {
    if (measurements[i].ok()) return;
    const StereoMeasurement guess = neighbours.guess(keypoints[i]);
    const bool tried = measurements[i].status == StereoStatus::kNotAligned &&
                       std::abs(measurements[i].disparity - guess.disparity) < kSameStart;
    if (tried) return;
    const StereoMeasurement found = aligner.align(keypoints[i], guess, false);
    if (found.ok()) measurements[i] = found;
  });
}

}  // namespace spslam
