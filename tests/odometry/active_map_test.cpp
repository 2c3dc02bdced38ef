// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/odometry/active_map.h"

#include <gtest/gtest.h>

#include "odometry/synthetic_map.h"

namespace spslam {
namespace {

test::SyntheticMap full_window(double outliers = 0) {
  SyntheticOptions options;
  options.cameras = 5, options.points = 60, options.outlier_share = outliers;
  test::SyntheticMap world = test::make_synthetic_map(options);
  test::fill_window(world);
  return world;
}

SolverOptions with_loss(Loss loss) {
  SolverOptions options;
  options.loss = loss;
  return options;
}

TEST(ActiveMap, FindsLandmarksById) {
  const test::SyntheticMap world = full_window();
  EXPECT_EQ(world.map.index_of({0}), 0);
  EXPECT_EQ(world.map.index_of({59}), 59);
  EXPECT_EQ(world.map.index_of({60}), -1);
  EXPECT_EQ(world.map.index_of({}), -1);
  EXPECT_EQ(ActiveMap{}.index_of({0}), -1);
}

// Whatever leaves the window, nothing is lost of what all frames together said, and nothing counted twice.
TEST(ActiveMap, FramesThatLeaveTheWindowLeaveTheirInformation) {
  for (const Loss loss : {Loss::kNone, Loss::kCauchy}) {
    ActiveMap map = full_window(0.1).map;
    update_information(map, with_loss(loss));
    const ActiveMap before = map;
    for (const int frames : {3, 1, 0}) {
      shorten_window(map, frames, with_loss(loss));
      EXPECT_EQ(static_cast<int>(map.window.size()), frames);
      update_information(map, with_loss(loss));
      for (std::size_t i = 0; i < map.landmarks.size(); ++i) {
        const double expected = before.landmarks[i].landmark.information;
        EXPECT_GT(expected, 0);
        EXPECT_NEAR(map.landmarks[i].landmark.information, expected, 1e-9 * expected);
      }
    }
  }
}

TEST(ActiveMap, InformationIsThatOfTheDisparitiesAtLeast) {
  test::SyntheticMap world = full_window();
  update_information(world.map, with_loss(Loss::kNone));
  const double scale = world.map.rig.disparity_per_inverse_depth() / 0.3;  // sigma of 0.3 px
  for (const ActiveLandmark& active : world.map.landmarks)
    EXPECT_GE(active.landmark.information, scale * scale * (1 - 1e-12));
}

// The prior's mean is the inverse depth that fits the frames that left, the poses being what they are.
TEST(ActiveMap, ThePriorIsWhereTheFramesThatLeftWouldHaveIt) {
  test::SyntheticMap world = full_window();
  Problem problem = world.truth;
  for (PoseVariable& pose : problem.poses) pose.fixed = true;
  SolverOptions options = with_loss(Loss::kNone);
  options.iterations = 50, options.relative_decrease = 0;
  solve(problem, options);
  for (std::size_t l = 0; l < problem.landmarks.size(); ++l)
    world.map.landmarks[l].landmark.inverse_depth = problem.landmarks[l].inverse_depth;
  shorten_window(world.map, 0, options);
  for (std::size_t l = 0; l < problem.landmarks.size(); ++l)
    EXPECT_NEAR(world.map.landmarks[l].prior_inverse_depth, problem.landmarks[l].inverse_depth, 1e-7);
}

TEST(ActiveMap, TheDisparityOffsetIsTakenOff) {
  SyntheticOptions options;
  options.cameras = 1, options.points = 40, options.noise = false, options.offset = {0.5, 0.2, -0.3, 0.1};
  test::SyntheticMap world = test::make_synthetic_map(options);
  test::fill_window(world);
  world.map.disparity_offset = world.truth.disparity_offset;
  // The library measures with the sign it solves with: residual = predicted + offset - measured.
  shorten_window(world.map, 0, with_loss(Loss::kNone));
  for (std::size_t l = 0; l < world.truth.landmarks.size(); ++l)
    EXPECT_NEAR(world.map.landmarks[l].prior_inverse_depth, world.truth.landmarks[l].inverse_depth, 1e-9);
}

TEST(ActiveMap, ForgetsWhatIsMissedTooOftenAndHostsWithoutUse) {
  SyntheticOptions options;
  options.cameras = 4, options.hosts = 3, options.points = 30;
  ActiveMap map = test::make_synthetic_map(options).map;
  WindowFrame frame;
  frame.keyframe = {2};
  map.window.push_back(frame);
  for (ActiveLandmark& active : map.landmarks) {
    active.missed = active.landmark.host.value == 0 ? 2 : 3;
  }
  forget(map, 2);
  EXPECT_EQ(map.landmarks.size(), 10U);
  EXPECT_TRUE(map.hosts.contains({0}));   // its landmarks are still followed
  EXPECT_FALSE(map.hosts.contains({1}));  // nothing needs it
  EXPECT_TRUE(map.hosts.contains({2}));   // in the window
  map.window.clear();
  forget(map, 1);
  EXPECT_TRUE(map.landmarks.empty());
  EXPECT_TRUE(map.hosts.empty());
}

}  // namespace
}  // namespace spslam
