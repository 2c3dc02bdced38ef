// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Points without a depth: they must neither break the solution nor pull it to one side.

#include <gtest/gtest.h>

#include "spslam/optimize/synthetic.h"

namespace spslam {
namespace {

// Rotation error (rad) and variances of the second of two cameras.
struct TwoCameras {
  double rotation_error = 0, rotation_variance = 0, translation_variance = 0;
};

TwoCameras solve_two_cameras(double far_share) {
  SyntheticOptions world;
  world.cameras = 2, world.far_share = far_share;
  const Problem truth = make_synthetic_world(world).truth;
  Problem problem = truth;
  disturb(problem, {0, 0.01, 0.001, 3});
  const SolveSummary summary = solve(problem, SolverOptions{}, true);
  EXPECT_NE(summary.status, SolveStatus::kFailed);
  EXPECT_EQ(summary.covariance.rows(), 6);
  const Eigen::Vector3d error = so3_log(problem.poses[1].camera_from_world.rotation *
                                        truth.poses[1].camera_from_world.rotation.transpose());
  const Vector6d variances = summary.covariance.diagonal();
  return {error.norm(), variances.tail<3>().maxCoeff(), variances.head<3>().minCoeff()};
}

TEST(FarPoints, AloneGiveTheRotationAndHardlyTheTranslation) {
  const TwoCameras all_far = solve_two_cameras(1), some = solve_two_cameras(0.3);
  EXPECT_LT(all_far.rotation_error, 0.002);
  EXPECT_LT(all_far.rotation_variance, 1e-6);
  EXPECT_GT(all_far.translation_variance, 10 * some.translation_variance);
}

TEST(FarPoints, NegativeDisparitiesStayNegativeInverseDepths) {
  SyntheticOptions world;
  world.cameras = 3, world.far_share = 0.7;
  Problem problem = make_synthetic_world(world).truth;
  disturb(problem, {0.02, 0.005, 0.01, 4});
  const SolveSummary summary = solve(problem, SolverOptions{});
  EXPECT_NE(summary.status, SolveStatus::kFailed);
  int negative = 0;
  for (const LandmarkVariable& landmark : problem.landmarks) negative += landmark.inverse_depth < 0;
  EXPECT_GT(negative, 40);  // about half of the 140 at infinity
  EXPECT_LT(negative, 100);
}

// Along the way, over many draws of the noise: the mean error must vanish against its own deviation, whatever
// the share of far points. Cutting the disparities at zero instead fails this by far (last test).
struct Bias {
  double mean = 0, deviation_of_mean = 0;
};

Bias forward_bias(double far_share, double nearest, double least_disparity) {
  constexpr int kRuns = 150;
  double sum = 0, squares = 0;
  for (int run = 0; run < kRuns; ++run) {
    SyntheticOptions world;
    world.cameras = 2, world.step = 0.6, world.points = 150, world.far_share = far_share;
    world.nearest = nearest, world.farthest = 300, world.seed = 100 + static_cast<std::uint64_t>(run);
    const Problem truth = make_synthetic_world(world).truth;
    Problem problem = truth;
    std::erase_if(problem.observations,
                  [&](const Observation& z) { return z.measured.z() < least_disparity; });
    SolverOptions options;
    options.loss = Loss::kNone;
    solve(problem, options);
    const double way = problem.poses[1].camera_from_world.inverse().translation.z(),
                 true_way = truth.poses[1].camera_from_world.inverse().translation.z();
    sum += way / true_way - 1, squares += (way / true_way - 1) * (way / true_way - 1);
  }
  const double mean = sum / kRuns;
  return {mean, std::sqrt((squares / kRuns - mean * mean) / kRuns)};
}

TEST(FarPoints, DoNotBiasTheLengthOfTheWay) {
  for (const double share : {0.2, 0.6}) {
    const Bias bias = forward_bias(share, 5, -1e9);
    EXPECT_LT(std::abs(bias.mean), 3 * bias.deviation_of_mean + 1e-3) << share;
    EXPECT_LT(bias.deviation_of_mean, 0.01) << share;
  }
}

TEST(FarPoints, CuttingSmallDisparitiesWouldBiasIt) {
  const Bias all = forward_bias(0.3, 15, -1e9), cut = forward_bias(0.3, 15, 0.7);
  EXPECT_GT(std::abs(cut.mean), 3 * std::abs(all.mean));
  EXPECT_GT(std::abs(cut.mean), 5 * cut.deviation_of_mean);
}

}  // namespace
}  // namespace spslam
