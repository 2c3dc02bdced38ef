// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Local bundle adjustment (paper 3.2.2): the newest keyframe, those covisible with it and the landmarks that
// they see, solved together by the one estimator; other keyframes that see these landmarks are held.
#pragma once

#include "spslam/map/map.h"
#include "spslam/optimize/problem.h"

namespace spslam {

struct AdjustmentOptions {
  bool enabled = true;
  int keyframes = 8;
  bool uniform_weights = true;
  SolverOptions solver{.iterations = 8};
  double outlier_sigmas = 6;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.enabled, {"enabled", "", "adjust poses and landmarks around each new keyframe (3.2.2)"});
    visit(self.keyframes, {"keyframes", "", "keyframes whose poses are adjusted at most", 1, 200});
    visit(self.uniform_weights,
          {"uniform_weights", "", "far points count as much as near ones, as in 3.2.2; off: as in (9)"});
    visit.group("solver", self.solver);
    visit(self.outlier_sigmas,
          {"outlier_sigmas", "sigma", "sightings that are farther off afterwards are taken out", 1, 1000});
  }
};

// A copy of a part of the map as a problem, with the ids of its poses and landmarks.
struct AdjustmentProblem {
  Problem problem;
  std::vector<KeyframeId> keyframes;  // one a pose
  std::vector<LandmarkId> landmarks;  // one a landmark
};

// The part of the map around a keyframe. At least one pose is held: the oldest, if nothing else ties the
// rest.
AdjustmentProblem copy_neighbourhood(const Map& map, const StereoRig& rig, KeyframeId newest,
                                     const AdjustmentOptions& options);
// The part of the map that consists of these keyframes and all that they see; `free` says whose poses may
// move. Ascending ids.
AdjustmentProblem copy_problem(const Map& map, const StereoRig& rig, const std::vector<KeyframeId>& keyframes,
                               const std::vector<KeyframeId>& free, bool uniform_weights);

// Writes what was solved to what is still there. Landmarks or poses that are not finite are left as they
// were.
void write_back(const AdjustmentProblem& solved, Map& map);

// Takes out the sightings that lie farther from the solution than `sigmas`; their number.
int erase_outliers(const AdjustmentProblem& solved, double sigmas, Map& map);

}  // namespace spslam
