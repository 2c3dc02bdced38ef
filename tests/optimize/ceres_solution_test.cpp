// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Windows as local mapping makes them, with every loss: Ceres by its dense and its sparse Schur complement
// and ours end at the same cost, poses and inverse depths.

#include <gtest/gtest.h>

#include "optimize/with_ceres.h"
#include "spslam/base/random.h"
#include "spslam/optimize/synthetic.h"

namespace spslam {
namespace {

// Two poses are held, one of them in the middle; some landmarks have priors, some are held, some weigh less.
Problem window(std::uint64_t seed, bool with_outliers) {
  SyntheticOptions world;
  world.cameras = 7, world.hosts = 5, world.points = 150, world.seed = seed;
  world.outlier_share = with_outliers ? 0.03 : 0;
  Problem problem = make_synthetic_world(world).truth;
  problem.poses[3].fixed = true;
  Random random(seed);
  for (std::size_t l = 0; l < problem.landmarks.size(); ++l) {
    LandmarkVariable& landmark = problem.landmarks[l];
    landmark.prior_inverse_depth = landmark.inverse_depth + 0.003 * random.normal();
    landmark.prior_information = l % 3 == 0 ? 1e5 : 0;
    landmark.fixed = l % 17 == 0;
  }
  for (Observation& z : problem.observations)
    if (z.landmark % 5 == 0) z.weight = 0.4;
  disturb(problem, {0.01, 0.002, 0.003, seed});
  return problem;
}

using Parameters = std::tuple<Loss, ceres::LinearSolverType, std::uint64_t>;
class SolutionOfCeres : public testing::TestWithParam<Parameters> {};

TEST_P(SolutionOfCeres, IsOurs) {
  const auto [loss, type, seed] = GetParam();
  const Problem start = window(seed, loss != Loss::kNone);
  Problem theirs = start, ours = start;
  test::CeresProblem ceres(start, loss, 3);
  ceres::Solver::Options ceres_options;
  ceres_options.linear_solver_type = type;
  ceres_options.max_num_iterations = 300;
  ceres_options.function_tolerance = 1e-15;
  ceres_options.logging_type = ceres::SILENT;
  const ceres::Solver::Summary by_ceres = ceres.solve(ceres_options);
  ceres.write_to(theirs);
  SolverOptions options;
  options.iterations = 200, options.relative_decrease = 1e-14, options.loss = loss;
  const SolveSummary by_us = solve(ours, options);
  EXPECT_NEAR(by_us.initial_cost / by_ceres.initial_cost, 1, 1e-10);
  EXPECT_GT(by_us.initial_cost, 1.3 * by_us.final_cost);
  EXPECT_NEAR(by_us.final_cost / by_ceres.final_cost, 1, 1e-8);
  for (std::size_t i = 0; i < ours.poses.size(); ++i) {
    const SE3 difference = ours.poses[i].camera_from_world * theirs.poses[i].camera_from_world.inverse();
    EXPECT_LT(difference.log().cwiseAbs().maxCoeff(), 1e-5) << "pose " << i;
  }
  for (std::size_t l = 0; l < ours.landmarks.size(); ++l)
    EXPECT_NEAR(ours.landmarks[l].inverse_depth, theirs.landmarks[l].inverse_depth, 1e-5) << "landmark " << l;
}

INSTANTIATE_TEST_SUITE_P(
    Windows, SolutionOfCeres,
    testing::Combine(testing::Values(Loss::kNone, Loss::kHuber, Loss::kPseudoHuber, Loss::kCauchy),
                     testing::Values(ceres::DENSE_SCHUR, ceres::SPARSE_SCHUR), testing::Values(1U, 2U)));

}  // namespace
}  // namespace spslam
