// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// A Problem as Ceres solves it, with derivatives written down anew: the same residuals, losses and priors of
// the inverse depths. For the tests and the bench; the library does not link to Ceres.
#pragma once

#include <ceres/ceres.h>

#include <array>
#include <memory>

#include "spslam/optimize/problem.h"

namespace spslam::test {

// Throws std::invalid_argument for a free disparity offset. The problem has to outlive it.
class CeresProblem {
 public:
  CeresProblem(const Problem& problem, Loss loss, double loss_scale);
  // Costs in our sense: Ceres minimizes half of them. Landmarks are eliminated first, as in ours.
  ceres::Solver::Summary solve(ceres::Solver::Options options);
  // The values that were found.
  void write_to(Problem& problem) const;

 private:
  using PoseBlock = std::array<double, 7>;  // quaternion x, y, z, w, then translation of camera_from_world
  void add(const Problem& problem, const Observation& z);
  ceres::LossFunction* loss_of(double weight);

  std::vector<PoseBlock> poses_;
  std::vector<double> inverse_depths_;
  std::vector<std::unique_ptr<ceres::LossFunction>> scaled_losses_;
  std::unique_ptr<ceres::LossFunction> loss_;
  std::unique_ptr<ceres::Manifold> left_perturbation_;
  std::unique_ptr<ceres::Problem> ceres_;
};

}  // namespace spslam::test
