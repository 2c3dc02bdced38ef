// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Sum of absolute differences of a square block over a two-dimensional window: equation (4) of the paper.
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>

#include "spslam/stereo/subpixel.h"

namespace spslam {

inline constexpr int kMaxBlockRadius = 7;       // 15 columns: a row fits 16 bytes
inline constexpr int kMaxSearchRadius = 8;      // px along the row
inline constexpr int kMaxSearchRadiusRows = 4;  // px across

// A square block as 16-byte rows, the columns past its width 0.
struct Block {
  int radius = 0;
  alignas(32) std::array<std::uint8_t, 16 * (2 * kMaxBlockRadius + 2)> pixels{};
};

// The costs of all places of a search window; row 0 is -radius_v, column 0 is -radius_u.
struct CostWindow {
  int radius_u = 0, radius_v = 0;
  std::array<int, (2 * kMaxSearchRadius + 1) * (2 * kMaxSearchRadiusRows + 1)> cost{};

  int at(int u, int v) const { return cost[(v + radius_v) * (2 * radius_u + 1) + u + radius_u]; }
  bool on_edge(const cv::Point& p) const {
    return std::abs(p.x) == radius_u || (radius_v > 0 && std::abs(p.y) == radius_v);
  }
  cv::Point best() const;  // the first of the least
  // Where radius_v is 0 the rows above and below are given the cost of the row's side samples' mean: a
  // symmetric bowl.
  FiveSamples around(const cv::Point& p) const;
};

// Whether a block (grown by margin_u, margin_v) about (x, y) lies in the image.
inline bool block_inside(const cv::Mat& image, const cv::Point& p, int radius, int margin_u, int margin_v) {
  return p.x - radius - margin_u >= 0 && p.x + radius + margin_u < image.cols &&
         p.y - radius - margin_v >= 0 && p.y + radius + margin_v < image.rows;
}

// The block about p, which must lie inside. image: CV_8UC1.
Block cut_block(const cv::Mat& image, const cv::Point& p, int radius);

// Gives the block the mean and contrast of the reference (contrast ratio within 1/2 and 2): SAD alone would
// take a difference of exposure between the eyes for a shift.
void match_brightness(Block& block, const Block& reference);

// SAD of the block against all places within (radius_u, radius_v) of p, which must lie inside with that
// margin.
CostWindow search_block(const Block& block, const cv::Mat& image, const cv::Point& p, int radius_u,
                        int radius_v);

}  // namespace spslam
