// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/odometry/trial.h"

#include <gtest/gtest.h>

#include "odometry/synthetic_map.h"
#include "spslam/odometry/frame_problem.h"

namespace spslam {
namespace {

constexpr int kMaxMissed = 2;

bool is_low(const StereoRig& rig, const Landmark& landmark) {
  return landmark.pixel.y() > 0.5F * static_cast<float>(rig.height);
}

// A world whose landmarks in the lower half of the host's image move as no standing point does, as on water.
test::SyntheticMap wavy_world(double wave) {
  SyntheticOptions options;
  options.cameras = 5, options.points = 600, options.noise = false;
  test::SyntheticMap world = test::make_synthetic_map(options);
  for (std::size_t camera = 1; camera < world.sightings.size(); ++camera)
    for (Sighting& s : world.sightings[camera])
      if (is_low(world.map.rig, world.map.landmarks[world.map.index_of(s.landmark)].landmark))
        s.measured.x() += wave * (camera % 2 == 0 ? 1 : -1);
  return world;
}

// Frame by frame, as the tracker does.
void judge_all(test::SyntheticMap& world, Trials& trials) {
  test::SyntheticMap whole = world;
  test::fill_window(whole);
  for (const WindowFrame& frame : whole.map.window) {
    world.map.window.push_back(frame);
    trials.judge(world.map, kMaxMissed);
  }
}

int count(const ActiveMap& map, Verdict verdict, bool low) {
  return static_cast<int>(std::count_if(map.landmarks.begin(), map.landmarks.end(), [&](const auto& active) {
    return active.verdict == verdict && is_low(map.rig, active.landmark) == low;
  }));
}

TEST(Trials, BeginWithTrust) {
  const StereoRig rig = wavy_world(0).map.rig;
  const Trials trials({});
  EXPECT_FALSE(trials.needed_at(rig, {5, 5}));
  EXPECT_FALSE(trials.needed_at(rig, {static_cast<float>(rig.width), static_cast<float>(rig.height)}));
  EXPECT_FALSE(trials.needed_at(rig, {-3, -3}));
}

TEST(Trials, StandingPointsAreProvenAndTheirPlacesTrusted) {
  test::SyntheticMap world = wavy_world(0);
  Trials trials({});
  judge_all(world, trials);
  EXPECT_GT(count(world.map, Verdict::kProven, false), 100);
  EXPECT_GT(count(world.map, Verdict::kProven, true), 100);
  EXPECT_EQ(count(world.map, Verdict::kRefuted, false) + count(world.map, Verdict::kRefuted, true), 0);
  for (const ActiveLandmark& active : world.map.landmarks)
    EXPECT_FALSE(trials.needed_at(world.map.rig, active.landmark.pixel));
}

TEST(Trials, WhereFewProveRightNewLandmarksAreOnTrial) {
  test::SyntheticMap world = wavy_world(8);
  Trials trials({});
  judge_all(world, trials);
  EXPECT_GT(count(world.map, Verdict::kRefuted, true), 100);
  EXPECT_EQ(count(world.map, Verdict::kProven, true), 0);
  EXPECT_EQ(count(world.map, Verdict::kRefuted, false), 0);
  const auto width = static_cast<float>(world.map.rig.width),
             height = static_cast<float>(world.map.rig.height);
  EXPECT_TRUE(trials.needed_at(world.map.rig, {0.45F * width, 0.75F * height}));
  EXPECT_FALSE(trials.needed_at(world.map.rig, {0.45F * width, 0.25F * height}));
  // Nobody who was not on trial is let go for it.
  for (const ActiveLandmark& active : world.map.landmarks) EXPECT_LE(active.missed, kMaxMissed);
}

TEST(Trials, EndWithBeingTrustedOrLetGo) {
  Trials trials({});
  test::SyntheticMap first = wavy_world(8);
  judge_all(first, trials);
  test::SyntheticMap world = wavy_world(8);
  world.map.window.push_back(first.map.window.front());
  trials.judge(world.map, kMaxMissed);
  const auto on_trial = [&](bool low) {
    return std::count_if(world.map.landmarks.begin(), world.map.landmarks.end(), [&](const auto& active) {
      return active.on_trial && is_low(world.map.rig, active.landmark) == low;
    });
  };
  EXPECT_GT(on_trial(true), 100);
  EXPECT_EQ(on_trial(false), 0);
  world.map.window.clear();
  judge_all(world, trials);
  for (const ActiveLandmark& active : world.map.landmarks) {
    EXPECT_FALSE(active.on_trial && active.verdict == Verdict::kProven);
    EXPECT_EQ(active.missed > kMaxMissed, active.on_trial && active.verdict == Verdict::kRefuted);
  }
}

// Where tracking begins nothing is known: those that are still open when the first have failed are on trial.
TEST(Trials, GoOnForThoseMadeBeforeThePlaceWasKnown) {
  Trials trials({});
  test::SyntheticMap world = wavy_world(8);
  for (std::size_t camera = 1; camera < world.sightings.size(); ++camera)  // half of them are seen once only
    std::erase_if(world.sightings[camera],
                  [&](const Sighting& s) { return camera != 1 && s.landmark.value % 2 == 0; });
  judge_all(world, trials);
  int open_on_trial = 0;
  for (const ActiveLandmark& active : world.map.landmarks) {
    const bool is_open = active.verdict == Verdict::kOpen;
    EXPECT_EQ(active.on_trial && is_open, is_open && trials.needed_at(world.map.rig, active.landmark.pixel));
    open_on_trial += is_open && active.on_trial;
  }
  EXPECT_GT(open_on_trial, 20);
}

TEST(Trials, OneThatIsLostInSightIsRefutedOneThatLeftTheImageIsNot) {
  test::SyntheticMap world = wavy_world(0);
  test::fill_window(world);
  ActiveMap& map = world.map;
  while (map.window.size() > 2) map.window.pop_back();
  map.window.back().sightings.clear();
  for (ActiveLandmark& active : map.landmarks) active.missed = kMaxMissed + 1;
  map.landmarks[0].landmark.bearing = map.rig.bearing(-500, 100);
  map.landmarks[0].landmark.inverse_depth = 0;
  map.landmarks[1].landmark.bearing = map.rig.bearing(map.rig.cx, map.rig.cy);
  map.landmarks[1].landmark.inverse_depth = 0;
  Trials trials({});
  trials.judge(map, kMaxMissed);
  EXPECT_EQ(map.landmarks[0].verdict, Verdict::kOpen);
  EXPECT_EQ(map.landmarks[1].verdict, Verdict::kRefuted);
}

TEST(Trials, ArePossibleToSwitchOff) {
  test::SyntheticMap world = wavy_world(8);
  TrialOptions options;
  options.enabled = false;
  Trials trials(options);
  judge_all(world, trials);
  for (const ActiveLandmark& active : world.map.landmarks) {
    EXPECT_EQ(active.verdict, Verdict::kOpen);
    EXPECT_FALSE(trials.needed_at(world.map.rig, active.landmark.pixel));
  }
}

double position_error(const test::SyntheticMap& world) {
  const MotionEstimate estimate = estimate_motion(
      world.map, world.sightings.back(), world.truth.poses.back().camera_from_world, SolverOptions{});
  EXPECT_TRUE(estimate.solved);
  return (estimate.camera_from_world.inverse().translation -
          world.truth.poses.back().camera_from_world.inverse().translation)
      .norm();
}

// All that are wrong, wrong alike: the robust loss alone cannot tell which side is right.
test::SyntheticMap drifting_world(int points) {
  SyntheticOptions options;
  options.cameras = 2, options.points = points, options.noise = false;
  test::SyntheticMap world = test::make_synthetic_map(options);
  for (ActiveLandmark& active : world.map.landmarks) active.landmark.information = 1e6;
  for (Sighting& s : world.sightings.back())
    if (is_low(world.map.rig, world.map.landmarks[world.map.index_of(s.landmark)].landmark))
      s.measured.x() += 2;
  return world;
}

TEST(Trials, LandmarksOnTrialDoNotMoveTheCamera) {
  test::SyntheticMap world = drifting_world(300);
  const double misled = position_error(world);
  for (ActiveLandmark& active : world.map.landmarks) active.on_trial = is_low(world.map.rig, active.landmark);
  EXPECT_GT(misled, 1e-3);
  EXPECT_LT(position_error(world), 1e-6);
}

TEST(Trials, AllLandmarksCountWhereNearlyAllAreOnTrial) {
  test::SyntheticMap world = drifting_world(60);
  const double misled = position_error(world);
  for (ActiveLandmark& active : world.map.landmarks) active.on_trial = is_low(world.map.rig, active.landmark);
  EXPECT_EQ(position_error(world), misled);
}

// Found out otherwise, as by movers.h: even a proven one is let go, and its place is trusted less.
TEST(Trials, RefutesWhatItIsTold) {
  test::SyntheticMap world = wavy_world(0);
  Trials trials({});
  judge_all(world, trials);
  const Eigen::Vector2f place = world.map.landmarks.front().landmark.pixel;
  for (int i = 0; i < 30; ++i) {
    ActiveLandmark active = world.map.landmarks.front();
    trials.refute(world.map.rig, kMaxMissed, active);
    EXPECT_EQ(active.verdict, Verdict::kRefuted);
    EXPECT_TRUE(active.on_trial);
    EXPECT_GT(active.missed, kMaxMissed);
  }
  EXPECT_TRUE(trials.needed_at(world.map.rig, place));
}

}  // namespace
}  // namespace spslam
