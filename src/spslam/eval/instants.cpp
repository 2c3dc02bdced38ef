// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/eval/instants.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "spslam/base/median.h"
#include "spslam/stereo/pair_check.h"

namespace spslam {
namespace {

constexpr int kFewTold = 60;  // matches of all pairs
constexpr std::size_t kFewOfPair = 20;
constexpr double kSpreadNoise = 0.05;  // px, by which rows differ for no reason
constexpr double kDelayKnown = 0.08;   // frames, deviation of a delay that tells anything

double median_row(std::span<const PairMatch> matches) {
  std::vector<double> offsets;
  for (const PairMatch& m : matches) offsets.push_back(m.row_offset);
  return median(std::move(offsets));
}

// A right eye exposed `delay` frames late sees rows that have moved on by delay * rate, where the rate, px a
// frame, is half of what lies between the left images before and after. The slope of the line through all
// pairs, and its deviation.
void measure_delay(std::span<const SampledPair> pairs, Instants& instants) {
  std::vector<Eigen::Vector2d> points;  // rate, row of its own right image
  for (const SampledPair& pair : pairs)
    if (std::min({pair.before.size(), pair.matches.size(), pair.after.size()}) >= kFewOfPair)
      points.emplace_back(0.5 * (median_row(pair.before) - median_row(pair.after)), median_row(pair.matches));
  if (points.size() < 5) return;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& point : points) mean += point / static_cast<double>(points.size());
  double rates = 1e-9, both = 0, squares = 0;
  for (const Eigen::Vector2d& point : points) {
    rates += (point.x() - mean.x()) * (point.x() - mean.x());
    both += (point.x() - mean.x()) * (point.y() - mean.y());
  }
  const double delay = both / rates;
  for (const Eigen::Vector2d& point : points) {
    const double rest = point.y() - mean.y() - delay * (point.x() - mean.x());
    squares += rest * rest + kSpreadNoise * kSpreadNoise;
  }
  const double sigma = std::sqrt(squares / static_cast<double>(points.size() - 2) / rates);
  if (sigma > kDelayKnown) return;
  instants.delay = delay;
  instants.delay_sigma = sigma;
}

}  // namespace

const std::vector<PairMatch>& matches_with(const SampledPair& pair, int frames) {
  return frames < 0 ? pair.before : frames > 0 ? pair.after : pair.matches;
}

std::vector<PairMatch> all_matches(std::span<const SampledPair> pairs, int frames) {
  std::vector<PairMatch> all;
  for (const SampledPair& pair : pairs) {
    const std::vector<PairMatch>& own = matches_with(pair, frames);
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

Instants measure_instants(std::span<const SampledPair> pairs, cv::Size image) {
  Instants instants;
  std::vector<SampledPair> told;
  std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(told),
               [](const SampledPair& pair) { return pair.has_neighbours; });
  instants.pairs = static_cast<int>(told.size());
  int fewest = kFewTold;
  for (int k = 0; k < 3; ++k) {
    const RowOffsets rows = measure_rows(all_matches(told, k - 1), image);
    instants.spread[k] = rows.spread;
    fewest = std::min(fewest, rows.matches);
  }
  const auto& [before, own, after] = instants.spread;
  const double least = std::min({before, own, after}), most = std::max({before, own, after});
  instants.is_told = fewest >= kFewTold && most > 1.5 * least + kSpreadNoise;
  if (!instants.is_told) return instants;
  if (own > 1.3 * std::min(before, after) + kSpreadNoise) instants.fitting = before < after ? -1 : 1;
  measure_delay(told, instants);
  return instants;
}

}  // namespace spslam
