// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/loop/verification.h"

#include <gtest/gtest.h>
#include <Eigen/LU>

#include "loop/place_world.h"

namespace spslam {
namespace {

using namespace test;

const SE3 kOlder = camera_at(0, 0, 0), kNewer = camera_at(0.8, -0.6, 0.1, 0.05, 0.1);

Verification verify_views(const View& older, const View& newer, const VerificationOptions& options = {}) {
  return verify(place_of(boat_rig(), {1}, older.features), *newer.features, boat_rig(), {}, options);
}

ViewOptions seeded(std::uint64_t seed) {
  ViewOptions view;
  view.seed = seed;
  return view;
}

Vector6d error_of(const Verification& found, const SE3& newer = kNewer) {
  return (found.newer_from_older * (newer * kOlder.inverse()).inverse()).log();
}

TEST(Verification, FindsTheMotionAndKnowsHowWell) {
  double nees = 0;
  constexpr int kTrials = 20;
  for (std::uint64_t seed = 1; seed <= kTrials; ++seed) {
    const auto world = make_world({.seed = seed});
    const Verification found =
        verify_views(see(world, kOlder, seeded(100 + seed)), see(world, kNewer, seeded(200 + seed)));
    ASSERT_TRUE(found.accepted()) << "seed " << seed << ": " << option_names(found.stage)[int(found.stage)];
    const Vector6d error = error_of(found);
    EXPECT_LT(error.head<3>().norm(), 0.15);
    EXPECT_LT(error.tail<3>().norm(), 0.01);
    nees += error.dot(found.covariance.inverse() * error) / 6 / kTrials;
    EXPECT_NEAR(found.scale, 1, 0.1);
  }
  EXPECT_LT(nees, 2);
  EXPECT_GT(nees, 0.1);
}

TEST(Verification, HalfOfWhatLooksAlikeMayBeWrong) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto world = make_world({.points = 900, .seed = seed});
    ViewOptions newer = seeded(200 + seed);
    newer.wrong_share = 0.5;
    const Verification found =
        verify_views(see(world, kOlder, seeded(100 + seed)), see(world, kNewer, newer));
    ASSERT_TRUE(found.accepted()) << "seed " << seed << ": " << option_names(found.stage)[int(found.stage)];
    EXPECT_LT(error_of(found).head<3>().norm(), 0.3);
  }
}

TEST(Verification, ItsPairsAreOfTheSamePoints) {
  const auto world = make_world({});
  const View older = see(world, kOlder, seeded(1)), newer = see(world, kNewer, seeded(2));
  const Place place = place_of(boat_rig(), {1}, older.features);
  const Verification found = verify(place, *newer.features, boat_rig(), {}, {});
  ASSERT_TRUE(found.accepted());
  ASSERT_EQ(static_cast<int>(found.pairs.size()), found.inliers);
  int wrong = 0;
  for (const Correspondence& pair : found.pairs)
    wrong += older.point[place.points[pair.point].feature] != newer.point[pair.feature];
  EXPECT_LE(wrong, found.inliers / 50);
}

TEST(Verification, OtherPlacesAreNeverAccepted) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const auto world = make_world({.seed = 2 * seed}), other = make_world({.seed = 2 * seed + 1});
    EXPECT_FALSE(
        verify_views(see(world, kOlder, seeded(seed)), see(other, kNewer, seeded(1000 + seed))).accepted());
  }
}

// The worst case: every descriptor of one place is found in the other, but things stand elsewhere.
TEST(Verification, TheSameThingsInOtherPlacesAreNotAccepted) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const auto world = make_world({.seed = 2 * seed});
    auto other = make_world({.seed = 2 * seed + 1});
    for (std::size_t i = 0; i < world.size(); ++i) {
      other[i].descriptor = world[i].descriptor;
      other[i].angle = world[i].angle;
    }
    EXPECT_FALSE(
        verify_views(see(world, kOlder, seeded(seed)), see(other, kNewer, seeded(1000 + seed))).accepted());
  }
}

TEST(Verification, FarPointsAloneDoNotSayWhereItIs) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto world = make_world({.far_share = 1, .seed = seed});
    const Verification found =
        verify_views(see(world, kOlder, seeded(seed)), see(world, kNewer, seeded(50 + seed)));
    EXPECT_EQ(found.stage, VerificationStage::kUncertain);
    EXPECT_GE(found.inliers, 30);
    EXPECT_LT(error_of(found).tail<3>().norm(), 0.02);  // but which way it looks
  }
}

