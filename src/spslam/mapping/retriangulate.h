// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The paper's landmark update (3.2.1, Figure 7).
#pragma once

#include "spslam/map/map.h"
#include "spslam/optimize/problem.h"

namespace spslam {

struct RetriangulationOptions {
  bool enabled = true;
  double anomalous_sigmas = 4;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.enabled, {"enabled", "", "triangulate landmarks anew between covisible keyframes (Figure 7)"});
    visit(self.anomalous_sigmas,
          {"anomalous_sigmas", "sigma",
           "disparity residual beyond which a depth is anomalous and triangulated anew", 0.5, 100});
  }
};

// The inverse depth in its host that fits the positions (u, v) at which other keyframes saw a landmark, by
// Gauss and Newton from the present one, with its information. Nothing if it is not determined: too few views
// in front of it, no parallax, not finite.
struct Triangulated {
  double inverse_depth = 0, information = 0;
};
std::optional<Triangulated> triangulate_by_observers(const Map& map, const StereoRig& rig,
                                                     const Landmark& landmark);

// For each landmark that `keyframe` sees and did not find itself: if the angle between the rays from its host
// and from this keyframe exceeds the stereo parallax of both, or its depth is anomalous, its position becomes
// that of triangulation; otherwise it stays. The number of those that changed.
int retriangulate(Map& map, const StereoRig& rig, KeyframeId keyframe, const RetriangulationOptions& options);

}  // namespace spslam
