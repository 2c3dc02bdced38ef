// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// What a keyframe is recognized by later: ORB features over all levels, with the inverse depths of the
// landmarks that it saw at or near them.
#pragma once

#include "spslam/features/orb_extractor.h"
#include "spslam/map/map.h"

namespace spslam {

struct DescribeOptions {
  int count = 1000;
  int image_quality = 90;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.count, {"count", "", "ORB features kept of a keyframe", 50, 20000});
    visit(self.image_quality,
          {"image_quality", "", "of the JPEG that is kept of its left image; 0: none is kept", 0, 100});
  }
};

// The features of a keyframe that still has its image: first its sightings where they were seen, on full
// size, then corners of all levels, at most `count` in all. Null if it has no image.
std::shared_ptr<const KeyframeFeatures> describe(const Map& map, const Keyframe& keyframe,
                                                 OrbExtractor& extractor, const DescribeOptions& options);

}  // namespace spslam
