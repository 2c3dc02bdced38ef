// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Descriptors of nothing, and the same seen again.
#pragma once

#include "spslam/base/random.h"
#include "spslam/features/types.h"

namespace spslam::test {

inline Descriptor random_descriptor(Random& random) {
  Descriptor out = {};
  for (std::uint64_t& word : out) word = (std::uint64_t{random.next()} << 32U) | random.next();
  return out;
}

// Some bits may be drawn twice, and stay.
inline Descriptor flip_bits(Descriptor descriptor, int bits, Random& random) {
  for (int i = 0; i < bits; ++i) {
    const std::uint32_t bit = random.below(256);
    descriptor[bit / 64] ^= std::uint64_t{1} << (bit % 64);
  }
  return descriptor;
}

}  // namespace spslam::test