TEST(Verification, AllInOneCornerIsNotEnough) {
  const auto world = make_world({.points = 3000});
  View older = see(world, kOlder, seeded(1)), newer = see(world, kOlder, seeded(2));
  const auto keep_corner = [](View& view) {
    View out;
    for (std::size_t i = 0; i < view.features->size(); ++i)
      if (view.features->keypoints[i].x < 150 && view.features->keypoints[i].y < 110)
        add_feature(out, view.point[i], view.features->keypoints[i], view.features->descriptors[i],
                    view.features->inverse_depths[i], view.features->information[i]);
    view = out;
  };
  keep_corner(older);
  keep_corner(newer);
  VerificationOptions options;
  options.min_cells = 12, options.min_inliers = 15, options.min_consensus = 12;
  EXPECT_EQ(verify_views(older, newer, options).stage, VerificationStage::kSpread);
}

TEST(Verification, ADifferentScaleIsMeasuredIfItMayBe) {
  const auto world = make_world({.points = 1000, .nearest = 2, .farthest = 15});
  ViewOptions newer = seeded(2);
  newer.scale = 1.4, newer.disparity_sigma = 0.08;
  ViewOptions older = seeded(1);
  older.disparity_sigma = 0.08;
  VerificationOptions options;
  options.free_scale = true;
  const Verification found = verify_views(see(world, kOlder, older), see(world, kNewer, newer), options);
  ASSERT_TRUE(found.accepted());
  EXPECT_GE(found.scaled, 20);
  EXPECT_NEAR(found.scale, 1 / 1.4, 0.05);
  EXPECT_LT(error_of(found).head<3>().norm(), 0.15);
}

TEST(Verification, SameBitsEveryTime) {
  const auto world = make_world({});
  const View older = see(world, kOlder, seeded(1)), newer = see(world, kNewer, seeded(2));
  const Verification a = verify_views(older, newer), b = verify_views(older, newer);
  EXPECT_EQ(a.newer_from_older.matrix3x4(), b.newer_from_older.matrix3x4());
  EXPECT_EQ(a.covariance, b.covariance);
}

TEST(Verification, NothingToCompareIsSaid) {
  const View nothing;
  const View something = see(make_world({}), kOlder, seeded(1));
  EXPECT_EQ(verify_views(nothing, something).stage, VerificationStage::kNotDescribed);
  EXPECT_EQ(verify_views(something, nothing).stage, VerificationStage::kNotDescribed);
  ViewOptions few = seeded(1);
  few.missed_share = 0.97, few.clutter = 5;
  const View little = see(make_world({}), kOlder, few);
  EXPECT_EQ(verify_views(little, something).stage, VerificationStage::kMatching);
}

TEST(Verification, WhatIsNotFiniteIsLeftOut) {
  const auto world = make_world({});
  View older = see(world, kOlder, seeded(1)), newer = see(world, kNewer, seeded(2));
  const float nan = std::nanf(""), infinite = std::numeric_limits<float>::infinity();
  for (View* view : {&older, &newer})
    for (std::size_t i = 0; i < 40; ++i) {
      KeyframeFeatures& features = *view->features;
      if (i % 4 == 0) features.keypoints[i].x = nan;
      if (i % 4 == 1) features.inverse_depths[i] = infinite;
      if (i % 4 == 2) features.information[i] = nan;
      if (i % 4 == 3) features.keypoints[i].angle = nan;
    }
  const Verification found = verify_views(older, newer);
  EXPECT_TRUE(found.accepted());
  EXPECT_LT(error_of(found).head<3>().norm(), 0.15);
  for (std::size_t i = 0; i < newer.features->size(); ++i) newer.features->inverse_depths[i] = nan;
  EXPECT_TRUE(verify_views(older, newer).newer_from_older.is_finite());
}

TEST(Verification, NeighboursOfTheOlderKeyframeHelp) {
  const auto world = make_world({.points = 400});
  Map map;
  const SE3 beside = camera_at(0.5, 0.3, 0.1);
  ViewOptions rare = seeded(1);
  rare.missed_share = 0.5;
  // Both keyframes see one landmark, which makes them neighbours.
  Landmark landmark;
  landmark.id = {0}, landmark.host = {1};
  map.add(landmark);
  for (int i = 0; i < 2; ++i) {
    Keyframe keyframe;
    keyframe.id = {i + 1};
    keyframe.camera_from_world = i == 0 ? kOlder : beside;
    rare.seed = static_cast<std::uint64_t>(i) + 1;
    keyframe.features = see(world, keyframe.camera_from_world, rare).features;
    keyframe.sightings.push_back({{0}, {1, 1, 0}, {1, 1, 0}, 1});
    map.add(keyframe);
  }
  const View newer = see(world, kNewer, seeded(9));
  const auto with = verify(place_of(map, boat_rig(), {1}, 1), *newer.features, boat_rig(), {}, {});
  const auto without = verify(place_of(map, boat_rig(), {1}, 0), *newer.features, boat_rig(), {}, {});
  EXPECT_GT(with.inliers, 1.3 * without.inliers);
  ASSERT_TRUE(with.accepted());
  EXPECT_LT(error_of(with).head<3>().norm(), 0.15);
}

}  // namespace
}  // namespace spslam
