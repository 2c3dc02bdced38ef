// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/odometry/movers.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "odometry/synthetic_map.h"

namespace spslam {
namespace {

constexpr double kPeriod = 0.1;  // s, of test::fill_window

bool is_on_boat(const StereoRig& rig, const Landmark& landmark) {
  return landmark.pixel.x() < 0.4F * static_cast<float>(rig.width) && landmark.inverse_depth > 1.0 / 8;
}

// A second of a camera that passes noisy points; those of a boat move with that velocity (m/s, world axes).
test::SyntheticMap world_with_boat(const Eigen::Vector3d& velocity, std::uint64_t seed = 1) {
  SyntheticOptions options;
  options.cameras = 10, options.points = 1500, options.step = 0.1, options.turn = 0.002, options.nearest = 4;
  options.seed = seed;
  test::SyntheticMap world = test::make_synthetic_map(options);
  const ActiveMap& map = world.map;
  for (std::size_t camera = 0; camera < world.sightings.size(); ++camera) {
    const SE3& pose = world.truth.poses[camera].camera_from_world;
    for (Sighting& s : world.sightings[camera]) {
      const Landmark& landmark = map.landmarks[map.index_of(s.landmark)].landmark;
      if (!is_on_boat(map.rig, landmark)) continue;
      const SE3 motion = pose * map.hosts.at(landmark.host).camera_from_world.inverse();
      SE3 moved = motion;
      moved.translation += pose.rotation * velocity * kPeriod * static_cast<double>(camera);
      const auto seen = [&](const SE3& from) {
        return linearize(map.rig, from, landmark.bearing, landmark.inverse_depth, Eigen::Vector3d::Zero())
            .residual;
      };
      s.measured += seen(moved) - seen(motion);
    }
  }
  test::fill_window(world);
  return world;
}

struct Shares {
  double boat = 0, rest = 0;
};

Shares found(const test::SyntheticMap& world, const MoverOptions& options) {
  Shares found, all;
  const std::vector<int> movers = find_movers(world.map, options);
  for (std::size_t i = 0; i < world.map.landmarks.size(); ++i) {
    if (!gain_of_moving(world.map, world.map.landmarks[i].landmark.id, options)) continue;
    const bool boat = is_on_boat(world.map.rig, world.map.landmarks[i].landmark);
    (boat ? all.boat : all.rest) += 1;
    if (std::binary_search(movers.begin(), movers.end(), static_cast<int>(i)))
      (boat ? found.boat : found.rest) += 1;
  }
  EXPECT_GT(all.boat, 50);
  EXPECT_GT(all.rest, 300);
  return {found.boat / all.boat, found.rest / all.rest};
}

TEST(Movers, WhatStandsStillGainsAsMuchAsChanceGives) {
  const test::SyntheticMap world = world_with_boat({0, 0, 0});
  MoverOptions options;
  options.warp = 0;
  double sum = 0, count = 0;
  for (const ActiveLandmark& active : world.map.landmarks)
    if (const auto gain = gain_of_moving(world.map, active.landmark.id, options)) sum += *gain, ++count;
  ASSERT_GT(count, 500);
  // Chi-square of three degrees of freedom, or two where there is no disparity to change; tracks that look
  // noisier than they are take off some, none looks quieter.
  EXPECT_GT(sum / count, 1.6);
  EXPECT_LT(sum / count, 3.2);
  EXPECT_LT(found(world, options).rest, 0.01);
}

TEST(Movers, ABoatIsFoundWhereverItGoes) {
  for (const Eigen::Vector3d& velocity :
       {Eigen::Vector3d(1.5, 0, 0), Eigen::Vector3d(-1, 0, 0), Eigen::Vector3d(0.3, 0, 2)}) {
    const Shares shares = found(world_with_boat(velocity), {});
    EXPECT_GT(shares.boat, 0.8) << velocity.transpose();
    EXPECT_LT(shares.rest, 0.01) << velocity.transpose();
  }
}

TEST(Movers, TheRigsOffsetIsNotTakenForMotion) {
  SyntheticOptions options;
  options.cameras = 10, options.points = 300, options.noise = false;
  options.offset.x() = 0.8;
  test::SyntheticMap world = test::make_synthetic_map(options);
  world.map.disparity_offset.coefficients = options.offset;
  test::fill_window(world);
  int tested = 0;
  for (const ActiveLandmark& active : world.map.landmarks) {
    const auto gain = gain_of_moving(world.map, active.landmark.id, {});
    if (!gain) continue;
    EXPECT_LT(*gain, 1e-3);
    ++tested;
  }
  EXPECT_GT(tested, 100);
}

TEST(Movers, NothingIsSaidWithoutEvidence) {
  test::SyntheticMap world = world_with_boat({0, 0, 0});
  const LandmarkId id = world.map.window.back().sightings.front().landmark;
  const auto sighting_in = [&](WindowFrame& frame) {
    return std::find_if(frame.sightings.begin(), frame.sightings.end(),
                        [&](const Sighting& s) { return s.landmark == id; });
  };
  ASSERT_TRUE(gain_of_moving(world.map, id, {}));
  MoverOptions demanding;
  demanding.min_sightings = 11;
  EXPECT_FALSE(gain_of_moving(world.map, id, demanding));
  test::SyntheticMap without = world;
  for (WindowFrame& frame : without.map.window) sighting_in(frame)->inverse_sigma.z() = 0;
  EXPECT_FALSE(gain_of_moving(without.map, id, {}));
  WindowFrame& newest = world.map.window.back();
  newest.sightings.erase(sighting_in(newest));
  EXPECT_FALSE(gain_of_moving(world.map, id, {}));
  EXPECT_FALSE(gain_of_moving(ActiveMap{world.map.rig, {}, {}, {}, {}}, id, {}));
}

// A patch that came nearer is not where its noise says: the farther parallax has moved it, the less a
// deviation means.
TEST(Movers, WarpingPatchesAreForgiven) {
  const test::SyntheticMap world = world_with_boat({1.5, 0, 0});
  MoverOptions exact, lenient;
  exact.warp = 0, lenient.warp = 0.1;
  EXPECT_GT(found(world, exact).boat, found(world, lenient).boat + 0.1);
  int far = 0;
  for (const ActiveLandmark& active : world.map.landmarks) {
    const auto strict = gain_of_moving(world.map, active.landmark.id, exact);
    if (!strict || active.landmark.inverse_depth != 0) continue;
    ++far;  // without parallax there is little but noise to forgive
    EXPECT_NEAR(*gain_of_moving(world.map, active.landmark.id, lenient), *strict, 0.2 * *strict + 0.1);
  }
  EXPECT_GT(far, 100);
}

}  // namespace
}  // namespace spslam
