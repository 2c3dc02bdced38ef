// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/odometry/far_points.h"

#include <gtest/gtest.h>

#include "odometry/synthetic_map.h"
#include "spslam/base/random.h"

namespace spslam {
namespace {

struct Scene {
  test::SyntheticMap world;
  SE3 predicted;                     // a little wrong
  std::vector<Sighting> sightings;   // of camera 1
  std::vector<LandmarkId> outliers;  // far ones that were moved by 15 to 25 px
};

// Two hundred points, half of them far; a share of the far sightings is wrong, each in its own direction.
Scene make_scene(double outlier_share, std::uint64_t seed = 1) {
  SyntheticOptions options;
  options.cameras = 2, options.points = 200, options.far_share = 0.5, options.seed = seed;
  Scene scene{test::make_synthetic_map(options), {}, {}, {}};
  scene.predicted =
      SE3{so3_exp({0.004, -0.006, 0.003}), {0.02, 0, 0.05}} * scene.world.truth.poses[1].camera_from_world;
  Random random(seed + 50);
  for (Sighting s : scene.world.sightings[1]) {
    const bool far =
        scene.world.truth.landmarks[static_cast<std::size_t>(s.landmark.value)].inverse_depth == 0;
    if (far && random.uniform() < outlier_share) {
      const double direction = random.uniform(0, 2 * M_PI), length = random.uniform(15, 25);
      s.measured.head<2>() += length * Eigen::Vector2d(std::cos(direction), std::sin(direction));
      scene.outliers.push_back(s.landmark);
    }
    scene.sightings.push_back(s);
  }
  return scene;
}

bool is_far(const Scene& scene, const Sighting& s) {
  return scene.world.map.landmarks[scene.world.map.index_of(s.landmark)].landmark.region != Region::kNear;
}

std::ptrdiff_t far_count(const Scene& scene, const std::vector<Sighting>& sightings) {
  return std::count_if(sightings.begin(), sightings.end(),
                       [&](const Sighting& s) { return is_far(scene, s); });
}

TEST(FarPoints, OutliersAreRefusedAndTheOthersStay) {
  const Scene scene = make_scene(0.3);
  std::vector<Sighting> kept = scene.sightings;
  FarPoints points;
  points.weigh(scene.world.map, scene.predicted, {7}, {}, kept);
  for (const Sighting& s : kept)
    EXPECT_EQ(std::count(scene.outliers.begin(), scene.outliers.end(), s.landmark), 0);
  const auto good = far_count(scene, scene.sightings) - static_cast<std::ptrdiff_t>(scene.outliers.size());
  EXPECT_GT(scene.outliers.size(), 15U);
  EXPECT_GE(static_cast<double>(far_count(scene, kept)), 0.95 * static_cast<double>(good));
}

TEST(FarPoints, NearOnesAreNotTouched) {
  const Scene scene = make_scene(0.3);
  std::vector<Sighting> kept = scene.sightings;
  FarPoints points;
  points.weigh(scene.world.map, scene.predicted, {7}, {}, kept);
  std::size_t near = 0;
  for (const Sighting& s : kept) {
    if (is_far(scene, s)) continue;
    ++near;
    EXPECT_EQ(s.weight, 1);
  }
  EXPECT_EQ(static_cast<std::ptrdiff_t>(near),
            static_cast<std::ptrdiff_t>(scene.sightings.size()) - far_count(scene, scene.sightings));
}

TEST(FarPoints, TheWeightIsTheFrequencyOfInliers) {
  FarPoints points;
  const Scene bad = make_scene(0.6), good = make_scene(0);
  const FarOptions options;
  std::vector<Sighting> kept;
  std::int64_t frame = 0;
  for (int i = 0; i < options.memory; ++i)
    points.weigh(good.world.map, good.predicted, {frame++}, options, kept = good.sightings);
  EXPECT_GT(points.weight(), 0.97);
  for (int i = 0; i < options.memory; ++i) {
    const double before = points.weight();
    points.weigh(bad.world.map, bad.predicted, {frame++}, options, kept = bad.sightings);
    EXPECT_LT(points.weight(), before);
  }
  const double share =
      1 - static_cast<double>(bad.outliers.size()) / static_cast<double>(far_count(bad, bad.sightings));
  EXPECT_NEAR(points.weight(), share, 0.05);
  for (const Sighting& s : kept) EXPECT_EQ(s.weight, is_far(bad, s) ? points.weight() : 1);
  for (int i = 0; i < options.memory; ++i)
    points.weigh(good.world.map, good.predicted, {frame++}, options, kept = good.sightings);
  EXPECT_GT(points.weight(), 0.97);
}

TEST(FarPoints, SameDrawEachTime) {
  const Scene scene = make_scene(0.5);
  std::vector<Sighting> first = scene.sightings, second = scene.sightings;
  FarPoints a, b;
  a.weigh(scene.world.map, scene.predicted, {3}, {}, first);
  b.weigh(scene.world.map, scene.predicted, {3}, {}, second);
  EXPECT_EQ(a.weight(), b.weight());
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].landmark, second[i].landmark);
}

TEST(FarPoints, SwitchedOffNothingChanges) {
  const Scene scene = make_scene(0.5);
  std::vector<Sighting> kept = scene.sightings;
  FarPoints points;
  FarOptions off;
  off.enabled = false;
  points.weigh(scene.world.map, scene.predicted, {3}, off, kept);
  EXPECT_EQ(kept.size(), scene.sightings.size());
  EXPECT_EQ(points.weight(), 1);
}

TEST(FarPoints, NoneOrTwoOfThemAreLeftAlone) {
  Scene scene = make_scene(0);
  int far = 0;
  std::erase_if(scene.sightings, [&](const Sighting& s) { return is_far(scene, s) && ++far > 2; });
  std::vector<Sighting> kept = scene.sightings, none;
  FarPoints points;
  points.weigh(scene.world.map, scene.predicted, {3}, {}, kept);
  EXPECT_EQ(kept.size(), scene.sightings.size());
  points.weigh(scene.world.map, scene.predicted, {4}, {}, none);
  EXPECT_TRUE(none.empty());
}

TEST(FarPoints, TheWeightNeverFallsBelowItsFloor) {
  FarPoints points;
  FarOptions options;
  options.min_weight = 0.25;
  Scene scene = make_scene(1);
  for (int i = 0; i < 12; ++i) {
    std::vector<Sighting> kept = scene.sightings;
    points.weigh(scene.world.map, scene.predicted, {i}, options, kept);
  }
  EXPECT_EQ(points.weight(), 0.25);
}

}  // namespace
}  // namespace spslam
