// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/mapping/fuse.h"

#include <gmock/gmock.h>

#include "mapping/feature_world.h"

namespace spslam {
namespace {

constexpr LandmarkId kOlder{100}, kNewer{200};

// Four keyframes that all see the shared landmarks, and a point that keyframes 0 and 1 saw as one landmark
// and 2 and 3 as another, half a pixel beside.
struct Duplicates {
  test::FeatureWorld world;
  Eigen::Vector3d point;
};

Landmark landmark_at(const test::FeatureWorld& world, LandmarkId id, KeyframeId host,
                     const Eigen::Vector3d& point, const Descriptor& descriptor) {
  const Eigen::Vector3d x = world.map.find(host)->camera_from_world * point;
  Landmark landmark;
  landmark.id = id;
  landmark.host = host;
  landmark.bearing = x / x.z();
  landmark.pixel = world.rig.project(x).cast<float>();
  landmark.inverse_depth = 1 / x.z();
  landmark.information = 1e4;
  landmark.stereo_inverse_depth = 1 / x.z(), landmark.stereo_information = 5e3;
  landmark.descriptor = descriptor;
  return landmark;
}

void see(test::FeatureWorld& world, LandmarkId id, KeyframeId from, const Eigen::Vector3d& point) {
  const Eigen::Vector3d x = world.map.find(from)->camera_from_world * point;
  const Eigen::Vector2d at = world.rig.project(x);
  const double disparity = world.rig.disparity_per_inverse_depth() / x.z();
  const bool is_host = world.map.find(id)->host == from;
  const double sharp = is_host ? 0 : 3;
  world.map.set_sighting(from, {id, {at.x(), at.y(), disparity}, {sharp, sharp, 8}, 1});
}

Duplicates make_duplicates(const Eigen::Vector3d& off = {0.003, 0, 0}, int flipped = 10) {
  test::FeatureWorldOptions options;
  options.cameras = 4;
  options.points = 0;
  Duplicates out{test::make_feature_world(options), {0.2, 0.3, 5}};
  Random random(4);
  const Descriptor descriptor = test::random_descriptor(random);
  test::FeatureWorld& world = out.world;
  world.map.add(landmark_at(world, kOlder, {0}, out.point, descriptor));
  world.map.add(
      landmark_at(world, kNewer, {2}, out.point + off, test::flip_bits(descriptor, flipped, random)));
  for (const std::int64_t k : {0, 1}) see(world, kOlder, {k}, out.point);
  for (const std::int64_t k : {2, 3}) see(world, kNewer, {k}, out.point + off);
  return out;
}

int fused_in(Duplicates& duplicates, double radius = 1.5) {
  DuplicateOptions options;
  options.enabled = true;
  options.radius = radius;
  return fuse_duplicates(duplicates.world.map, duplicates.world.rig, {3}, options);
}

TEST(FuseDuplicates, OneThingBecomesOneLandmark) {
  Duplicates d = make_duplicates();
  Map& map = d.world.map;
  const std::size_t before = map.landmarks().size();
  EXPECT_EQ(fused_in(d), 1);
  EXPECT_EQ(map.landmarks().size(), before - 1);
  EXPECT_EQ(map.find(kOlder), nullptr);
  EXPECT_EQ(map.resolve(kOlder), kNewer);  // the one that is seen now stays
  EXPECT_THAT(map.observers(kNewer),
              testing::ElementsAre(KeyframeId{0}, KeyframeId{1}, KeyframeId{2}, KeyframeId{3}));
  const Sighting& old = *find_sighting(*map.find(KeyframeId{1}), kNewer);
  EXPECT_LT(old.inverse_sigma.x(), 1 / kFusedSigma);
  EXPECT_EQ(old.inverse_sigma.z(), 8);
  EXPECT_EQ(fused_in(d), 0);
}

TEST(FuseDuplicates, WhatBothSidesKnewOfTheDepthAddsUp) {
  Duplicates d = make_duplicates();
  Map& map = d.world.map;
  map.set_estimate(kOlder, map.find(kOlder)->inverse_depth + 0.005, 3e4);
  const double truth = map.find(kNewer)->inverse_depth;
  const double nearer = 1 / (5 * truth);    // the new host stands nearer than the old one, which was 5 m away
  const double gain = std::pow(nearer, 4);  // what is known of a distance, in m, is the same from nearby
  const double added = 3e4 * gain;
  ASSERT_EQ(fused_in(d), 1);
  const Landmark& kept = *map.find(kNewer);
  EXPECT_NEAR(kept.inverse_depth - truth, added / (added + 1e4) * 0.005 / (nearer * nearer), 0.0005);
  EXPECT_NEAR(kept.information, 1e4 + added, 1e3);
  EXPECT_NEAR(kept.stereo_information, 5e3 * (1 + gain), 100);
}

TEST(FuseDuplicates, NeighboursStayTwo) {
  Duplicates beside = make_duplicates({0.05, 0, 0});  // 4 px
  EXPECT_EQ(fused_in(beside), 0);
  Duplicates behind =
      make_duplicates({0.04 * 3, 0.06 * 3, 3});  // on one ray from the first camera, 3 m behind
  EXPECT_EQ(fused_in(behind, 20), 0);
}

TEST(FuseDuplicates, OthersStayTwo) {
  Duplicates unlike = make_duplicates({0.003, 0, 0}, 200);
  EXPECT_EQ(fused_in(unlike), 0);
  // A keyframe that tells them apart has seen both.
  Duplicates told_apart = make_duplicates();
  see(told_apart.world, kOlder, {2}, told_apart.point);
  EXPECT_EQ(fused_in(told_apart), 0);
}

// Whose depth nobody knows may be anywhere on its ray: nothing is known of where it should be seen.
TEST(FuseDuplicates, WithoutADepthNothingIsFused) {
  Duplicates d = make_duplicates();
  for (const LandmarkId id : {kOlder, kNewer})
    d.world.map.set_estimate(id, d.world.map.find(id)->inverse_depth, 0);
  EXPECT_EQ(fused_in(d), 0);
}

TEST(FuseDuplicates, NumbersThatAreNotFiniteFuseNothing) {
  Duplicates d = make_duplicates();
  for (const LandmarkId id : {kOlder, kNewer}) d.world.map.set_estimate(id, std::nan(""), 1e4);
  EXPECT_EQ(fused_in(d), 0);
  Duplicates lost = make_duplicates();
  SE3 nowhere = lost.world.map.find(KeyframeId{3})->camera_from_world;
  nowhere.translation.y() = std::nan("");
  lost.world.map.set_pose({3}, nowhere);
  EXPECT_EQ(fused_in(lost), 0);
}

TEST(FuseDuplicates, SwitchedOffOrWithoutTheKeyframeNothingHappens) {
  Duplicates d = make_duplicates();
  DuplicateOptions off;
  off.enabled = false;
  EXPECT_EQ(fuse_duplicates(d.world.map, d.world.rig, {3}, off), 0);
  DuplicateOptions on;
  on.enabled = true;
  EXPECT_EQ(fuse_duplicates(d.world.map, d.world.rig, {77}, on), 0);
}

}  // namespace
}  // namespace spslam
