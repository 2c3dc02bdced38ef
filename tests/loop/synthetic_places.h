// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Descriptors as places have them: each place has its own, and an image of it sees most of them with some
// bits turned over. Like real ones they come in kinds: a few hundred patterns that each differ from place to
// place.
#pragma once

#include <vector>

#include "spslam/base/random.h"
#include "spslam/features/types.h"

namespace spslam {

inline Descriptor random_descriptor(Random& random) {
  Descriptor out = {};
  for (std::uint64_t& part : out) part = (std::uint64_t{random.next()} << 32U) | random.next();
  return out;
}

inline Descriptor with_noise(Descriptor descriptor, int bits, Random& random) {
  for (int i = 0; i < bits; ++i) {
    const std::uint32_t bit = random.below(256);
    descriptor[bit / 64] ^= std::uint64_t{1} << (bit % 64);
  }
  return descriptor;
}

class SyntheticPlaces {
 public:
  SyntheticPlaces(int places, int features, std::uint64_t seed = 1) : random_(seed) {
    std::vector<Descriptor> kinds(300);
    for (Descriptor& kind : kinds) kind = random_descriptor(random_);
    places_.resize(static_cast<std::size_t>(places));
    for (auto& place : places_)
      for (int i = 0; i < features; ++i) place.push_back(with_noise(kinds[random_.below(300)], 60, random_));
  }
  // Another image of the place at each call: three quarters of its features, with noise in their bits, and as
  // many others as are missing.
  std::vector<Descriptor> image(int place, int noisy_bits = 8) {
    std::vector<Descriptor> out;
    for (const Descriptor& descriptor : places_[static_cast<std::size_t>(place)])
      out.push_back(random_.uniform() < 0.75 ? with_noise(descriptor, noisy_bits, random_)
                                             : random_descriptor(random_));
    return out;
  }
  std::vector<std::vector<Descriptor>> images_of_all(int noisy_bits = 8) {
    std::vector<std::vector<Descriptor>> out;
    for (int place = 0; place < static_cast<int>(places_.size()); ++place)
      out.push_back(image(place, noisy_bits));
    return out;
  }

 private:
  Random random_;
  std::vector<std::vector<Descriptor>> places_;
};

}  // namespace spslam
