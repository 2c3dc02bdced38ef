// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Full bundle adjustment in the background after a loop (SPEC part 8): all keyframes and landmarks by the one
// estimator, on a copy, to be abandoned when a newer loop arrives.
#pragma once

#include "spslam/loop/correction.h"
#include "spslam/mapping/local_adjustment.h"

namespace spslam {

struct FullAdjustmentOptions {
  bool enabled = true;
  int max_keyframes = 150;
  SolverOptions solver{.iterations = 10, .loss = Loss::kPseudoHuber};

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.enabled, {"enabled", "", "bundle adjustment of the whole map after a loop"});
    visit(self.max_keyframes,
          {"max_keyframes", "", "no adjustment of a map with more: its time grows with their third power", 2,
           10000});
    visit.group("solver", self.solver);
  }
};

// All keyframes, the first one held, and all they see. Empty if the options rule it out.
AdjustmentProblem copy_full_problem(const Map& map, const StereoRig& rig,
                                    const FullAdjustmentOptions& options);

// Poses and inverse depths; empty if it was stopped or failed.
MapCorrection solve_full_problem(AdjustmentProblem problem, const FullAdjustmentOptions& options,
                                 const std::function<bool()>& stop = {});

}  // namespace spslam
