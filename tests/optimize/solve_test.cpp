// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "spslam/optimize/synthetic.h"

namespace spslam {
namespace {

SolverOptions thorough(Loss loss = Loss::kCauchy) {
  SolverOptions options;
  options.iterations = 100;
  options.relative_decrease = 1e-12;
  options.loss = loss;
  return options;
}

double largest_translation_error(const Problem& a, const Problem& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    const SE3 error = a.poses[i].camera_from_world * b.poses[i].camera_from_world.inverse();
    largest = std::max(largest, error.log().head<3>().norm());
  }
  return largest;
}

double largest_rotation_error(const Problem& a, const Problem& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.poses.size(); ++i)
    largest = std::max(largest, so3_log(a.poses[i].camera_from_world.rotation *
                                        b.poses[i].camera_from_world.rotation.transpose())
                                    .norm());
  return largest;
}

bool is_finite(const Problem& problem) {
  bool finite = true;
  for (const PoseVariable& pose : problem.poses) finite = finite && pose.camera_from_world.is_finite();
  for (const LandmarkVariable& l : problem.landmarks) finite = finite && std::isfinite(l.inverse_depth);
  return finite;
}

TEST(Solve, FindsTheTruthOfExactObservations) {
  SyntheticOptions world;
  world.hosts = 3, world.noise = false;
  const Problem truth = make_synthetic_world(world).truth;
  Problem problem = truth;
  disturb(problem, {});
  const SolveSummary summary = solve(problem, thorough());
  EXPECT_EQ(summary.status, SolveStatus::kConverged);
  EXPECT_GT(summary.initial_cost, 1000);
  EXPECT_LT(summary.final_cost, 1e-10);
  EXPECT_LT(largest_translation_error(problem, truth), 1e-6);
  EXPECT_LT(largest_rotation_error(problem, truth), 1e-7);
  for (std::size_t l = 0; l < truth.landmarks.size(); ++l)
    EXPECT_NEAR(problem.landmarks[l].inverse_depth, truth.landmarks[l].inverse_depth, 1e-6);
}

TEST(Solve, NoiseMovesItByWhatTheCovarianceSays) {
  SyntheticOptions world;
  world.hosts = 3;
  const Problem truth = make_synthetic_world(world).truth;
  Problem problem = truth;
  disturb(problem, {});
  const SolveSummary summary = solve(problem, thorough(), true);
  ASSERT_EQ(summary.covariance.rows(), 30);
  EXPECT_LT(summary.final_cost, total_cost(truth, thorough()));  // the minimum lies below the truth
  for (int pose = 1; pose < 6; ++pose) {
    const Vector6d error =
        (problem.poses[pose].camera_from_world * truth.poses[pose].camera_from_world.inverse()).log();
    const Vector6d sigma = summary.covariance.diagonal().segment<6>(6 * (pose - 1)).cwiseSqrt();
    EXPECT_LT(error.cwiseAbs().cwiseQuotient(sigma).maxCoeff(), 4);
    EXPECT_LT(sigma.head<3>().maxCoeff(), 0.1);
  }
}

TEST(Solve, FindsTheDisparityOffsetOfARig) {
  SyntheticOptions world;
  world.points = 800, world.hosts = 2, world.offset = {0.4, 0.1, -0.1, 0.2};
  const Problem truth = make_synthetic_world(world).truth;
  Problem problem = truth;
  problem.disparity_offset.coefficients.setZero();
  problem.disparity_offset.fixed = false;
  problem.disparity_offset.prior_information.setIdentity();
  disturb(problem, {});
  const SolveSummary summary = solve(problem, thorough(), true);
  const Vector4d sigma = (summary.offset_information + Matrix4d::Identity()).inverse().diagonal().cwiseSqrt();
  EXPECT_LT(sigma.maxCoeff(), 0.1);
  const Vector4d error = problem.disparity_offset.coefficients - world.offset;
  EXPECT_LT(error.cwiseAbs().cwiseQuotient(sigma).maxCoeff(), 4);
  EXPECT_EQ(summary.covariance.rows(), 30);  // of the poses only
}

