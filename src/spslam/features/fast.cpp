// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "spslam/features/fast.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "spslam/base/simd.h"

namespace spslam {
namespace {

using Byte = std::uint8_t;

constexpr float kFurthest = 0.49F;  // px; less than a half, so that rounding leads back to the corner's pixel

// Inlined by force, and no std::array: within a function of several versions the compiler calls what it would
// else inline.
[[gnu::always_inline]] constexpr Byte low(Byte a, Byte b) {
  return a < b ? a : b;
}
[[gnu::always_inline]] constexpr Byte high(Byte a, Byte b) {
  return a < b ? b : a;
}

// The largest minimum (inner = low, outer = high) or the smallest maximum (the reverse) over the 16 arcs of
// nine. The arcs that begin at k and at k + 1 share eight pixels, so eight windows of eight suffice.
template <Byte (*inner)(Byte, Byte), Byte (*outer)(Byte, Byte), std::size_t... K>
[[gnu::always_inline]] inline Byte best_arc(const Byte (&d)[16], std::index_sequence<K...>) {
  const Byte two[8] = {inner(d[2 * K + 1], d[(2 * K + 2) % 16])...};
  const Byte four[8] = {inner(two[K], two[(K + 1) % 8])...};
  const Byte eight[8] = {inner(four[K], four[(K + 2) % 8])...};
  const Byte nine[8] = {inner(eight[K], outer(d[2 * K], d[(2 * K + 9) % 16]))...};
  return outer(outer(outer(nine[0], nine[1]), outer(nine[2], nine[3])),
               outer(outer(nine[4], nine[5]), outer(nine[6], nine[7])));
}

struct Row {
  const Byte* in;
  std::ptrdiff_t stride;
  int count;
  Byte* out;
};

template <int block>
[[gnu::always_inline]] inline void score_block(const Byte* in, std::ptrdiff_t one, Byte minimum,
                                               Byte* __restrict out) {
  const std::ptrdiff_t two = 2 * one, three = 3 * one;
  for (int x = 0; x < block; ++x) {
    const Byte* p = in + x;
    const Byte ring[16] = {p[three],   p[three + 1], p[two + 2], p[one + 3],    p[3],        p[3 - one],
                           p[2 - two], p[1 - three], p[-three],  p[-three - 1], p[-two - 2], p[-one - 3],
                           p[-3],      p[one - 3],   p[two - 2], p[three - 1]};
    const Byte bright = best_arc<low, high>(ring, std::make_index_sequence<8>{});
    const Byte dark = best_arc<high, low>(ring, std::make_index_sequence<8>{});
    const Byte above = static_cast<Byte>(high(bright, p[0]) - p[0]);
    const Byte below = static_cast<Byte>(p[0] - low(dark, p[0]));
    const Byte score = high(above, below);
    out[x] = score > minimum ? score : Byte{0};
  }
}

// Keeps what is above the neighbours before it in raster order and not below those after it.
template <int block>
[[gnu::always_inline]] inline void maxima_block(const Byte* s, std::ptrdiff_t stride, Byte* __restrict out) {
  const Byte *up = s - stride, *down = s + stride;
  for (int x = 0; x < block; ++x) {
    const Byte before = high(high(up[x - 1], up[x]), high(up[x + 1], s[x - 1]));
    const Byte after = high(high(down[x - 1], down[x]), high(down[x + 1], s[x + 1]));
    const Byte kept = s[x] > before ? s[x] : Byte{0};
    out[x] = s[x] >= after ? kept : Byte{0};
  }
}

// Whole blocks only, the last one moved back over the one before it: single pixels at the end of a row would
// cost more than all the vectors before them.
template <int block>
[[gnu::always_inline]] inline void score_blocks(const Row& row, Byte minimum) {
  for (int begin = 0; begin < row.count; begin += block) {
    const int first = begin + block <= row.count ? begin : row.count - block;
    score_block<block>(row.in + first, row.stride, minimum, row.out + first);
  }
}

template <int block>
[[gnu::always_inline]] inline void maxima_blocks(const Row& row) {
  for (int begin = 0; begin < row.count; begin += block) {
    const int first = begin + block <= row.count ? begin : row.count - block;
    maxima_block<block>(row.in + first, row.stride, row.out + first);
  }
}

SPSLAM_SIMD void score_row(const Row& row, Byte minimum) {
  if (row.count >= 32) {
    score_blocks<32>(row, minimum);
  } else {
    score_blocks<1>(row, minimum);
  }
}

SPSLAM_SIMD void keep_maxima(const Row& row) {
  if (row.count >= 32) {
    maxima_blocks<32>(row);
  } else {
    maxima_blocks<1>(row);
  }
}

}  // namespace

void fast_scores(const cv::Mat& grey, int minimum, cv::Mat& scores) {
  scores.create(grey.size(), CV_8UC1);
  const int width = grey.cols;
  for (int y = 0; y < grey.rows; ++y) {
    Byte* row = scores.ptr<Byte>(y);
    if (y < 3 || y >= grey.rows - 3 || width < 7) {
      std::memset(row, 0, width);
      continue;
    }
    std::memset(row, 0, 3);
    std::memset(row + width - 3, 0, 3);
    const auto stride = static_cast<std::ptrdiff_t>(grey.step);
    score_row({grey.ptr<Byte>(y) + 3, stride, width - 6, row + 3}, static_cast<Byte>(minimum));
  }
}

void collect_corners(const cv::Mat& scores, int border, std::vector<Corner>& corners) {
  corners.clear();
  const int margin = std::max(border, 1);
  const int count = scores.cols - 2 * margin;
  if (count < 1) return;
  const auto stride = static_cast<std::ptrdiff_t>(scores.step);
  std::vector<Byte> kept((count + 7) / 8 * 8, Byte{0});
  std::size_t found = 0;
  for (int y = margin; y < scores.rows - margin; ++y) {
    keep_maxima({scores.ptr<Byte>(y) + margin, stride, count, kept.data()});
    // No two neighbours are both kept, so a row has no more than half of its pixels.
    if (corners.size() < found + count) corners.resize(2 * found + count);
    for (int x = 0; x < count; x += 8) {
      std::uint64_t eight = 0;
      std::memcpy(&eight, &kept[x], sizeof eight);
      while (eight != 0) {
        const int bit = std::countr_zero(eight) & ~7;
        corners[found++] = {static_cast<std::int16_t>(margin + x + bit / 8), static_cast<std::int16_t>(y),
                            static_cast<Byte>(eight >> bit)};
        eight &= ~(std::uint64_t{0xFF} << bit);
      }
    }
  }
  corners.resize(found);
}

cv::Point2f refine_corner(const cv::Mat& scores, const Corner& corner) {
  const auto vertex = [](int before, int at, int after) {
    const int curvature = 2 * at - before - after;
    if (curvature <= 0) return 0.0F;
    const float offset = 0.5F * static_cast<float>(after - before) / static_cast<float>(curvature);
    return std::clamp(offset, -kFurthest, kFurthest);
  };
  const Byte* row = scores.ptr<Byte>(corner.y) + corner.x;
  const auto stride = static_cast<std::ptrdiff_t>(scores.step);
  return {vertex(row[-1], row[0], row[1]), vertex(row[-stride], row[0], row[stride])};
}

}  // namespace spslam
