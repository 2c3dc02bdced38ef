// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Random numbers by place instead of by order: a pixel's numbers depend on its coordinates, not on which
// thread came first.
#pragma once

#include <cmath>
#include <cstdint>

namespace spslam::sim {

// A bijective mixer of 32 bits (multiply, xor-shift; constants found by C. Wellons' hash prospector, public
// domain).
inline std::uint32_t mix(std::uint32_t x) {
  x ^= x >> 16U;
  x *= 0x7feb352dU;
  x ^= x >> 15U;
  x *= 0x846ca68bU;
  x ^= x >> 16U;
  return x;
}
inline std::uint32_t mix(std::uint32_t a, std::uint32_t b) {
  return mix(a ^ (mix(b) + 0x9e3779b9U + (a << 6U)));
}
inline std::uint32_t mix(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  return mix(mix(a, b), c);
}

// Uniform in [0, 1).
inline float unit(std::uint32_t hash) {
  return static_cast<float>(hash >> 8U) * 0x1p-24F;
}

// Standard normal from two hashes (Box and Muller).
inline float normal(std::uint32_t hash) {
  const float radius = std::sqrt(-2.0F * std::log(1.0F - unit(hash)));
  return radius * std::cos(6.2831853F * unit(mix(hash, 0x51ed270bU)));
}

}  // namespace spslam::sim
