// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/mapping/local_adjustment.h"

#include <gmock/gmock.h>

#include "mapping/synthetic_map.h"

namespace spslam {
namespace {

SyntheticOptions many_hosts() {
  SyntheticOptions options;
  options.cameras = 8;
  options.hosts = 6;
  options.points = 300;
  return options;
}

double largest_pose_error(const test::MapWorld& world) {
  double error = 0;
  for (const auto& [id, keyframe] : world.map.keyframes()) {
    const SE3& truth = world.truth.poses[static_cast<std::size_t>(id.value)].camera_from_world;
    error = std::max(error, (keyframe.camera_from_world * truth.inverse()).translation.norm());
  }
  return error;
}

TEST(LocalAdjustment, BringsADisturbedNeighbourhoodBack) {
  test::MapWorld world = test::make_map_world(many_hosts());
  test::disturb(world.map, 2, 0.05, 0.005, 0.01);
  ASSERT_GT(largest_pose_error(world), 0.05);
  AdjustmentOptions options;
  options.keyframes = 6;
  options.solver.iterations = 20;
  AdjustmentProblem local = copy_neighbourhood(world.map, world.truth.rig, {7}, options);
  const SolveSummary summary = solve(local.problem, options.solver);
  EXPECT_LT(summary.final_cost, summary.initial_cost);
  write_back(local, world.map);
  EXPECT_LT(largest_pose_error(world), 0.02);
}

TEST(LocalAdjustment, HoldsTheKeyframesOutside) {
  test::MapWorld world = test::make_map_world(many_hosts());
  AdjustmentOptions options;
  options.keyframes = 3;
  const AdjustmentProblem local = copy_neighbourhood(world.map, world.truth.rig, {7}, options);
  int free = 0;
  for (const PoseVariable& pose : local.problem.poses) free += !pose.fixed;
  EXPECT_EQ(free, 3);
  EXPECT_FALSE(local.problem.poses.back().fixed);
  EXPECT_EQ(local.keyframes.back(), KeyframeId{7});
}

TEST(LocalAdjustment, SomethingIsAlwaysHeld) {
  test::MapWorld world = test::make_map_world(many_hosts());
  AdjustmentOptions options;
  options.keyframes = 100;
  const AdjustmentProblem local = copy_neighbourhood(world.map, world.truth.rig, {7}, options);
  EXPECT_TRUE(local.problem.poses.front().fixed);
  EXPECT_EQ(local.problem.poses.size(), 8U);
}

TEST(LocalAdjustment, OutliersAreTakenOutAndInliersStay) {
  SyntheticOptions synthetic = many_hosts();
  synthetic.outlier_share = 0.05;
  test::MapWorld world = test::make_map_world(synthetic);
  const AdjustmentOptions options;
  AdjustmentProblem local = copy_neighbourhood(world.map, world.truth.rig, {7}, options);
  solve(local.problem, options.solver);
  const int erased = erase_outliers(local, options.outlier_sigmas, world.map);
  int left = 0, lost = 0, outliers = 0;
  for (std::size_t i = 0; i < world.truth.observations.size(); ++i) {
    const Observation& z = world.truth.observations[i];
    const bool is_there = find_sighting(*world.map.find(KeyframeId{z.pose}), {z.landmark}) != nullptr;
    outliers += world.is_outlier[i];
    left += world.is_outlier[i] && is_there;
    lost += !world.is_outlier[i] && !is_there;
  }
  EXPECT_GT(outliers, 20);
  EXPECT_EQ(erased, outliers - left + lost);
  EXPECT_LT(left, outliers / 20 + 1);
  EXPECT_LT(lost, 5);
}

TEST(LocalAdjustment, StoppedSolveKeepsWhatItHas) {
  test::MapWorld world = test::make_map_world(many_hosts());
  test::disturb(world.map, 2, 0.05, 0.005, 0.01);
  const AdjustmentOptions options;
  AdjustmentProblem local = copy_neighbourhood(world.map, world.truth.rig, {7}, options);
  int asked = 0;
  const SolveSummary summary = solve(local.problem, options.solver, false, [&] { return ++asked > 1; });
  EXPECT_EQ(summary.status, SolveStatus::kStopped);
  EXPECT_EQ(summary.iterations, 1);
  EXPECT_LT(summary.final_cost, summary.initial_cost);
}

TEST(LocalAdjustment, WhatIsNotFiniteIsNotWritten) {
  test::MapWorld world = test::make_map_world(many_hosts());
  AdjustmentProblem local = copy_neighbourhood(world.map, world.truth.rig, {7}, {});
  local.problem.poses.back().camera_from_world.translation.x() = std::nan("");
  local.problem.landmarks.front().inverse_depth = std::nan("");
  write_back(local, world.map);
  EXPECT_TRUE(world.map.find(KeyframeId{7})->camera_from_world.is_finite());
  for (const auto& [id, landmark] : world.map.landmarks()) EXPECT_TRUE(std::isfinite(landmark.inverse_depth));
}

TEST(LocalAdjustment, WhatHasGoneMeanwhileIsLeftOut) {
  test::MapWorld world = test::make_map_world(many_hosts());
  const AdjustmentProblem local = copy_neighbourhood(world.map, world.truth.rig, {7}, {});
  world.map.erase(KeyframeId{5});
  world.map.erase(local.landmarks.front());
  write_back(local, world.map);
  EXPECT_EQ(world.map.find(local.landmarks.front()), nullptr);
  EXPECT_EQ(world.map.find(KeyframeId{5}), nullptr);
}

}  // namespace
}  // namespace spslam
