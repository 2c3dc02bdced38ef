// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "spslam/features/distribute.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace spslam {
namespace {

// Indices of the corners by falling score, in raster order where equal (a counting sort: scores are bytes).
std::vector<int> by_score(std::span<const Corner> corners) {
  std::array<int, 257> begin{};
  for (const Corner& corner : corners) ++begin[256 - corner.score];
  for (int i = 1; i < 257; ++i) begin[i] += begin[i - 1];
  std::vector<int> order(corners.size());
  for (int i = 0; i < static_cast<int>(corners.size()); ++i) order[begin[255 - corners[i].score]++] = i;
  return order;
}

// The corners by falling score without those that have a better one within the spacing (in x and in y).
std::vector<Corner> thin(std::span<const Corner> corners, cv::Size size, int spacing) {
  // Squares of side `spacing` hold at most one kept corner each, so that nine of them decide.
  const int columns = size.width / spacing + 3;
  std::vector<cv::Point_<std::int16_t>> taken(columns * (size.height / spacing + 3), {-30000, -30000});
  std::vector<Corner> kept;
  kept.reserve(corners.size());
  for (const int i : by_score(corners)) {
    const Corner& corner = corners[i];
    const int square = (corner.y / spacing + 1) * columns + corner.x / spacing + 1;
    bool free = true;
    for (int row = square - columns; row <= square + columns && free; row += columns) {
      for (int at = row - 1; at <= row + 1; ++at) {
        free = free &&
               (std::abs(taken[at].x - corner.x) >= spacing || std::abs(taken[at].y - corner.y) >= spacing);
      }
    }
    if (!free) continue;
    taken[square] = {corner.x, corner.y};
    kept.push_back(corner);
  }
  return kept;
}

struct Cells {
  int columns, rows;
  float per_x, per_y;

  Cells(cv::Size size, int side)
      : columns(std::max(1, (size.width + side / 2) / side)),
        rows(std::max(1, (size.height + side / 2) / side)),
        per_x(static_cast<float>(columns) / static_cast<float>(size.width)),
        per_y(static_cast<float>(rows) / static_cast<float>(size.height)) {}
  int count() const { return columns * rows; }
  int of(const Corner& corner) const {
    return static_cast<int>(static_cast<float>(corner.y) * per_y) * columns +
           static_cast<int>(static_cast<float>(corner.x) * per_x);
  }
};

}  // namespace

RankedCorners rank_corners(std::span<const Corner> corners, cv::Size size, int wanted,
                           const OrbOptions& options) {
  const std::vector<Corner> candidates = thin(corners, size, options.spacing);
  const Cells cells(size, options.cell_size);
  const int share = (wanted + cells.count() - 1) / cells.count();
  // The n-th best of a cell belongs to round n. A cell's threshold falls below the start only for its even
  // share.
  std::vector<int> in_cell(cells.count(), 0), round(candidates.size());
  std::vector<int> size_of_round;
  int weak_count = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    int& rank = in_cell[cells.of(candidates[i])];
    const bool weak = candidates[i].score <= options.start_threshold && rank >= share;
    round[i] = weak ? -1 : rank;
    ++rank;
    if (weak) {
      ++weak_count;
      continue;
    }
    if (round[i] >= static_cast<int>(size_of_round.size())) size_of_round.resize(round[i] + 1, 0);
    ++size_of_round[round[i]];
  }
  // A stable counting sort by round, the weak ones at the end.
  RankedCorners result;
  result.corners.resize(candidates.size());
  result.strong = static_cast<int>(candidates.size()) - weak_count;
  std::vector<int> next(size_of_round.size() + 1, 0);
  for (std::size_t i = 0; i < size_of_round.size(); ++i) next[i + 1] = next[i] + size_of_round[i];
  int next_weak = result.strong;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    result.corners[round[i] < 0 ? next_weak++ : next[round[i]]++] = candidates[i];
  }
  return result;
}

std::vector<int> level_quotas(std::span<const int> available, int count, const OrbOptions& options) {
  const std::size_t levels = available.size();
  std::vector<int> quota(levels, 0);
  int left = count;
  // Each pass fills at least one level or ends.
  for (std::size_t pass = 0; pass <= levels && left > 0; ++pass) {
    double open = 0;
    const auto weight = [&](std::size_t i) {
      return std::pow(options.scale, -options.level_exponent * static_cast<double>(i));
    };
    for (std::size_t i = 0; i < levels; ++i) open += quota[i] < available[i] ? weight(i) : 0.0;
    if (open == 0) break;
    // Shares are rounded so that they add up: each takes its part of what is left.
    int rest = left;
    for (std::size_t i = 0; i < levels; ++i) {
      if (quota[i] >= available[i]) continue;
      const int part = static_cast<int>(std::lround(rest * weight(i) / open));
      open -= weight(i);
      rest -= part;
      const int given = std::min(part, available[i] - quota[i]);
      quota[i] += given;
      left -= given;
    }
  }
  return quota;
}

}  // namespace spslam
