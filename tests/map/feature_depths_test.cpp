// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/map/feature_depths.h"

#include <gmock/gmock.h>

namespace spslam {
namespace {

Sighting seen_at(std::int64_t landmark, double x, double y) {
  Sighting out;
  out.landmark = {landmark};
  out.measured = {x, y, 1};
  out.inverse_sigma = {1, 1, 1};
  return out;
}

Keypoint corner_at(float x, float y) {
  Keypoint out{};
  out.x = x, out.y = y;
  return out;
}

// Two landmarks 10 m and 20 m before the first keyframe; the second one is 5 m ahead of it.
Map two_keyframes() {
  Map map;
  for (int i = 0; i < 2; ++i) {
    Landmark landmark;
    landmark.id = {i};
    landmark.host = {0};
    landmark.inverse_depth = i == 0 ? 0.1 : 0.05;
    landmark.information = 100;
    map.add(landmark);
  }
  for (int i = 0; i < 2; ++i) {
    Keyframe keyframe;
    keyframe.id = {i};
    if (i > 0) keyframe.parent = {0};
    keyframe.camera_from_world.translation.z() = -5.0 * i;
    keyframe.sightings = {seen_at(0, 100, 50), seen_at(1, 106, 50)};
    map.add(std::move(keyframe));
  }
  return map;
}

TEST(FeatureDepths, AreThoseOfTheNearestLandmarkFromWhereTheKeyframeIs) {
  const Map map = two_keyframes();
  const std::vector<Keypoint> corners = {corner_at(100, 50), corner_at(104, 51), corner_at(101, 44),
                                         corner_at(111, 50)};
  const std::vector<FeatureDepth> own = feature_depths(map, *map.find(KeyframeId{0}), corners);
  ASSERT_EQ(own.size(), corners.size());
  EXPECT_DOUBLE_EQ(own[0].inverse_depth, 0.1);
  EXPECT_DOUBLE_EQ(own[0].information, 100);
  EXPECT_DOUBLE_EQ(own[1].inverse_depth, 0.05);
  EXPECT_EQ(own[2].information, 0) << "farther than " << kDepthRadius << " px from either";
  EXPECT_DOUBLE_EQ(own[3].inverse_depth, 0.05);
  // 5 m nearer; what is known of the distance, in m, stays the same: the information of 1/5 is to that of
  // 1/10 as the fourth power of the distances.
  const std::vector<FeatureDepth> ahead = feature_depths(map, *map.find(KeyframeId{1}), corners);
  EXPECT_DOUBLE_EQ(ahead[0].inverse_depth, 1 / 5.0);
  EXPECT_DOUBLE_EQ(ahead[0].information, 100 / 16.0);
  EXPECT_DOUBLE_EQ(ahead[1].inverse_depth, 1 / 15.0);
}

TEST(FeatureDepths, FollowTheMap) {
  Map map = two_keyframes();
  map.set_estimate({0}, 0.125, 400);
  map.erase(LandmarkId{1});
  const std::vector<Keypoint> corners = {corner_at(100, 50), corner_at(106, 50)};
  const std::vector<FeatureDepth> depths = feature_depths(map, *map.find(KeyframeId{0}), corners);
  EXPECT_DOUBLE_EQ(depths[0].inverse_depth, 0.125);
  EXPECT_DOUBLE_EQ(depths[0].information, 400);
  EXPECT_EQ(depths[1].information, 0);
  EXPECT_TRUE(feature_depths(map, *map.find(KeyframeId{0}), {}).empty());
}

// A landmark that the keyframe has passed has no depth there.
TEST(FeatureDepths, NothingBehindTheCamera) {
  Map map = two_keyframes();
  map.set_pose({1}, SE3{Eigen::Matrix3d::Identity(), {0, 0, -12}});
  const std::vector<Keypoint> corners = {corner_at(98, 50)};
  EXPECT_EQ(feature_depths(map, *map.find(KeyframeId{1}), corners)[0].information, 0);
}

}  // namespace
}  // namespace spslam
