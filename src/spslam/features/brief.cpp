// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "spslam/features/brief.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "spslam/base/random.h"
#include "spslam/base/simd.h"

namespace spslam {
namespace {

using Byte = std::uint8_t;

constexpr std::uint64_t kSeed = 2024;
constexpr float kMinimumLength = 4;  // px; nearer points look at the same smoothed pixels

std::array<BriefPair, 256> draw_pattern() {
  Random random(kSeed);
  const double sigma = Patch::kSide / 5.0;
  const auto point = [&] {
    cv::Point2d p;
    do p = {sigma * random.normal(), sigma * random.normal()};
    while (std::hypot(p.x, p.y) > kPatchRadius);
    return cv::Point2f(p);
  };
  std::array<BriefPair, 256> pattern;
  for (BriefPair& pair : pattern) {
    cv::Point2f a, b;
    do a = point(), b = point();
    while (std::hypot(a.x - b.x, a.y - b.y) < kMinimumLength);
    pair = {a.x, a.y, b.x, b.y};
  }
  return pattern;
}

struct Offsets {
  std::uint16_t a, b;  // in Patch::pixels
};
using Rotation = std::array<Offsets, 256>;

std::uint16_t rotated_offset(float x, float y, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const auto u = static_cast<int>(std::lround(c * x - s * y));
  const auto v = static_cast<int>(std::lround(s * x + c * y));
  return static_cast<std::uint16_t>((v + kPatchRadius) * Patch::kStride + u + kPatchRadius);
}

std::array<Rotation, kAngleBins> rotate_pattern() {
  std::array<Rotation, kAngleBins> rotations;
  for (int bin = 0; bin < kAngleBins; ++bin) {
    const double angle = 2 * std::numbers::pi * bin / kAngleBins;
    for (int i = 0; i < 256; ++i) {
      const BriefPair& pair = brief_pattern()[i];
      rotations[bin][i] = {rotated_offset(pair.ax, pair.ay, angle), rotated_offset(pair.bx, pair.by, angle)};
    }
  }
  return rotations;
}

// The kernel 5 8 12 14 12 8 5 (sum 64) across seven rows.
SPSLAM_SIMD void smooth_down(const std::array<const Byte*, 7>& rows, int count, Byte* out) {
  const Byte *a = rows[0], *b = rows[1], *c = rows[2], *d = rows[3], *e = rows[4], *f = rows[5], *g = rows[6];
  for (int x = 0; x < count; ++x) {
    const auto sum = static_cast<std::uint16_t>(5 * (a[x] + g[x]) + 8 * (b[x] + f[x]) + 12 * (c[x] + e[x]) +
                                                14 * d[x] + 32);
    out[x] = static_cast<Byte>(sum >> 6);
  }
}

// The same along a row that has three more pixels on each side.
SPSLAM_SIMD void smooth_along(const Byte* in, int count, Byte* out) {
  for (int x = 0; x < count; ++x) {
    const auto sum = static_cast<std::uint16_t>(5 * (in[x - 3] + in[x + 3]) + 8 * (in[x - 2] + in[x + 2]) +
                                                12 * (in[x - 1] + in[x + 1]) + 14 * in[x] + 32);
    out[x] = static_cast<Byte>(sum >> 6);
  }
}

}  // namespace

const std::array<BriefPair, 256>& brief_pattern() {
  static const std::array<BriefPair, 256> pattern = draw_pattern();
  return pattern;
}

void smooth(const cv::Mat& grey, cv::Mat& smoothed) {
  smoothed.create(grey.size(), CV_8UC1);
  const int width = grey.cols;
  std::vector<Byte> line(width + 6);
  for (int y = 0; y < grey.rows; ++y) {
    std::array<const Byte*, 7> rows;
    for (int i = 0; i < 7; ++i) rows[i] = grey.ptr<Byte>(std::clamp(y + i - 3, 0, grey.rows - 1));
    smooth_down(rows, width, line.data() + 3);
    std::memset(line.data(), line[3], 3);
    std::memset(line.data() + width + 3, line[width + 2], 3);
    smooth_along(line.data() + 3, width, smoothed.ptr<Byte>(y));
  }
}

Descriptor describe_patch(const Patch& smoothed, float angle) {
  static const std::array<Rotation, kAngleBins> rotations = rotate_pattern();
  const auto bin = std::lround(angle * static_cast<float>(kAngleBins / (2 * std::numbers::pi)));
  const Rotation& rotation = rotations[static_cast<std::size_t>(bin) % kAngleBins];
  const Byte* pixels = smoothed.pixels.data();
  Descriptor descriptor;
  for (int word = 0; word < 4; ++word) {
    std::uint64_t bits = 0;
    for (int i = 0; i < 64; ++i) {
      const Offsets at = rotation[64 * word + i];
      bits |= static_cast<std::uint64_t>(pixels[at.a] < pixels[at.b]) << i;
    }
    descriptor[word] = bits;
  }
  return descriptor;
}

}  // namespace spslam
