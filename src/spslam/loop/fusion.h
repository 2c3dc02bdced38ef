// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// After a loop both sides have landmarks of the same things: they become one, so that bundle adjustment
// holds the sides together from then on.
#pragma once

#include "spslam/base/options.h"
#include "spslam/camera/stereo_rig.h"
#include "spslam/loop/correction.h"

namespace spslam {

struct FusionOptions {
  int neighbours = 5;
  double radius = 4;
  int max_distance = 60;
  double position_sigma = 0.8;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.neighbours, {"neighbours", "", "keyframes around each end of the loop that take part", 0, 50});
    visit(self.radius,
          {"radius", "px", "from where the correction puts a landmark to its duplicate", 0.5, 50});
    visit(self.max_distance,
          {"max_distance", "bit", "Hamming distance of a landmark and its duplicate at most", 1, 256});
    visit(self.position_sigma, {"position_sigma", "px", "of a feature's position, on full size", 0.05, 10});
  }
};

// Fills correction.fused and correction.sightings: the older side's landmarks where the newer side's
// keyframes, at their corrected poses, see landmarks of their own that look the same; and what the closure's
// pairs say of the newer keyframe. Kept is the older one.
void fuse_across(const Map& map, const StereoRig& rig, const LoopClosure& closure,
                 const FusionOptions& options, MapCorrection& correction);

}  // namespace spslam