TEST(Solve, OutliersDoNotMatterWithARobustLoss) {
  SyntheticOptions world;
  world.hosts = 3;
  const Problem truth = make_synthetic_world(world).truth;
  world.outlier_share = 0.15;
  const Problem spoilt = make_synthetic_world(world).truth;
  const auto error_with = [&](Loss loss) {
    Problem problem = spoilt;
    disturb(problem, {0.02, 0.005, 0.01, 5});
    solve(problem, thorough(loss));
    return largest_translation_error(problem, spoilt);
  };
  Problem clean = truth;
  disturb(clean, {0.02, 0.005, 0.01, 5});
  solve(clean, thorough(Loss::kNone));
  const double without = largest_translation_error(clean, truth);
  EXPECT_LT(error_with(Loss::kCauchy), 2 * without + 0.005);
  EXPECT_GT(error_with(Loss::kNone), 4 * without);
  EXPECT_LT(error_with(Loss::kHuber), error_with(Loss::kNone));
  EXPECT_LT(error_with(Loss::kPseudoHuber), error_with(Loss::kNone));
}

TEST(Solve, LeavesFixedPosesAndLandmarksAlone) {
  Problem problem = make_synthetic_world({.hosts = 2}).truth;
  problem.poses[3].fixed = true;
  problem.landmarks[5].fixed = true;
  disturb(problem, {});
  const Problem before = problem;
  solve(problem, thorough());
  for (const int pose : {0, 3}) {
    EXPECT_EQ(problem.poses[pose].camera_from_world.matrix3x4(),
              before.poses[pose].camera_from_world.matrix3x4());
  }
  EXPECT_EQ(problem.landmarks[5].inverse_depth, before.landmarks[5].inverse_depth);
  EXPECT_NE(problem.landmarks[6].inverse_depth, before.landmarks[6].inverse_depth);
}

TEST(Solve, NeverEndsAboveWhereItBegan) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SyntheticOptions world;
    world.cameras = 3, world.points = 30, world.outlier_share = 0.3, world.seed = seed;
    Problem problem = make_synthetic_world(world).truth;
    disturb(problem, {0.5, 0.1, 0.1, seed});
    const SolveSummary summary = solve(problem, SolverOptions{});
    EXPECT_LE(summary.final_cost, summary.initial_cost);
    EXPECT_DOUBLE_EQ(summary.final_cost, total_cost(problem, SolverOptions{}));
    EXPECT_TRUE(is_finite(problem));
  }
}

TEST(Solve, SameBitsAtAnyNumberOfThreads) {
  SyntheticOptions world;
  world.points = 700, world.hosts = 3, world.outlier_share = 0.05;
  const auto run = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Problem problem = make_synthetic_world(world).truth;
    problem.disparity_offset.fixed = false;
    problem.disparity_offset.prior_information.setIdentity();
    disturb(problem, {});
    return std::pair{solve(problem, thorough(), true), problem};
  };
  const auto [one_summary, one] = run(1);
  const auto [two_summary, two] = run(2);
  EXPECT_EQ(one_summary.final_cost, two_summary.final_cost);
  EXPECT_EQ(one_summary.covariance, two_summary.covariance);
  for (std::size_t i = 0; i < one.poses.size(); ++i)
    EXPECT_EQ(one.poses[i].camera_from_world.matrix3x4(), two.poses[i].camera_from_world.matrix3x4());
  for (std::size_t l = 0; l < one.landmarks.size(); ++l)
    EXPECT_EQ(one.landmarks[l].inverse_depth, two.landmarks[l].inverse_depth);
}

void expect_sane(Problem problem, const char* what) {
  const SolveSummary summary = solve(problem, SolverOptions{}, true);
  EXPECT_TRUE(is_finite(problem)) << what;
  EXPECT_TRUE(std::isfinite(summary.final_cost)) << what;
  EXPECT_TRUE(summary.covariance.size() == 0 || summary.covariance.allFinite()) << what;
}

TEST(SolveDegenerate, NothingAtAll) {
  Problem problem;
  const SolveSummary summary = solve(problem, SolverOptions{}, true);
  EXPECT_EQ(summary.final_cost, 0);
  EXPECT_EQ(summary.covariance.size(), 0);
}

TEST(SolveDegenerate, NoObservations) {
  Problem problem = make_synthetic_world({}).truth;
  problem.observations.clear();
  const Problem before = problem;
  const SolveSummary summary = solve(problem, SolverOptions{}, true);
  EXPECT_NE(summary.status, SolveStatus::kConverged);
  EXPECT_EQ(summary.covariance.size(), 0);
  EXPECT_EQ(problem.poses[1].camera_from_world.matrix3x4(), before.poses[1].camera_from_world.matrix3x4());
}

