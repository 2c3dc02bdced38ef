// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The patch around a feature and its orientation by the intensity centroid (Rosin, "Measuring corner
// properties", 1999; Rublee et al. 2011, section 3.2).
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>

namespace spslam {

constexpr int kPatchRadius =
    15;  // px on the feature's level: the circle that orientation and descriptor look at

// A copy of the pixels around a feature, so that what reads it needs no bounds and stays in the first-level
// cache.
struct Patch {
  static constexpr int kSide = 2 * kPatchRadius + 1;
  static constexpr int kStride = 32;
  alignas(32) std::array<std::uint8_t, kSide * kStride> pixels;
};

// The patch centred at (x, y) of a CV_8UC1 image that is not empty; pixels beyond its edge repeat the edge.
// (x, y) must be inside.
void copy_patch(const cv::Mat& grey, int x, int y, Patch& patch);

// Angle in rad, (-pi, pi], of the vector from the centre to the intensity centroid within the circle; y
// points down. 0 for a patch without one.
float patch_orientation(const Patch& patch);

}  // namespace spslam
