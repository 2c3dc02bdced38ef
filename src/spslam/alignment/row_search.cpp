// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/alignment/row_search.h"

#include <array>
#include <cmath>

#include "spslam/base/simd.h"

namespace spslam {
namespace {

constexpr int kRowLength = 16;

// Rows are kRowLength wide whatever the patch's size, so that the loops have a fixed length; `inside` is 0 in
// the padding.
struct WholePatch {
  alignas(32) std::int16_t value[15 * kRowLength] = {};  // deviation from the mean, rounded
  alignas(32) std::int16_t inside[kRowLength] = {};
  int size = 0, sum = 0;  // sum of the values: not quite 0, for the mean was rounded
  float energy = 0;
};

bool cut_patch(const cv::Mat& level, int x, int y, int radius, WholePatch& out) {
  if (x < 0 || y < 0 || x >= level.cols || y >= level.rows) return false;
  out.size = 2 * radius + 1;
  const auto row = [&](int r) {
    return level.data + static_cast<std::ptrdiff_t>(level.step) * (y - radius + r) + x - radius;
  };
  int sum = 0;
  for (int r = 0; r < out.size; ++r)
    for (int c = 0; c < out.size; ++c) sum += row(r)[c];
  const int mean = (sum + out.size * out.size / 2) / (out.size * out.size);
  for (int c = 0; c < out.size; ++c) out.inside[c] = 1;
  for (int r = 0; r < out.size; ++r)
    for (int c = 0; c < out.size; ++c) {
      const int v = row(r)[c] - mean;
      out.value[r * kRowLength + c] = static_cast<std::int16_t>(v);
      out.sum += v;
      out.energy += static_cast<float>(v * v);
    }
  return out.energy > static_cast<float>(4 * out.size * out.size);
}

// Normalized correlation of the patch with the image around a place, `corner` being its first pixel.
SPSLAM_SIMD float correlate(const WholePatch& patch, const unsigned char* corner, std::ptrdiff_t step) {
  int cross = 0, sum = 0, square = 0;
  for (int r = 0; r < patch.size; ++r) {
    const unsigned char* row = corner + r * step;
    const std::int16_t* p = patch.value + r * kRowLength;
    for (int c = 0; c < kRowLength; ++c) {
      const auto v = static_cast<std::int16_t>(row[c] * patch.inside[c]);
      cross += v * p[c];
      sum += v;
      square += v * v;
    }
  }
  const auto count = static_cast<float>(patch.size * patch.size);
  const float mean = static_cast<float>(sum) / count;
  const float energy = static_cast<float>(square) - mean * static_cast<float>(sum);
  return (static_cast<float>(cross) - mean * static_cast<float>(patch.sum)) /
         std::sqrt(std::max(energy, 1.0F) * patch.energy);
}

}  // namespace

std::optional<float> search_row(const AlignmentPyramid& left, const Eigen::Vector2f& point,
                                const AlignmentPyramid& right, int patch_radius,
                                const RowSearchOptions& options) {
  const int level = std::min({options.level, left.size() - 1, right.size() - 1});
  const float scale = 1.0F / static_cast<float>(1 << level);
  const cv::Mat& target = right.level(level);
  const int x = static_cast<int>(std::lround(point.x() * scale)),
            y = static_cast<int>(std::lround(point.y() * scale));
  WholePatch patch;
  if (!cut_patch(left.level(level), x, y, patch_radius, patch)) return std::nullopt;
  const int first = std::max(0, x - static_cast<int>(std::lround(options.max_disparity * scale)));
  const int last = std::min(target.cols - 1, x - static_cast<int>(std::floor(options.min_disparity * scale)));
  if (last < first) return std::nullopt;
  std::vector<float> best_of_column(static_cast<std::size_t>(last - first + 1), -1.0F);
  for (int row = std::max(0, y - options.rows); row <= std::min(target.rows - 1, y + options.rows); ++row)
    for (int column = first; column <= last; ++column) {
      const auto step = static_cast<std::ptrdiff_t>(target.step);
      const float c =
          correlate(patch, target.data + step * (row - patch_radius) + column - patch_radius, step);
      float& best = best_of_column[static_cast<std::size_t>(column - first)];
      best = std::max(best, c);
    }
  const auto best = std::max_element(best_of_column.begin(), best_of_column.end());
  if (*best < static_cast<float>(options.min_correlation)) return std::nullopt;
  for (auto other = best_of_column.begin(); other != best_of_column.end(); ++other)
    if (std::abs(other - best) > 2 && *other > *best - static_cast<float>(options.uniqueness))
      return std::nullopt;
  const auto column = static_cast<float>(first + (best - best_of_column.begin()));
  return (point.x() * scale - column) / scale;
}

}  // namespace spslam
