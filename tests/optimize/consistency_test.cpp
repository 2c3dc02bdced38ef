// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Normalized estimation error squared (Bar-Shalom, Li, Kirubarajan, 2001, section 5.4): over 200 runs with
// noise of the stated deviations its mean must lie between the 2.5 % and 97.5 % points of a chi-square of 6 x
// 200 degrees of freedom, divided by 200: 5.53 to 6.49.

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "spslam/optimize/synthetic.h"

namespace spslam {
namespace {

constexpr int kRuns = 200;

double mean_nees(Loss loss, double outliers) {
  double sum = 0;
  for (int run = 0; run < kRuns; ++run) {
    SyntheticOptions world;
    world.cameras = 3, world.hosts = 2, world.points = 120, world.outlier_share = outliers;
    world.seed = 1000 + static_cast<std::uint64_t>(run);
    const Problem truth = make_synthetic_world(world).truth;
    Problem problem = truth;
    disturb(problem, {0.02, 0.005, 0.005, world.seed});
    SolverOptions options;
    options.loss = loss, options.iterations = 50, options.relative_decrease = 1e-9;
    const SolveSummary summary = solve(problem, options, true);
    const Vector6d error =
        (problem.poses[2].camera_from_world * truth.poses[2].camera_from_world.inverse()).log();
    const Matrix6d covariance = summary.covariance.bottomRightCorner<6, 6>();
    sum += error.dot(covariance.inverse() * error);
  }
  return sum / kRuns;
}

TEST(Consistency, ErrorsAreAsLargeAsTheCovarianceSays) {
  const double nees = mean_nees(Loss::kNone, 0);
  EXPECT_GT(nees, 5.53);
  EXPECT_LT(nees, 6.49);
}

// The robust loss takes some weight from good observations: its covariance is a few percent too large, never
// too small.
TEST(Consistency, WithTheRobustLoss) {
  const double nees = mean_nees(Loss::kCauchy, 0);
  EXPECT_GT(nees, 0.85 * 5.53);
  EXPECT_LT(nees, 6.49);
}

TEST(Consistency, WithTheRobustLossAndOutliers) {
  const double nees = mean_nees(Loss::kCauchy, 0.05);
  EXPECT_GT(nees, 0.85 * 5.53);
  EXPECT_LT(nees, 1.15 * 6.49);
}

}  // namespace
}  // namespace spslam
