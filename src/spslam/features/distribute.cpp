// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "spslam/features/distribute.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace spslam {
namespace {

constexpr int kSharesKept = 4;

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
  std::vector<std::int16_t> column_of_x, row_of_y;

  Cells(cv::Size size, int side)
      : columns(std::max(1, (size.width + side / 2) / side)),
        rows(std::max(1, (size.height + side / 2) / side)) {
    for (int x = 0; x < size.width; ++x)
      column_of_x.push_back(static_cast<std::int16_t>(x * columns / size.width));
    for (int y = 0; y < size.height; ++y)
      row_of_y.push_back(static_cast<std::int16_t>(y * rows / size.height));
  }
  int count() const { return columns * rows; }
  int of(const Corner& corner) const { return row_of_y[corner.y] * columns + column_of_x[corner.x]; }
};

// Drops from each cell what lies behind its `keep` best corners, to spare the work on them. Scores are
// compared in steps of four, which keeps the histograms of all cells small; all of the last step stay.
std::vector<Corner> best_of_cells(std::span<const Corner> corners, const Cells& cells, int keep) {
  using Histogram = std::array<int, 64>;
  std::vector<Histogram> histogram(cells.count(), Histogram{});
  for (const Corner& corner : corners) ++histogram[cells.of(corner)][corner.score / 4];
  std::vector<int> lowest(cells.count(), 0);
  for (int i = 0; i < cells.count(); ++i) {
    int found = 0, step = 63;
    while (step > 0 && found + histogram[i][step] < keep) found += histogram[i][step--];
    lowest[i] = step;
  }
  std::vector<Corner> best;
  best.reserve(corners.size());
  for (const Corner& corner : corners) {
    if (corner.score / 4 >= lowest[cells.of(corner)]) best.push_back(corner);
  }
  return best;
}

// The round each corner (by falling score) is taken in: the n-th of a cell in round n; kWeak for those that
// do not pass the threshold of their cell, which is below the start only as far as the cell's even share
// needs it.
constexpr int kWeak = -1;
std::vector<int> rounds(std::span<const Corner> corners, const Cells& cells, int share, int start_threshold) {
  std::vector<int> in_cell(cells.count(), 0), round(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const int rank = in_cell[cells.of(corners[i])]++;
    round[i] = corners[i].score <= start_threshold && rank >= share ? kWeak : rank;
  }
  return round;
}

// A stable counting sort by round, the weak ones at the end.
RankedCorners sort_by_round(std::span<const Corner> corners, std::span<const int> round) {
  const int last = round.empty() ? 0 : *std::max_element(round.begin(), round.end());
  std::vector<int> next(last + 2, 0);
  for (const int r : round) next[r + 1] += r == kWeak ? 0 : 1;
  for (int r = 1; r <= last + 1; ++r) next[r] += next[r - 1];
  RankedCorners result;
  result.strong = next[last + 1];
  result.corners.resize(corners.size());
  int next_weak = result.strong;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    result.corners[round[i] == kWeak ? next_weak++ : next[round[i]]++] = corners[i];
  }
  return result;
}

}  // namespace

RankedCorners rank_corners(std::span<const Corner> corners, cv::Size size, int wanted,
                           const OrbOptions& options) {
  const Cells cells(size, options.cell_size);
  const int share = (wanted + cells.count() - 1) / cells.count();
  // Four shares let a quarter of the cells supply the whole level.
  std::vector<Corner> kept = thin(best_of_cells(corners, cells, kSharesKept * share), size, options.spacing);
  if (static_cast<int>(kept.size()) < 2 * wanted) kept = thin(corners, size, options.spacing);
  return sort_by_round(kept, rounds(kept, cells, share, options.start_threshold));
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
