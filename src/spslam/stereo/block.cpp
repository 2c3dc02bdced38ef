// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/stereo/block.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "spslam/base/simd.h"

namespace spslam {
namespace {

constexpr int kRow = 16;      // bytes a block row
constexpr int kWideRow = 48;  // bytes a row of a search window: 15 + 16 and what a full row read takes
constexpr int kMaxStripRows = 2 * (kMaxBlockRadius + kMaxSearchRadiusRows) + 1;

struct Sums {
  int sum = 0, squares = 0;
};

// The padding is 0 and adds nothing.
SPSLAM_SIMD Sums sums_of(const std::uint8_t* pixels, int bytes) {
  Sums s;
  for (int k = 0; k < bytes; ++k) {
    s.sum += pixels[k];
    s.squares += pixels[k] * pixels[k];
  }
  return s;
}

// value -> gain value + offset, rounded and clamped, in 1/4096; the padding is put back to 0.
SPSLAM_SIMD void apply_gain(std::uint8_t* pixels, int width, int gain, int offset) {
  for (int r = 0; r < width; ++r, pixels += kRow) {
    for (int c = 0; c < kRow; ++c) {
      const int value = std::clamp((gain * pixels[c] + offset + 2048) >> 12, 0, 255);
      pixels[c] = static_cast<std::uint8_t>(c < width ? value : 0);
    }
  }
}

// Rows of an image region into rows of a fixed length, so that whole rows can be read without looking at
// borders.
void copy_rows(const std::uint8_t* from, std::size_t step, int width, int rows, std::uint8_t* to,
               int to_step) {
  for (int r = 0; r < rows; ++r, from += step, to += to_step)
    std::memcpy(to, from, static_cast<std::size_t>(width));
}

// region: the search window's pixels, kWideRow bytes a row. Column by column, because then a block and its
// place are each one run of bytes, padding included, and SAD is one loop that compilers know (psadbw).
SPSLAM_SIMD void search_columns(const std::uint8_t* block, const std::uint8_t* region, int width, int columns,
                                int rows, int* cost) {
  alignas(32) std::uint8_t mask[kRow];
  for (int c = 0; c < kRow; ++c) mask[c] = c < width ? 0xFF : 0;
  alignas(32) std::uint8_t strip[kRow * kMaxStripRows];
  for (int u = 0; u < columns; ++u) {
    for (int r = 0; r < width + rows - 1; ++r)
      for (int c = 0; c < kRow; ++c) strip[kRow * r + c] = region[kWideRow * r + u + c] & mask[c];
    for (int v = 0; v < rows; ++v) {
      const std::uint8_t* place = strip + kRow * v;
      int sum = 0;
      for (int k = 0; k < kRow * width; ++k)
        sum += std::abs(static_cast<int>(block[k]) - static_cast<int>(place[k]));
      cost[v * columns + u] = sum;
    }
  }
}

}  // namespace

cv::Point CostWindow::best() const {
  const int columns = 2 * radius_u + 1, count = columns * (2 * radius_v + 1);
  const int k = static_cast<int>(std::min_element(cost.begin(), cost.begin() + count) - cost.begin());
  return {k % columns - radius_u, k / columns - radius_v};
}

FiveSamples CostWindow::around(const cv::Point& p) const {
  FiveSamples s;
  s.centre = at(p.x, p.y);
  s.left = at(p.x - 1, p.y);
  s.right = at(p.x + 1, p.y);
  s.up = radius_v > 0 ? at(p.x, p.y - 1) : 0.5 * (s.left + s.right);
  s.down = radius_v > 0 ? at(p.x, p.y + 1) : s.up;
  return s;
}

Block cut_block(const cv::Mat& image, const cv::Point& p, int radius) {
  Block block;
  block.radius = radius;
  const int width = 2 * radius + 1;
  copy_rows(image.ptr(p.y - radius) + p.x - radius, image.step[0], width, width, block.pixels.data(), kRow);
  return block;
}

void match_brightness(Block& block, const Block& reference) {
  const int width = 2 * block.radius + 1;
  const double n = width * width;
  const Sums mine = sums_of(block.pixels.data(), kRow * width),
             wanted = sums_of(reference.pixels.data(), kRow * width);
  const double energy = mine.squares - mine.sum * (mine.sum / n);  // n times the variance
  const double wanted_energy = wanted.squares - wanted.sum * (wanted.sum / n);
  const double gain =
      energy > 0 ? std::clamp(std::sqrt(std::max(0.0, wanted_energy) / energy), 0.5, 2.0) : 1.0;
  const double offset = (wanted.sum - gain * mine.sum) / n;
  apply_gain(block.pixels.data(), width, static_cast<int>(std::lround(gain * 4096)),
             static_cast<int>(std::lround(offset * 4096)));
}

CostWindow search_block(const Block& block, const cv::Mat& image, const cv::Point& p, int radius_u,
                        int radius_v) {
  CostWindow window;
  window.radius_u = radius_u;
  window.radius_v = radius_v;
  const int width = 2 * block.radius + 1, columns = 2 * radius_u + 1, rows = 2 * radius_v + 1;
  std::array<std::uint8_t, kWideRow * kMaxStripRows> region{};
  const std::uint8_t* corner = image.ptr(p.y - block.radius - radius_v) + p.x - block.radius - radius_u;
  copy_rows(corner, image.step[0], width + columns - 1, width + rows - 1, region.data(), kWideRow);
  search_columns(block.pixels.data(), region.data(), width, columns, rows, window.cost.data());
  return window;
}

}  // namespace spslam
