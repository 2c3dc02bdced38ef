// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The essential graph: the spanning tree, the loops and the strongest covisibilities, as a pose graph (Mur-
// Artal, Montiel and Tardos 2015, section III-D and VII-C).
//
// What an edge of odometry knows. Near the shore rotation follows from far points and hardly drifts, lateral
// motion follows from them almost as well, but the length of the way rests on small disparities, whose common
// error e (px) scales it by e over the disparity d of what the two keyframes share: sigma along the way =
// |t| e / d, within bounds; sigma across it and of the rotation are shares of their own. So a loop's gap is
// spread mostly over the stretches where nothing was near, which is where it arose.
#pragma once

#include "spslam/base/options.h"
#include "spslam/camera/stereo_rig.h"
#include "spslam/loop/correction.h"
#include "spslam/optimize/pose_graph.h"

namespace spslam {

struct EssentialGraphOptions {
  int min_shared = 60;
  double disparity_error = 0.1;
  double least_share = 0.01;
  double greatest_share = 0.5;
  double across_share = 0.01;
  double rotation_sigma = 0.03;
  double rotation_per_metre = 0.03;
  int least_connected = 15;
  SolverOptions solver{.iterations = 50, .loss = Loss::kNone, .relative_decrease = 1e-6};

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.min_shared, {"min_shared", "",
                            "landmarks that keyframes share at least for an edge beside the tree's", 1, 1e6});
    visit(self.disparity_error, {"disparity_error", "px", "common error of the disparities", 0, 5});
    visit(self.least_share, {"least_share", "", "sigma along the way over its length, at least", 1e-4, 10});
    visit(self.greatest_share, {"greatest_share", "", "the same, at most", 1e-4, 10});
    visit(self.across_share, {"across_share", "", "sigma across the way over its length", 1e-4, 10});
    visit(self.rotation_sigma, {"rotation_sigma", "deg", "of any edge's rotation", 1e-4, 45});
    visit(self.rotation_per_metre,
          {"rotation_per_metre", "deg", "of rotation more, for a metre of way (its root)", 0, 45});
    visit(self.least_connected,
          {"least_connected", "", "landmarks shared without which an edge is dead reckoning", 0, 1000});
    visit.group("solver", self.solver);
  }
};

struct EssentialGraph {
  PoseGraph graph;
  std::vector<KeyframeId> keyframes;  // one a pose, ascending; the first is fixed
  LoopEdge edge;                      // the new one
};

// All that is needed, to be solved without the map. It takes seconds for thousands of keyframes. Throws
// std::invalid_argument if an end of the loop is not in the map.
EssentialGraph essential_graph(const Map& map, const StereoRig& rig, const LoopClosure& closure,
                               const EssentialGraphOptions& options);

// New poses of all its keyframes and the edge; empty if it could not be solved or was stopped.
MapCorrection solve_essential_graph(EssentialGraph graph, const EssentialGraphOptions& options,
                                    const std::function<bool()>& stop = {});

// Covariance of the motion between two keyframes as odometry knows it (see above), of a left perturbation of
// second_from_first.
Matrix6d odometry_covariance(const Map& map, const StereoRig& rig, const Keyframe& first,
                             const Keyframe& second, const EssentialGraphOptions& options);

}  // namespace spslam
