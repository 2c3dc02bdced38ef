// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/mapping/retriangulate.h"

#include <gmock/gmock.h>

#include "mapping/synthetic_map.h"

namespace spslam {
namespace {

SyntheticOptions exact() {
  SyntheticOptions options;
  options.noise = false;
  options.far_share = 0.2;
  options.step = 0.3;
  return options;
}

TEST(Triangulate, FindsTheTrueInverseDepthFromPositionsAlone) {
  test::MapWorld world = test::make_map_world(exact());
  int found = 0;
  for (const auto& [id, landmark] : world.map.landmarks()) {
    Landmark wrong = landmark;
    wrong.inverse_depth += 0.02;
    const auto out = triangulate_by_observers(world.map, world.truth.rig, wrong);
    if (!out) continue;
    EXPECT_NEAR(out->inverse_depth, landmark.inverse_depth, 1e-6);
    EXPECT_GT(out->information, 0);
    ++found;
  }
  EXPECT_GT(found, 150);
}

TEST(Triangulate, NothingFromOneView) {
  SyntheticOptions options = exact();
  options.cameras = 1;
  test::MapWorld world = test::make_map_world(options);
  EXPECT_FALSE(triangulate_by_observers(world.map, world.truth.rig, *world.map.find(LandmarkId{0})));
}

TEST(Triangulate, NothingWithoutABaseline) {
  SyntheticOptions options = exact();
  options.step = 0;
  test::MapWorld world = test::make_map_world(options);
  EXPECT_FALSE(triangulate_by_observers(world.map, world.truth.rig, *world.map.find(LandmarkId{0})));
}

TEST(Triangulate, NothingFromWhatIsNotFinite) {
  test::MapWorld world = test::make_map_world(exact());
  Landmark landmark = *world.map.find(LandmarkId{0});
  landmark.inverse_depth = std::nan("");
  EXPECT_FALSE(triangulate_by_observers(world.map, world.truth.rig, landmark));
}

// Figure 7: the angle between the rays exceeds both stereo parallaxes, so the wrong depth is replaced.
TEST(Retriangulate, LargeParallaxReplacesTheDepth) {
  test::MapWorld world = test::make_map_world(exact());
  test::disturb(world.map, 100, 0, 0, 0.01);
  const int changed = retriangulate(world.map, world.truth.rig, {5}, {});
  EXPECT_GT(changed, 50);
  int right = 0;
  for (const Sighting& s : world.map.find(KeyframeId{5})->sightings) {
    const Landmark& landmark = *world.map.find(s.landmark);
    const double truth = world.truth.landmarks[static_cast<std::size_t>(s.landmark.value)].inverse_depth;
    const double error = std::abs(landmark.inverse_depth - truth);
    EXPECT_TRUE(error < 1e-6 || std::abs(error - 0.01) < 1e-9) << error;  // the true value or the old one
    right += error < 1e-6;
  }
  EXPECT_EQ(right, changed);
}

// What the tracker saw in all its frames may be known better than keyframes can tell.
TEST(Retriangulate, AWellKnownDepthStaysWhateverTheParallax) {
  test::MapWorld world = test::make_map_world(exact());
  const std::map<LandmarkId, Landmark> truth = world.map.landmarks();
  for (const auto& [id, landmark] : truth) world.map.set_estimate(id, landmark.inverse_depth + 1e-5, 1e9);
  EXPECT_EQ(retriangulate(world.map, world.truth.rig, {5}, {}), 0);
  for (const auto& [id, landmark] : truth) {
    world.map.set_estimate(id, landmark.inverse_depth + 1e-5, 1e-3);
    EXPECT_NEAR(world.map.find(id)->inverse_depth, landmark.inverse_depth + 1e-5, 1e-12);
  }
  EXPECT_GT(retriangulate(world.map, world.truth.rig, {5}, {}), 50);
}

// A camera that hardly moves sees less parallax than its own two eyes: the old values stay.
TEST(Retriangulate, SmallParallaxKeepsTheDepth) {
  SyntheticOptions options = exact();
  options.step = 0.001;
  options.cameras = 3;
  options.turn = 0;
  test::MapWorld world = test::make_map_world(options);
  const std::map<LandmarkId, Landmark> before = world.map.landmarks();
  retriangulate(world.map, world.truth.rig, {2}, {});
  for (const auto& [id, landmark] : world.map.landmarks()) {
    if (before.at(id).inverse_depth <= 0) continue;
    EXPECT_EQ(landmark.inverse_depth, before.at(id).inverse_depth);
  }
}

TEST(Retriangulate, AnomalousDepthIsReplacedWhateverTheParallax) {
  SyntheticOptions options = exact();
  options.step = 0.02;
  test::MapWorld world = test::make_map_world(options);
  LandmarkId near{};
  for (const auto& [id, landmark] : world.map.landmarks())
    if (landmark.inverse_depth > 0.4 && find_sighting(*world.map.find(KeyframeId{5}), id)) near = id;
  ASSERT_TRUE(near.valid());
  const double truth = world.map.find(near)->inverse_depth;
  world.map.set_estimate(near, truth + 0.3, 100);
  retriangulate(world.map, world.truth.rig, {5}, {});
  EXPECT_NEAR(world.map.find(near)->inverse_depth, truth, 1e-6);
}

TEST(Retriangulate, SwitchedOffOrWithoutTheKeyframeNothingHappens) {
  test::MapWorld world = test::make_map_world(exact());
  EXPECT_EQ(retriangulate(world.map, world.truth.rig, {5}, {.enabled = false}), 0);
  EXPECT_EQ(retriangulate(world.map, world.truth.rig, {77}, {}), 0);
}

}  // namespace
}  // namespace spslam
