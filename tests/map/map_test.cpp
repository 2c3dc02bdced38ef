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

// Keyframes 0 to 3; landmark 10 k + i is hosted by keyframe k, i = 0 to 3, and seen by k and the next `i`.
Map chain() {
  Map map;
  for (int k = 0; k < 4; ++k) {
    for (int i = 0; i < 4; ++i) {
      Landmark l = landmark(10 * k + i);
      l.host = {k};
      map.add(l);
    }
    Keyframe frame = keyframe(k);
    frame.camera_from_world.translation.z() = -k;
    for (int host = 0; host <= k; ++host)
      for (int i = k - host; i < 4; ++i) {
        Sighting s;
        s.landmark = {10 * host + i};
        s.measured = {1.0 * host, 2.0 * i, 3};
        s.inverse_sigma = host == k ? Eigen::Vector3d(0, 0, 5) : Eigen::Vector3d(4, 4, 5);
        frame.sightings.push_back(s);
      }
    map.add(std::move(frame));
  }
  return map;
}

TEST(Map, CovisibilityCountsSharedLandmarks) {
  const Map map = chain();
  // 0 and 1 share i = 1..3 of host 0; 1 and 2 those of host 1 and i = 2, 3 of host 0.
  EXPECT_THAT(map.covisible({0}),
              testing::ElementsAre(Covisible{{1}, 3}, Covisible{{2}, 2}, Covisible{{3}, 1}));
  EXPECT_THAT(map.covisible({2}, 4), testing::ElementsAre(Covisible{{3}, 6}, Covisible{{1}, 5}));
  EXPECT_THAT(map.observers({3}),
              testing::ElementsAre(KeyframeId{0}, KeyframeId{1}, KeyframeId{2}, KeyframeId{3}));
  EXPECT_TRUE(map.covisible({9}).empty());
}

TEST(Map, ParentIsTheKeyframeThatSharesMost) {
  const Map map = chain();
  EXPECT_FALSE(map.find(KeyframeId{0})->parent.valid());
  for (int k = 1; k < 4; ++k) EXPECT_EQ(map.find(KeyframeId{k})->parent, KeyframeId{k - 1});
}

TEST(Map, ErasedKeyframeLeavesItsLandmarksToTheNextThatSawThem) {
  Map map = chain();
  const Landmark before = *map.find(LandmarkId{11});
  const Eigen::Vector3d point =
      map.find(KeyframeId{1})->camera_from_world.inverse() * (before.bearing / before.inverse_depth);
  map.add(LoopEdge{{1}, {3}, {}, 50});
  ASSERT_TRUE(map.erase(KeyframeId{1}));
  EXPECT_EQ(map.find(LandmarkId{10}), nullptr);  // nobody else saw it
  const Landmark* after = map.find(LandmarkId{11});
  ASSERT_NE(after, nullptr);
  EXPECT_EQ(after->host, KeyframeId{2});
  const Eigen::Vector3d moved =
      map.find(KeyframeId{2})->camera_from_world.inverse() * (after->bearing / after->inverse_depth);
  EXPECT_LT((moved - point).norm(), 1e-9);
  EXPECT_EQ(map.find(KeyframeId{2})->parent, KeyframeId{0});
  EXPECT_TRUE(map.loops().empty());
  for (const auto& [id, l] : map.landmarks()) {
    EXPECT_NE(l.host, KeyframeId{1});
    for (const KeyframeId observer : map.observers(id)) EXPECT_NE(observer, KeyframeId{1});
  }
  EXPECT_FALSE(map.erase(KeyframeId{0}));  // the root of the tree stays
}

// A new host one metre nearer: 10 m become 9, and 8 m become 7, which is what stereo said.
TEST(Map, WhatStereoSaidMovesToTheNextHost) {
  Map map;
  Landmark point = landmark(0, 0.1);
  point.host = {0};
  point.information = 1000;
  point.stereo_inverse_depth = 0.125, point.stereo_information = 500;
  map.add(point);
  for (const std::int64_t id : {0, 1, 2}) {
    Keyframe k = keyframe(id);
    k.camera_from_world.translation.z() = -static_cast<double>(id);
    k.sightings = {{{0}, {1, 2, 3}, {4, 4, 5}}};
    map.add(k);
  }
  ASSERT_FALSE(map.erase(KeyframeId{0}));  // the root
  point.id = {1}, point.host = {1};
  map.add(point);
  map.set_sighting({1}, {{1}, {1, 2, 3}, {4, 4, 5}});
  map.set_sighting({2}, {{1}, {1, 2, 3}, {4, 4, 5}});
  ASSERT_TRUE(map.erase(KeyframeId{1}));
  const Landmark& moved = *map.find(LandmarkId{1});
  EXPECT_EQ(moved.host, KeyframeId{2});
  EXPECT_NEAR(moved.inverse_depth, 1 / 9.0, 1e-12);
  EXPECT_NEAR(moved.stereo_inverse_depth, 1 / 7.0, 1e-12);
  // By w' = w / (1 - w): its derivative is (1 - w)^-2.
  EXPECT_NEAR(moved.information, 1000 * std::pow(0.9, 4), 1e-9);
  EXPECT_NEAR(moved.stereo_information, 500 * std::pow(0.875, 4), 1e-9);
}

TEST(Map, ErasedLandmarkIsSeenByNobody) {
  Map map = chain();
  map.erase(LandmarkId{3});
  for (const auto& [id, k] : map.keyframes()) EXPECT_EQ(find_sighting(k, {3}), nullptr);
  EXPECT_TRUE(map.observers({3}).empty());
}

TEST(Map, FusedLandmarkKeepsBothHistories) {
  Map map = chain();
  map.fuse({3}, {21});  // 3 is seen by all, 21 by keyframes 2 and 3
  EXPECT_EQ(map.find(LandmarkId{21}), nullptr);
  EXPECT_EQ(find_sighting(*map.find(KeyframeId{2}), {3})->measured.y(), 6);  // its own, not that of 21
  map.fuse({0}, {31});                                                       // seen by 0 alone, by 3 alone
  EXPECT_THAT(map.observers({0}), testing::ElementsAre(KeyframeId{0}, KeyframeId{3}));
  EXPECT_EQ(find_sighting(*map.find(KeyframeId{3}), {0})->measured.y(), 2);
  EXPECT_GT(find_sighting(*map.find(KeyframeId{3}), {0})->inverse_sigma.x(), 0);
  map.fuse({0}, {0});
  map.fuse({0}, {777});
  EXPECT_NE(map.find(LandmarkId{0}), nullptr);
}

}  // namespace
}  // namespace spslam
