// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/stereo/coarse.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "spslam/base/simd.h"

namespace spslam {
namespace {

constexpr float kSamePlace = 2.0F;  // px of the level: two keypoints nearer than this are the same corner

// Right keypoints sorted by row, so that a band of rows is one contiguous run.
struct RowIndex {
  struct Entry {
    float x, y;
    int octave;
    int keypoint;
  };
  std::vector<int> first;  // first[r] .. first[r + 1]: entries of row r
  std::vector<Entry> entries;
  std::vector<Descriptor> descriptors;  // of the entries

  RowIndex(const Features& features, int height) : first(static_cast<std::size_t>(height) + 1, 0) {
    const auto row_of = [&](const Keypoint& k) {
      return std::clamp(static_cast<int>(std::lround(k.y)), 0, height - 1);
    };
    for (const Keypoint& k : features.keypoints) ++first[row_of(k) + 1];
    for (int r = 0; r < height; ++r) first[r + 1] += first[r];
    entries.resize(features.keypoints.size());
    descriptors.resize(features.keypoints.size());
    std::vector<int> next(first.begin(), first.end() - 1);
    for (std::size_t i = 0; i < features.keypoints.size(); ++i) {
      const Keypoint& k = features.keypoints[i];
      const int place = next[row_of(k)]++;
      entries[place] = {k.x, k.y, k.octave, static_cast<int>(i)};
      descriptors[place] = features.descriptors[i];
    }
  }

  // Begin and end of the entries in the rows from low to high.
  std::pair<int, int> rows(float low, float high) const {
    const int last = static_cast<int>(first.size()) - 2;
    const int from = std::clamp(static_cast<int>(std::lround(low)), 0, last);
    const int to = std::clamp(static_cast<int>(std::lround(high)), from, last);
    return {first[from], first[to + 1]};
  }
};

struct Candidate {
  int entry;  // of the row index
  int distance = 0;
};

SPSLAM_SIMD void measure_distances(const Descriptor& left, const Descriptor* right, Candidate* candidates,
                                   std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) candidates[k].distance = hamming(left, right[candidates[k].entry]);
}

struct RowMatcher {
  const Features& left;
  const Features& right;
  std::span<const double> pixel_sizes;
  RowIndex index;
  float max_disparity;
  const StereoOptions& options;

  // All right keypoints that may be left keypoint i by place and level, with their distances.
  void collect(std::size_t i, std::vector<Candidate>& candidates) const {
    const Keypoint& l = left.keypoints[i];
    const auto pixel = static_cast<float>(pixel_sizes[l.octave]);
    const float band = static_cast<float>(options.row_tolerance) * pixel;
    const float lowest = static_cast<float>(options.min_disparity) * pixel;  // a coarser pixel is noisier
    const auto [begin, end] = index.rows(l.y - band, l.y + band);
    candidates.resize(static_cast<std::size_t>(end - begin));
    std::size_t count = 0;
    for (int e = begin; e < end; ++e) {  // no branches: which keypoints fit is hard to predict
      const RowIndex::Entry& r = index.entries[e];
      const float disparity = l.x - r.x;
      candidates[count].entry = e;
      count += (disparity >= lowest) & (disparity <= max_disparity) & (std::abs(r.y - l.y) <= band) &
               (std::abs(r.octave - l.octave) <= 1);
    }
    candidates.resize(count);
    measure_distances(left.descriptors[i], index.descriptors.data(), candidates.data(), candidates.size());
  }

  CoarseMatch choose(std::size_t i, const std::vector<Candidate>& candidates) const {
    Candidate best{-1, 256};
    for (const Candidate& c : candidates)
      if (c.distance < best.distance) best = c;
    if (best.entry < 0 || best.distance > options.max_distance) return {};
    const RowIndex::Entry& place = index.entries[best.entry];
    CoarseMatch match{place.keypoint, best.distance, StereoStatus::kOk};
    const float apart = kSamePlace * static_cast<float>(pixel_sizes[left.keypoints[i].octave]);
    for (const Candidate& c : candidates) {
      if (best.distance < options.max_distance_ratio * c.distance) continue;
      const RowIndex::Entry& other = index.entries[c.entry];
      if (std::abs(other.x - place.x) > apart || std::abs(other.y - place.y) > apart)
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
