// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The poses' equations with the landmarks eliminated (Schur complement; Triggs et al. 2000). Used by solve()
// only.
#pragma once

#include "spslam/optimize/normal_equations.h"

namespace spslam {

struct ReducedSystem {
  SymmetricEnvelope hessian;  // where the offset leaves columns of the last block unused: 1 on the diagonal
  Eigen::VectorXd gradient;   // as long as the Hessian; 0 there
};

// `inverse`: of the landmarks' damped information, 0 for those that stay where they are. Same bits at any
// number of threads: each column of blocks is one task, its sums in the order of the landmarks.
void eliminate_landmarks(const NormalEquations& equations, const ProblemStructure& structure,
                         const Eigen::VectorXd& inverse, double damping, ReducedSystem& out);

}  // namespace spslam
