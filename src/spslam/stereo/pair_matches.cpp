// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/stereo/pair_matches.h"

#include <cmath>
#include <optional>

#include "spslam/alignment/patch_aligner.h"

namespace spslam {
namespace {

constexpr double kDisparityShare = 0.25;  // of the width, to both sides: swapped eyes are to be found
constexpr double kRowShare = 0.08;        // of the height: an unrectified rig is to be measured, not missed
constexpr int kMaxDistance = 64;          // bits
constexpr double kMaxDistanceRatio = 0.8;
constexpr float kOneCorner = 4;     // px: a second match so near is the same corner on another level
constexpr float kMaxMove = 4;       // px that alignment may go from the corners' own positions
constexpr float kMaxReturn = 0.2F;  // px from the left point that the way back may end
constexpr float kMaxSigma = 0.2F;   // px, of the position, in rows and columns

struct Window {
  float columns, rows;  // px, half widths

  bool holds(const Keypoint& a, const Keypoint& b) const {
    return std::abs(a.x - b.x) <= columns && std::abs(a.y - b.y) <= rows;
  }
};

OrbOptions corner_options(int count) {
  OrbOptions options;
  options.count = count;
  options.levels = 4;  // the eyes of a rig see the same size, and fine levels know positions best
  return options;
}

AlignmentOptions patch_options() {
  AlignmentOptions options;
  options.patch_radius = 7;
  options.levels = 2;
  options.min_correlation = 0.9;
  return options;
}

// The keypoint of `to` that looks most like keypoint i of `from`, if it is good; -1 if none. `unique`: no
// other place may look nearly as good.
int best_match(const Features& from, std::size_t i, const Features& to, const Window& window, bool unique) {
  const Keypoint& point = from.keypoints[i];
  int best = -1, best_distance = kMaxDistance + 1, second_distance = 257;
  for (std::size_t j = 0; j < to.keypoints.size(); ++j) {
    const Keypoint& candidate = to.keypoints[j];
    if (!window.holds(point, candidate) || std::abs(candidate.octave - point.octave) > 1) continue;
    const int distance = hamming(from.descriptors[i], to.descriptors[j]);
    const auto is_same_place = [&](const Keypoint& other) {
      return std::hypot(other.x - candidate.x, other.y - candidate.y) < kOneCorner;
    };
    if (distance < best_distance) {
      if (best >= 0 && !is_same_place(to.keypoints[static_cast<std::size_t>(best)]))
        second_distance = best_distance;
      best_distance = distance;
      best = static_cast<int>(j);
    } else if (best >= 0 && distance < second_distance &&
               !is_same_place(to.keypoints[static_cast<std::size_t>(best)])) {
      second_distance = distance;
    }
  }
  return unique && best_distance > kMaxDistanceRatio * second_distance ? -1 : best;
}

bool is_precise(const Alignment& found, const Eigen::Vector2f& start) {
  return found.ok() && (found.position - start).norm() <= kMaxMove &&
         found.covariance(0, 0) < kMaxSigma * kMaxSigma && found.covariance(1, 1) < kMaxSigma * kMaxSigma;
}

// Where the patch around the left point lies in the right image, if the way back ends where it began.
std::optional<Eigen::Vector2f> align(const EyeFeatures& left, const Eigen::Vector2f& point,
                                     const EyeFeatures& right, const Eigen::Vector2f& start,
                                     const AlignmentOptions& options) {
  const Eigen::Matrix2f unwarped = Eigen::Matrix2f::Identity();
  const Alignment there = align_patch(left.pyramid, point, right.pyramid, start, unwarped, options);
  if (!is_precise(there, start)) return std::nullopt;
  const Alignment back =
      align_patch(right.pyramid, there.position, left.pyramid, point, unwarped, options, 0);
  if (!back.ok() || (back.position - point).norm() > kMaxReturn) return std::nullopt;
  return there.position;
}

}  // namespace

PairMatcher::PairMatcher(int corners) : extractor_(corner_options(corners)) {}

EyeFeatures PairMatcher::prepare(const cv::Mat& grey) {
  return {grey.size(), extractor_.extract(grey), AlignmentPyramid(grey, patch_options().levels)};
}

std::vector<PairMatch> match_pair(const EyeFeatures& left, const EyeFeatures& right) {
  const Window window{static_cast<float>(kDisparityShare * left.size.width),
                      static_cast<float>(kRowShare * left.size.height)};
  const AlignmentOptions options = patch_options();
  std::vector<PairMatch> matches;
  for (std::size_t i = 0; i < left.features.keypoints.size(); ++i) {
    const int j = best_match(left.features, i, right.features, window, true);
    if (j < 0) continue;
    const auto other = static_cast<std::size_t>(j);
    if (best_match(right.features, other, left.features, window, false) != static_cast<int>(i)) continue;
    const Keypoint &a = left.features.keypoints[i], &b = right.features.keypoints[other];
    if (const auto at = align(left, {a.x, a.y}, right, {b.x, b.y}, options))
      matches.push_back({a.x, a.y, a.x - at->x(), at->y() - a.y});
  }
  return matches;
}

}  // namespace spslam
