// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Duplicates: a landmark that was lost and found anew as another one. After a loop the two sides are fused by
// loop/fusion.h; here it is what covisible keyframes see (issue 4; "fusion of duplicates" is what every
// feature SLAM needs).
#pragma once

#include "spslam/map/map.h"
#include "spslam/mapping/patch_sighting.h"

namespace spslam {

struct DuplicateOptions {
  bool enabled = false;
  int keyframes = 10;
  double radius = 1.5;
  int max_distance = 60;
  double depth_sigmas = 3;
  bool align = true;
  AlignmentOptions alignment;
  double position_sigma = 0.35;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.enabled,
          {"enabled", "", "landmarks of covisible keyframes that are one and the same become one"});
    visit(self.keyframes,
          {"keyframes", "", "covisible keyframes that a new one is compared with at most", 1, 50});
    visit(self.radius,
          {"radius", "px", "from where a landmark should be to the one that it may be the same as", 0.1, 20});
    visit(self.max_distance,
          {"max_distance", "bit", "Hamming distance of the two landmarks' descriptors at most", 1, 256});
    visit(self.depth_sigmas, {"depth_sigmas", "sigma", "by which their inverse depths may differ", 0.5, 100});
    visit(self.align,
          {"align", "", "measure what saw one anew by the other's patch while the images are there"});
    visit.group("alignment", self.alignment);
    visit(self.position_sigma, {"position_sigma", "px", "deviation of an aligned position", 0.01, 10});
  }
};

// Fuses landmarks that `newest` sees with such that its covisible keyframes see: where one's projection falls
// onto the other's sighting, both look alike and are equally far, and no keyframe sees both. Kept is the one
// that the newest keyframe sees, as the tracker follows it. Their number.
int fuse_duplicates(Map& map, const StereoRig& rig, KeyframeId newest, const DuplicateOptions& options);

}  // namespace spslam
