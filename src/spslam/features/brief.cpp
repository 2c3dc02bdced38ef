// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "spslam/features/brief.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "spslam/base/simd.h"
#include "spslam/features/brief_pattern.h"

namespace spslam {
namespace {

using Byte = std::uint8_t;

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
      const BriefPair pair = brief_pair(i);
      rotations[bin][i] = {rotated_offset(pair.ax, pair.ay, angle), rotated_offset(pair.bx, pair.by, angle)};
    }
  }
  return rotations;
}

// Rounded up, as the processors' own instruction does.
[[gnu::always_inline]] constexpr Byte mean(Byte a, Byte b) {
  return static_cast<Byte>((a + b + 1) >> 1);
}
[[gnu::always_inline]] constexpr Byte binomial(Byte a, Byte b, Byte c) {
  return mean(mean(a, c), b);
}

// (1 2 1) and then (1 0 2 0 1): the kernel 1 2 3 4 3 2 1 of seven samples.
template <int block>
[[gnu::always_inline]] inline void smooth_block(const Byte* a, const Byte* b, const Byte* c, const Byte* d,
                                                const Byte* e, const Byte* f, const Byte* g,
                                                Byte* __restrict out) {
  for (int x = 0; x < block; ++x) {
    out[x] = binomial(binomial(a[x], b[x], c[x]), binomial(c[x], d[x], e[x]), binomial(e[x], f[x], g[x]));
  }
}

// Whole blocks, the last one moved back over the one before it (see fast.cpp).
template <int block>
[[gnu::always_inline]] inline void smooth_blocks(const Byte* const* rows, int count, Byte* out) {
  const Byte *a = rows[0], *b = rows[1], *c = rows[2], *d = rows[3], *e = rows[4], *f = rows[5], *g = rows[6];
  for (int begin = 0; begin < count; begin += block) {
    const int at = begin + block <= count ? begin : count - block;
    smooth_block<block>(a + at, b + at, c + at, d + at, e + at, f + at, g + at, out + at);
  }
}

// out[x] from rows[0][x] .. rows[6][x]; out must not overlap them.
SPSLAM_SIMD void smooth_rows(const Byte* const* rows, int count, Byte* out) {
  if (count >= 32) {
    smooth_blocks<32>(rows, count, out);
  } else {
    smooth_blocks<1>(rows, count, out);
  }
}

}  // namespace

BriefPair brief_pair(int bit) {
  const std::int8_t* p = kBriefTable[bit];
  return {p[0] / 8.0F, p[1] / 8.0F, p[2] / 8.0F, p[3] / 8.0F};
}

void smooth(const cv::Mat& grey, cv::Mat& smoothed) {
  smoothed.create(grey.size(), CV_8UC1);
  const int width = grey.cols;
  std::vector<Byte> line(width + 6);
  for (int y = 0; y < grey.rows; ++y) {
    const Byte* rows[7];
    for (int i = 0; i < 7; ++i) rows[i] = grey.ptr<Byte>(std::clamp(y + i - 3, 0, grey.rows - 1));
    smooth_rows(rows, width, line.data() + 3);
    std::memset(line.data(), line[3], 3);
    std::memset(line.data() + width + 3, line[width + 2], 3);
    for (int i = 0; i < 7; ++i) rows[i] = line.data() + i;
    smooth_rows(rows, width, smoothed.ptr<Byte>(y));
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
      bits = bits + bits + (pixels[at.a] < pixels[at.b] ? 1U : 0U);
    }
    descriptor[word] = bits;
  }
  return descriptor;
}

}  // namespace spslam
