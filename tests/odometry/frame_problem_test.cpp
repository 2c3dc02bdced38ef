// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/odometry/frame_problem.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "odometry/synthetic_map.h"
#include "spslam/base/random.h"

namespace spslam {
namespace {

Vector6d error_of(const SE3& estimate, const SE3& truth) {
  return (estimate * truth.inverse()).log();
}

TEST(EstimateMotion, FindsTheTruthOfExactSightings) {
  SyntheticOptions options;
  options.cameras = 2, options.noise = false;
  test::SyntheticMap world = test::make_synthetic_map(options);
  for (ActiveLandmark& active : world.map.landmarks) active.landmark.information = 1e4;
  SolverOptions solver;
  solver.iterations = 50, solver.relative_decrease = 0;
  const SE3& truth = world.truth.poses[1].camera_from_world;
  const SE3 start = SE3::exp((Vector6d() << 0.05, 0.02, -0.1, 0.01, -0.02, 0.01).finished()) * truth;
  const MotionEstimate estimate = estimate_motion(world.map, world.sightings[1], start, solver);
  EXPECT_TRUE(estimate.solved);
  EXPECT_LT(error_of(estimate.camera_from_world, truth).norm(), 1e-6);
}

TEST(EstimateMotion, TooFewSightingsAreNoMotion) {
  const test::SyntheticMap world = test::make_synthetic_map({.cameras = 2});
  const std::vector<Sighting> two(world.sightings[1].begin(), world.sightings[1].begin() + 2);
  EXPECT_FALSE(estimate_motion(world.map, two, SE3{}, {}).solved);
  EXPECT_FALSE(estimate_motion(world.map, {}, SE3{}, {}).solved);
}

// Normalized estimation error squared over 200 frames whose landmarks are as uncertain as their information
// says; bounds of the mean: chi-square of 1200 degrees of freedom, 95 %, over 200: 5.53 to 6.49.
double mean_nees(Loss loss) {
  constexpr int kRuns = 200;
  double sum = 0;
  for (int run = 0; run < kRuns; ++run) {
    SyntheticOptions options;
    options.cameras = 2, options.points = 120, options.seed = 500 + static_cast<std::uint64_t>(run);
    test::SyntheticMap world = test::make_synthetic_map(options);
    Random random(options.seed);
    const double deviation = 0.3 / world.map.rig.disparity_per_inverse_depth();
    for (ActiveLandmark& active : world.map.landmarks) {
      active.landmark.inverse_depth += deviation * random.normal();
      active.landmark.information = 1 / (deviation * deviation);
    }
    SolverOptions solver;
    solver.loss = loss, solver.iterations = 30, solver.relative_decrease = 1e-9;
    const SE3& truth = world.truth.poses[1].camera_from_world;
    const MotionEstimate estimate = estimate_motion(world.map, world.sightings[1], truth, solver);
    const Vector6d error = error_of(estimate.camera_from_world, truth);
    sum += error.dot(estimate.covariance.inverse() * error);
  }
  return sum / kRuns;
}

TEST(EstimateMotion, ErrorsAreAsLargeAsTheCovarianceSays) {
  const double nees = mean_nees(Loss::kNone);
  EXPECT_GT(nees, 5.53);
  EXPECT_LT(nees, 6.49);
}

// The robust loss gives a covariance a few percent too large, never too small.
TEST(EstimateMotion, ErrorsAreNoLargerWithTheRobustLoss) {
  const double nees = mean_nees(Loss::kCauchy);
  EXPECT_GT(nees, 0.85 * 5.53);
  EXPECT_LT(nees, 6.49);
}

// A far point of weight w counts like one with sigma / sqrt(w).
TEST(EstimateMotion, WeightsScaleTheInformation) {
  const test::SyntheticMap world = test::make_synthetic_map({.cameras = 2});
  std::vector<Sighting> weighted = world.sightings[1], blurred = world.sightings[1];
  for (Sighting& s : weighted) s.weight = 0.25;
  for (Sighting& s : blurred) s.inverse_sigma *= 0.5;
  SolverOptions solver;
  solver.loss = Loss::kNone;
  const SE3& start = world.truth.poses[1].camera_from_world;
  const MotionEstimate a = estimate_motion(world.map, weighted, start, solver),
                       b = estimate_motion(world.map, blurred, start, solver);
  EXPECT_LT(error_of(a.camera_from_world, b.camera_from_world).norm(), 1e-12);
  EXPECT_TRUE(a.covariance.isApprox(b.covariance, 1e-9));
}

TEST(RefineWindow, FindsTheTruthOfExactSightings) {
  SyntheticOptions options;
  options.cameras = 6, options.hosts = 2, options.noise = false;
  test::SyntheticMap world = test::make_synthetic_map(options);
  test::fill_window(world);
  Problem moved = world.truth;
  disturb(moved, {0.02, 0.005, 0.01, 9});
  for (std::size_t f = 0; f < world.map.window.size(); ++f)
    world.map.window[f].camera_from_world = moved.poses[f].camera_from_world;
  world.map.hosts.at({1}).camera_from_world = moved.poses[1].camera_from_world;
  for (std::size_t l = 0; l < moved.landmarks.size(); ++l)
    world.map.landmarks[l].landmark.inverse_depth = moved.landmarks[l].inverse_depth;
  SolverOptions solver;
  solver.iterations = 100, solver.relative_decrease = 0;
  EXPECT_TRUE(refine_window(world.map, solver));
  for (std::size_t f = 0; f < world.map.window.size(); ++f)
    EXPECT_LT(error_of(world.map.window[f].camera_from_world, world.truth.poses[f].camera_from_world).norm(),
              1e-6);
  EXPECT_EQ(world.map.hosts.at({1}).camera_from_world.matrix3x4(),
            world.map.window[1].camera_from_world.matrix3x4());
}

TEST(RefineWindow, AnEmptyWindowHasNoSolution) {
  ActiveMap map;
  map.rig = test::make_synthetic_map({}).map.rig;
  EXPECT_FALSE(refine_window(map, {}));
}

}  // namespace
}  // namespace spslam
