// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Poses that are tied to each other by measured relative motions: what remains of a map when its landmarks
// are left out. Solved after a loop was closed (SPEC part 8). (Grisetti, Kuemmerle, Stachniss, Burgard, "A
// tutorial on graph-based SLAM", 2010.)
#pragma once

#include "spslam/optimize/problem.h"

namespace spslam {

// r = log(T_j T_i^-1 T_measured^-1), T camera_from_world; cost r' information r, or the robust loss of it.
struct PoseEdge {
  int i = 0, j = 0;  // poses
  SE3 j_from_i;
  Matrix6d information = Matrix6d::Identity();  // of a left perturbation of j_from_i, (1/m^2, 1/rad^2)
  bool robust = false;                          // under the solver's loss; false: always quadratic
};

struct PoseGraph {
  std::vector<PoseVariable> poses;
  std::vector<PoseEdge> edges;
};

// Residual of an edge and its derivatives by left perturbations of its two poses; exact.
struct LinearizedEdge {
  Vector6d residual;
  Matrix6d by_i, by_j;
};
LinearizedEdge linearize(const PoseEdge& edge, const SE3& i, const SE3& j);

// Inverse of the left Jacobian of SE(3): log(exp(delta) exp(xi)) = xi + J^-1(xi) delta + O(delta^2), for
// rotations below pi. (Barfoot, "State estimation for robotics", 2017, section 7.1.5.)
Matrix6d inverse_left_jacobian(const Vector6d& xi);

// Minimizes the cost over the free poses by Levenberg-Marquardt with a sparse Cholesky factorization. Free
// poses are replaced by the best ones found; kFailed, and none is changed, if an edge is not finite or names
// a pose that is not there. The summary has no covariance. `stop`, if given, is asked before each step.
SolveSummary solve(PoseGraph& graph, const SolverOptions& options, const std::function<bool()>& stop = {});

// The cost at the present values.
double total_cost(const PoseGraph& graph, const SolverOptions& options);

}  // namespace spslam
