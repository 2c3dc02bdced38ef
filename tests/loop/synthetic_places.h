// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Descriptors as places have them: each place has its own, and an image of it sees most of them with some
// bits turned over. Like real ones they come in kinds: a few hundred patterns that each differ from place to
// place.
#pragma once

#include <vector>

#include "features/made_up_descriptors.h"
#include "spslam/base/random.h"
#include "spslam/features/types.h"

namespace spslam {

class SyntheticPlaces {
 public:
  SyntheticPlaces(int places, int features, std::uint64_t seed = 1)
      : places_(static_cast<std::size_t>(places)) {
    Random random(seed);
    std::vector<Descriptor> kinds(300);
    for (Descriptor& kind : kinds) kind = test::random_descriptor(random);
    for (auto& place : places_)
      for (int i = 0; i < features; ++i)
        place.push_back(test::flip_bits(kinds[random.below(300)], 60, random));
  }
  // A view of the place: three quarters of its features with noise in their bits, and as many others as are
  // missing.
  std::vector<Descriptor> image(int place, int view = 0) const {
    constexpr int kNoisyBits = 8;
    Random random(static_cast<std::uint64_t>(1000 + view) * 100000 + static_cast<std::uint64_t>(place));
    std::vector<Descriptor> out;
    for (const Descriptor& descriptor : places_[static_cast<std::size_t>(place)])
      out.push_back(random.uniform() < 0.75 ? test::flip_bits(descriptor, kNoisyBits, random)
                                            : test::random_descriptor(random));
    return out;
  }
  std::vector<std::vector<Descriptor>> images_of_all() const {
    std::vector<std::vector<Descriptor>> out;
    for (int place = 0; place < static_cast<int>(places_.size()); ++place) out.push_back(image(place));
    return out;
  }

 private:
  std::vector<std::vector<Descriptor>> places_;
};

}  // namespace spslam