TEST(SolveDegenerate, APoseThatNothingSeesDoesNotStopTheOthers) {
  const Problem truth = make_synthetic_world({.hosts = 2, .noise = false}).truth;
  Problem problem = truth;
  disturb(problem, {});
  const SE3 unseen{so3_exp({0.1, 0, 0}), {1, 2, 3}};
  problem.poses.push_back({unseen, false});
  const SolveSummary summary = solve(problem, thorough(), true);
  EXPECT_EQ(summary.status, SolveStatus::kConverged);
  EXPECT_LT(summary.final_cost, 1e-10);
  const Eigen::Index others = summary.covariance.rows() - 6;
  ASSERT_GT(others, 0);
  EXPECT_GT(summary.covariance.diagonal().tail<6>().minCoeff(), 1e6);  // nothing is known of it
  EXPECT_LT(summary.covariance.diagonal().head(others).maxCoeff(), 1);
  EXPECT_TRUE(problem.poses.back().camera_from_world.matrix3x4().isApprox(unseen.matrix3x4(), 1e-12));
  problem.poses.pop_back();
  EXPECT_LT(largest_translation_error(problem, truth), 1e-6);
}

// A camera that has been put beyond what it saw has not explained it.
TEST(SolveDegenerate, PointsBehindTheCameraCostMoreThanWrongOnes) {
  const Problem truth = make_synthetic_world({.cameras = 2, .far_share = 0}).truth;
  Problem wrong = truth, beyond = truth;
  disturb(wrong, {});
  beyond.poses[1].camera_from_world =
      SE3{so3_exp({0, M_PI, 0}), {0, 0, 0}} * truth.poses[1].camera_from_world;
  const SolverOptions options;
  EXPECT_LT(total_cost(truth, options), total_cost(wrong, options));
  EXPECT_LT(total_cost(wrong, options), total_cost(beyond, options));
}

TEST(SolveDegenerate, AllBehindTheCamera) {
  Problem problem = make_synthetic_world({.cameras = 2, .far_share = 0}).truth;
  problem.poses[1].camera_from_world =
      SE3{so3_exp({0, M_PI, 0}), {0, 0, 0}} * problem.poses[0].camera_from_world;
  std::erase_if(problem.observations, [](const Observation& z) { return z.pose == 0; });
  const SolveSummary summary = solve(problem, SolverOptions{}, true);
  EXPECT_NE(summary.status, SolveStatus::kConverged);
  EXPECT_TRUE(is_finite(problem));
}

TEST(SolveDegenerate, OneOrTwoPointsDoNotBreakIt) {
  for (const int points : {1, 2})
    expect_sane(make_synthetic_world({.cameras = 2, .points = points}).truth, "few");
}

TEST(SolveDegenerate, NoPoseFixed) {
  Problem problem = make_synthetic_world({}).truth;
  problem.poses[0].fixed = false;
  disturb(problem, {});
  expect_sane(problem, "free gauge");
}

TEST(SolveDegenerate, AllPosesFixedSolvesLandmarksOnly) {
  const Problem truth = make_synthetic_world({.far_share = 0, .noise = false}).truth;
  Problem problem = truth;
  for (PoseVariable& pose : problem.poses) pose.fixed = true;
  disturb(problem, {});
  const SolveSummary summary = solve(problem, thorough(), true);
  EXPECT_EQ(summary.status, SolveStatus::kConverged);
  EXPECT_EQ(summary.covariance.size(), 0);
  for (std::size_t l = 0; l < truth.landmarks.size(); ++l)
    EXPECT_NEAR(problem.landmarks[l].inverse_depth, truth.landmarks[l].inverse_depth, 1e-6);
}

TEST(SolveDegenerate, NotANumberIsAFailure) {
  Problem problem = make_synthetic_world({}).truth;
  problem.observations[10].measured.x() = std::nan("");
  const SolveSummary summary = solve(problem, SolverOptions{}, true);
  EXPECT_EQ(summary.status, SolveStatus::kFailed);
}

}  // namespace
}  // namespace spslam
