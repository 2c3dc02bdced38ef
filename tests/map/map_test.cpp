// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/map/map.h"

#include <gmock/gmock.h>

namespace spslam {
namespace {

Keyframe keyframe(std::int64_t id) {
  Keyframe k;
  k.id = {id};
  k.timestamp = 0.1 * static_cast<double>(id);
  return k;
}

Landmark landmark(std::int64_t id, double inverse_depth = 0.1) {
  Landmark l;
  l.id = {id};
  l.inverse_depth = inverse_depth;
  return l;
}

TEST(Map, FindsWhatWasAddedAndNothingElse) {
  Map map;
  map.add(keyframe(3));
  map.add(landmark(3, 0.25));
  ASSERT_NE(map.find(KeyframeId{3}), nullptr);
  EXPECT_EQ(map.find(KeyframeId{3})->timestamp, 0.1 * 3);
  ASSERT_NE(map.find(LandmarkId{3}), nullptr);
  EXPECT_EQ(map.find(LandmarkId{3})->inverse_depth, 0.25);
  EXPECT_EQ(map.find(KeyframeId{4}), nullptr);
  EXPECT_EQ(map.find(LandmarkId{}), nullptr);
}

TEST(Map, EraseLeavesTheOthers) {
  Map map;
  for (int i = 0; i < 3; ++i) map.add(keyframe(i)), map.add(landmark(i));
  map.erase(KeyframeId{1});
  map.erase(LandmarkId{0});
  map.erase(LandmarkId{77});  // not there: nothing happens
  EXPECT_EQ(map.find(KeyframeId{1}), nullptr);
  EXPECT_EQ(map.find(LandmarkId{0}), nullptr);
  EXPECT_EQ(map.keyframes().size(), 2U);
  EXPECT_EQ(map.landmarks().size(), 2U);
  map.add(keyframe(1));  // the id is free again
  EXPECT_EQ(map.keyframes().size(), 3U);
}

TEST(Map, RefusesIdsThatAreTakenOrNotValid) {
  Map map;
  map.add(keyframe(5));
  map.add(landmark(6, 0.5));
  EXPECT_THROW(map.add(keyframe(5)), std::invalid_argument);
  EXPECT_THROW(map.add(landmark(6)), std::invalid_argument);
  EXPECT_THROW(map.add(Keyframe{}), std::invalid_argument);
  EXPECT_THROW(map.add(Landmark{}), std::invalid_argument);
  EXPECT_EQ(map.find(LandmarkId{6})->inverse_depth, 0.5);  // the first one stays
  try {
    map.add(landmark(6));
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("landmark 6"));
  }
}

TEST(Map, ReplacesEstimatesOfWhatIsStillThere) {
  Map map;
  map.add(keyframe(0));
  map.add(landmark(0));
  const SE3 pose{Eigen::Matrix3d::Identity(), {1, 2, 3}};
  EXPECT_TRUE(map.set_pose({0}, pose));
  EXPECT_EQ(map.find(KeyframeId{0})->camera_from_world.translation, pose.translation);
  EXPECT_TRUE(map.set_estimate({0}, -0.01, 400));
  EXPECT_EQ(map.find(LandmarkId{0})->inverse_depth, -0.01);
  EXPECT_EQ(map.find(LandmarkId{0})->information, 400);
  EXPECT_FALSE(map.set_pose({1}, pose));
  EXPECT_FALSE(map.set_estimate({1}, 0, 0));
  EXPECT_EQ(map.keyframes().size(), 1U);
}

TEST(Map, IsInOrderOfIds) {
  Map map;
  for (const int id : {4, 1, 3}) map.add(keyframe(id));
  std::vector<std::int64_t> ids;
  for (const auto& [id, value] : map.keyframes()) ids.push_back(id.value);
  EXPECT_THAT(ids, testing::ElementsAre(1, 3, 4));
}

}  // namespace
}  // namespace spslam
