// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The tracker's two callers of the one estimator: the motion of one frame, and a short window of frames.
#pragma once

#include "spslam/odometry/active_map.h"

namespace spslam {

// Where a camera is, and how well that is known.
struct MotionEstimate {
  SE3 camera_from_world;
  Matrix6d covariance =
      Matrix6d::Identity();  // of a left perturbation of camera_from_world, (m, rad), camera axes
  double cost = 0;           // robust, at the solution
  bool solved = false;
};

// Equations (6) to (9): the pose of one frame from its sightings, the landmarks' inverse depths being known
// as well as their information says. Here and below landmarks on trial are left out where enough others
// are seen.
MotionEstimate estimate_motion(const ActiveMap& map, const std::vector<Sighting>& sightings, const SE3& start,
                               const SolverOptions& options);

// Solves for the poses of all frames of the window but the first and for the inverse depths of all that they
// see. The map's are replaced by the solution; false, and nothing is changed, if there is none.
bool refine_window(ActiveMap& map, const SolverOptions& options);

// The window with its disparity offset free; nothing but `offset` (in and out) is changed.
SolveSummary solve_for_offset(const ActiveMap& map, const SolverOptions& options, DisparityOffset& offset);

}  // namespace spslam
