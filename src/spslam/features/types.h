// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// A keypoint and its binary descriptor, the currency of everything that matches.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace spslam {

struct Keypoint {
  float x = 0, y = 0;       // px, in the full-size image, pixel centres at whole numbers
  float angle = 0;          // rad, orientation from the intensity centroid
  float response = 0;       // the detector's score
  std::uint8_t octave = 0;  // pyramid level it was found on, 0 = full size
};

using Descriptor = std::array<std::uint64_t, 4>;  // rotated BRIEF-256

// Hamming distance, equation (3) of the paper: 0 to 256.
inline int hamming(const Descriptor& a, const Descriptor& b) {
  int distance = 0;
  for (int i = 0; i < 4; ++i) distance += std::popcount(a[i] ^ b[i]);
  return distance;
}

struct Features {
  std::vector<Keypoint> keypoints;
  std::vector<Descriptor> descriptors;  // as long as keypoints
};

}  // namespace spslam
