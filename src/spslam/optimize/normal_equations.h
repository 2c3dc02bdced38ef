// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The normal equations of a Problem at its present values, before the landmarks are eliminated. Used by
// solve() only.
#pragma once

#include "spslam/optimize/problem.h"

namespace spslam {

// Which columns of the pose part belong to which pose, and to the disparity offset, which is eliminated last
// like a pose.
struct PoseColumns {
  explicit PoseColumns(const Problem& problem);
  std::vector<int> of_pose;  // first column, or -1 for a fixed pose
  int offset = -1;  // first of the 4 columns of the disparity offset, after the poses; -1 if it is fixed
  int count = 0;    // all columns
};

struct NormalEquations {
  double cost = 0;
  Eigen::MatrixXd pose_hessian;   // count x count, symmetric, whole
  Eigen::VectorXd pose_gradient;  // count
  // One row a landmark: the mixed second derivatives, and the landmark's own.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> mixed;  // landmarks x count
  Eigen::VectorXd landmark_hessian, landmark_gradient;  // 0 rows stay 0 for fixed landmarks
};

// Same bits at any number of threads: the landmarks are cut into blocks of a fixed size, summed in order.
void build_normal_equations(const Problem& problem, const PoseColumns& columns, const SolverOptions& options,
                            NormalEquations& out);

}  // namespace spslam
