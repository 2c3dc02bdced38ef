// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/stereo/coarse.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace spslam {
namespace {

constexpr float kSamePlace = 2.0F;  // px of the level: two keypoints nearer than this are the same corner

// Right keypoints sorted by row, so that a band of rows is one contiguous run.
struct RowIndex {
  std::vector<int> first;  // first[r] .. first[r + 1]: entries of row r
  std::vector<int> keypoint;

  RowIndex(const Features& features, int height) : first(static_cast<std::size_t>(height) + 1, 0) {
    const auto row_of = [&](const Keypoint& k) {
      return std::clamp(static_cast<int>(std::lround(k.y)), 0, height - 1);
    };
    for (const Keypoint& k : features.keypoints) ++first[row_of(k) + 1];
    for (int r = 0; r < height; ++r) first[r + 1] += first[r];
    keypoint.resize(features.keypoints.size());
    std::vector<int> next(first.begin(), first.end() - 1);
    for (std::size_t i = 0; i < features.keypoints.size(); ++i)
      keypoint[next[row_of(features.keypoints[i])]++] = static_cast<int>(i);
  }

  std::span<const int> rows(float low, float high) const {
    const int last = static_cast<int>(first.size()) - 2;
    const int from = std::clamp(static_cast<int>(std::lround(low)), 0, last);
    const int to = std::clamp(static_cast<int>(std::lround(high)), from, last);
    return std::span(keypoint).subspan(first[from], first[to + 1] - first[from]);
  }
};

struct Candidate {
  int right;
  int distance;
};

struct RowMatcher {
  const Features& left;
  const Features& right;
  std::span<const double> pixel_sizes;
  RowIndex index;
  float max_disparity;
  const StereoOptions& options;

  // All right keypoints that may be left keypoint i by place and level.
  void collect(std::size_t i, std::vector<Candidate>& candidates) const {
    const Keypoint& l = left.keypoints[i];
    const float pixel = static_cast<float>(pixel_sizes[l.octave]);
    const float band = static_cast<float>(options.row_tolerance) * pixel;
    const float lowest = static_cast<float>(options.min_disparity) * pixel;  // a coarser pixel is noisier
    candidates.clear();
    for (const int r : index.rows(l.y - band, l.y + band)) {
      const Keypoint& k = right.keypoints[r];
      const float disparity = l.x - k.x;
      if (disparity < lowest || disparity > max_disparity || std::abs(k.y - l.y) > band) continue;
      if (std::abs(k.octave - l.octave) > 1) continue;
      candidates.push_back({r, hamming(left.descriptors[i], right.descriptors[r])});
    }
  }

  CoarseMatch choose(std::size_t i, const std::vector<Candidate>& candidates) const {
    CoarseMatch match;
    for (const Candidate& c : candidates)
      if (c.distance < match.distance) match = {c.right, c.distance, StereoStatus::kOk};
    if (match.right < 0 || match.distance > options.max_distance) return {};
    const float apart = kSamePlace * static_cast<float>(pixel_sizes[left.keypoints[i].octave]);
    const Keypoint& best = right.keypoints[match.right];
    for (const Candidate& c : candidates) {
      const Keypoint& other = right.keypoints[c.right];
      const bool elsewhere = std::abs(other.x - best.x) > apart || std::abs(other.y - best.y) > apart;
      if (elsewhere && match.distance > options.max_distance_ratio * c.distance)
        match.status = StereoStatus::kAmbiguous;
    }
    return match;
  }

  // A right keypoint belongs to the left one it is nearest to; others keep it only if they are the same
  // corner.
  void drop_taken(std::vector<CoarseMatch>& matches) const {
    std::vector<int> owner(right.keypoints.size(), -1);
    for (std::size_t i = 0; i < matches.size(); ++i) {
      if (matches[i].right < 0) continue;
      int& holder = owner[matches[i].right];
      if (holder < 0 || matches[i].distance < matches[holder].distance) holder = static_cast<int>(i);
    }
    for (std::size_t i = 0; i < matches.size(); ++i) {
      if (matches[i].status != StereoStatus::kOk) continue;
      const Keypoint& mine = left.keypoints[i];
      const Keypoint& holder = left.keypoints[owner[matches[i].right]];
      const float apart = kSamePlace * static_cast<float>(pixel_sizes[mine.octave]);
      if (std::abs(holder.x - mine.x) > apart || std::abs(holder.y - mine.y) > apart)
        matches[i].status = StereoStatus::kLeftRight;
    }
  }
};

}  // namespace

std::vector<CoarseMatch> match_rows(const Features& left, const Features& right,
                                    std::span<const double> pixel_sizes, int width, int height,
                                    const StereoOptions& options) {
  std::vector<CoarseMatch> matches(left.keypoints.size());
  if (left.keypoints.empty() || right.keypoints.empty() || height <= 0) return matches;
  const RowMatcher matcher{left,
                           right,
                           pixel_sizes,
                           RowIndex(right, height),
                           static_cast<float>(options.max_disparity_share * width),
                           options};
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, matches.size(), 128), [&](const auto& range) {
    std::vector<Candidate> candidates;
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      if (left.keypoints[i].octave >= pixel_sizes.size()) continue;
      matcher.collect(i, candidates);
      matches[i] = matcher.choose(i, candidates);
    }
  });
  if (options.left_right_check) matcher.drop_taken(matches);
  return matches;
}

}  // namespace spslam
