// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/loop/place.h"

#include <gtest/gtest.h>

#include "loop/place_world.h"

namespace spslam {
namespace {

using namespace test;

// What was known of the depths when the keyframe was described is not the last word.
TEST(Place, PointsAreAsDeepAsTheMapKnowsThemNow) {
  auto features = std::make_shared<KeyframeFeatures>();
  for (const float x : {100.0F, 300.0F}) {
    Keypoint keypoint{};
    keypoint.x = x, keypoint.y = 50;
    features->keypoints.push_back(keypoint);
    features->descriptors.emplace_back();
    features->inverse_depths.push_back(0.1F);
    features->information.push_back(100);
  }
  Map map;
  Landmark landmark;
  landmark.id = {0}, landmark.host = {1};
  landmark.inverse_depth = 0.08, landmark.information = 900;
  map.add(landmark);
  Keyframe keyframe;
  keyframe.id = {1};
  keyframe.features = features;
  keyframe.sightings.push_back({{0}, {101, 50, 2}, {1, 1, 1}, 1});
  map.add(keyframe);

  const Place now = place_of(map, boat_rig(), {1}, 0);
  ASSERT_EQ(now.points.size(), 2U);
  EXPECT_DOUBLE_EQ(now.points[0].inverse_depth, 0.08);
  EXPECT_DOUBLE_EQ(now.points[0].information, 900);
  EXPECT_FLOAT_EQ(static_cast<float>(now.points[1].inverse_depth), 0.1F) << "no landmark is there any more";
  const Place then = place_of(boat_rig(), {1}, features);
  EXPECT_FLOAT_EQ(static_cast<float>(then.points[0].inverse_depth), 0.1F);
  EXPECT_TRUE(place_of(map, boat_rig(), {2}, 0).points.empty());
}

}  // namespace
}  // namespace spslam
