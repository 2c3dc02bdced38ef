// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/mapping/culling.h"

#include <gmock/gmock.h>

#include "mapping/synthetic_map.h"

namespace spslam {
namespace {

// `cameras` keyframes in one place, each of which sees the same landmarks.
test::MapWorld same_place(int cameras, double step) {
  SyntheticOptions options;
  options.cameras = cameras;
  options.step = step;
  options.turn = 0;
  options.noise = false;
  options.far_share = 0.1;
  options.farthest = 8;
  return test::make_map_world(options);
}

TEST(CullLandmarks, ThoseThatNobodyElseSawGoAfterTheirTrial) {
  test::MapWorld world = same_place(4, 0.01);
  for (int k = 1; k < 4; ++k) world.map.erase_sighting({k}, {7});
  CullingOptions options;
  options.landmark_trial = 3;
  EXPECT_EQ(cull_landmarks(world.map, {2}, options), 0);  // the trial of keyframe 0 is not over
  EXPECT_GE(cull_landmarks(world.map, {3}, options), 1);
  EXPECT_EQ(world.map.find(LandmarkId{7}), nullptr);
  EXPECT_NE(world.map.find(LandmarkId{8}), nullptr);
}

TEST(CullKeyframes, RedundantOnesGoAndTheirLandmarksStay) {
  test::MapWorld world = same_place(12, 0.01);
  const std::size_t landmarks = world.map.landmarks().size();
  CullingOptions options;
  options.keep_newest = 5;
  const std::vector<KeyframeId> gone = cull_keyframes(world.map, {11}, options);
  EXPECT_FALSE(gone.empty());
  EXPECT_EQ(world.map.landmarks().size(), landmarks);
  EXPECT_NE(world.map.find(KeyframeId{0}), nullptr);  // the root
  for (int k = 7; k < 12; ++k) EXPECT_NE(world.map.find(KeyframeId{k}), nullptr);
  for (const KeyframeId id : gone) {
    const auto pose = world.map.camera_from_world(id);
    ASSERT_TRUE(pose);
    const SE3& truth = world.truth.poses[static_cast<std::size_t>(id.value)].camera_from_world;
    EXPECT_LT((pose->translation - truth.translation).norm(),
              1e-9);  // frames that hang on it keep their place
  }
}

TEST(CullKeyframes, EndsOfLoopsStay) {
  test::MapWorld world = same_place(12, 0.01);
  for (int k = 1; k < 7; ++k) world.map.add(LoopEdge{{0}, {k}, {}, 1});
  CullingOptions options;
  options.keep_newest = 5;
  EXPECT_TRUE(cull_keyframes(world.map, {11}, options).empty());
}

TEST(CullKeyframes, ASecondVisitOfAPlaceGoes) {
  test::MapWorld world = same_place(12, 0.01);
  CullingOptions options;
  options.keep_newest = 3;
  options.redundant_share = 1;  // never
  options.revisit_gap = 5;
  EXPECT_EQ(cull_keyframes(world.map, {11}, options), std::vector<KeyframeId>{{9}});
  options.revisit_gap = 50;  // no earlier visit is that long ago
  EXPECT_TRUE(cull_keyframes(world.map, {11}, options).empty());
}

TEST(CullKeyframes, AnotherPlaceStays) {
  test::MapWorld world = same_place(12, 0.4);
  CullingOptions options;
  options.keep_newest = 3;
  options.redundant_share = 1;
  options.revisit_gap = 5;
  EXPECT_TRUE(cull_keyframes(world.map, {11}, options).empty());
}

TEST(Culling, SwitchedOffNothingGoes) {
  test::MapWorld world = same_place(12, 0.01);
  CullingOptions options;
  options.enabled = false;
  options.keep_newest = 3;
  EXPECT_EQ(cull_landmarks(world.map, {11}, options), 0);
  EXPECT_TRUE(cull_keyframes(world.map, {11}, options).empty());
}

}  // namespace
}  // namespace spslam
