// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/loop/correction.h"

#include <gtest/gtest.h>

#include <cmath>

namespace spslam {
namespace {

Map two_keyframes() {
  Map map;
  for (const std::int64_t id : {0, 1}) {
    Landmark landmark;
    landmark.id = {id};
    landmark.host = {id};
    landmark.inverse_depth = 0.1, landmark.information = 50;
    map.add(landmark);
    Keyframe keyframe;
    keyframe.id = {id};
    keyframe.sightings = {{{id}}};
    map.add(keyframe);
  }
  return map;
}

TEST(Correction, DepthsAreWrittenInTheHostTheyWereFoundIn) {
  Map map = two_keyframes();
  MapCorrection correction;
  correction.inverse_depths = {{{0}, {0}, 0.2}, {{1}, {0}, 0.3}, {{77}, {0}, 0.4}};
  apply(correction, map);
  EXPECT_EQ(map.find(LandmarkId{0})->inverse_depth, 0.2);
  EXPECT_EQ(map.find(LandmarkId{0})->information, 50);
  EXPECT_EQ(map.find(LandmarkId{1})->inverse_depth, 0.1);  // its host was another then
}

TEST(Correction, WhatIsNotFiniteIsLeftAsItWas) {
  Map map = two_keyframes();
  MapCorrection correction;
  correction.inverse_depths = {{{0}, {0}, std::nan("")}};
  correction.camera_from_world = {{{1}, {Eigen::Matrix3d::Identity(), {std::nan(""), 0, 0}}}};
  apply(correction, map);
  EXPECT_EQ(map.find(LandmarkId{0})->inverse_depth, 0.1);
  EXPECT_TRUE(map.find(KeyframeId{1})->camera_from_world.is_finite());
}

// Those that came while the correction was made move with the newest one that it knows.
TEST(Correction, NewerKeyframesMoveAlong) {
  Map map = two_keyframes();
  Keyframe late;
  late.id = {2};
  late.camera_from_world.translation = {0, 0, -2};
  map.add(late);
  MapCorrection correction;
  correction.camera_from_world = {{{0}, {}}, {{1}, {Eigen::Matrix3d::Identity(), {0, 0, -1}}}};
  extend(correction, map);
  apply(correction, map);
  EXPECT_NEAR(map.find(KeyframeId{2})->camera_from_world.translation.z(), -3, 1e-12);
}

}  // namespace
}  // namespace spslam
