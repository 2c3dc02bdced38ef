// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "spslam/features/orientation.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "spslam/base/simd.h"

namespace spslam {
namespace {

constexpr int kRadius = kPatchRadius;
constexpr int kStride = Patch::kStride;

// 0xFFFF within the circle, else 0, for the rows 0 .. kRadius below (or above) the centre.
constexpr auto make_circle() {
  std::array<std::array<std::int16_t, kStride>, kRadius + 1> circle{};
  for (int v = 0; v <= kRadius; ++v) {
    for (int u = -kRadius; u <= kRadius; ++u) {
      // The half pixel rounds the circle off as its pixels' centres do.
      if (4 * (u * u + v * v) <= (2 * kRadius + 1) * (2 * kRadius + 1)) circle[v][u + kRadius] = -1;
    }
  }
  return circle;
}
constexpr auto kCircle = make_circle();

struct Moments {
  int x = 0, y = 0;
};

// Sums of u I and v I over the circle. A row above and one below are taken together; sums down the columns
// stay within 16 bit: 31 * 255 and (1 + ... + 15) * 255 are below 2^15.
SPSLAM_SIMD Moments moments(const std::uint8_t* patch) {
  std::array<std::int16_t, kStride> column{}, tilt{};
  const std::uint8_t* centre = patch + kRadius * kStride;
  for (int u = 0; u < kStride; ++u) column[u] = static_cast<std::int16_t>(centre[u] & kCircle[0][u]);
  for (int v = 1; v <= kRadius; ++v) {
    const std::uint8_t* below = centre + v * kStride;
    const std::uint8_t* above = centre - v * kStride;
    for (int u = 0; u < kStride; ++u) {
      const auto inside = kCircle[v][u];
      column[u] = static_cast<std::int16_t>(column[u] + ((below[u] + above[u]) & inside));
      tilt[u] = static_cast<std::int16_t>(tilt[u] + v * ((below[u] - above[u]) & inside));
    }
  }
  Moments sum;
  for (int u = 0; u < kStride; ++u) {
    sum.x += (u - kRadius) * column[u];
    sum.y += tilt[u];
  }
  return sum;
}

}  // namespace

void copy_patch(const cv::Mat& grey, int x, int y, Patch& patch) {
  const int left = x - kRadius, top = y - kRadius;
  const bool inside = left >= 0 && top >= 0 && left + kStride <= grey.cols && top + Patch::kSide <= grey.rows;
  for (int v = 0; v < Patch::kSide; ++v) {
    std::uint8_t* to = &patch.pixels[v * kStride];
    if (inside) {
      std::memcpy(to, grey.ptr<std::uint8_t>(top + v) + left, kStride);
      continue;
    }
    const std::uint8_t* row = grey.ptr<std::uint8_t>(std::clamp(top + v, 0, grey.rows - 1));
    for (int u = 0; u < kStride; ++u) to[u] = row[std::clamp(left + u, 0, grey.cols - 1)];
  }
}

float patch_orientation(const Patch& patch) {
  const Moments m = moments(patch.pixels.data());
  return std::atan2(static_cast<float>(m.y), static_cast<float>(m.x));
}

}  // namespace spslam
