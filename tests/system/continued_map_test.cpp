// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// A map that outlives its run, and a camera that is lost and found in it.

#include <gmock/gmock.h>

#include "system/scene_run.h"

namespace spslam {
namespace {

using namespace test;

TEST(ContinuedMap, FramesAreFoundAndTrackedInTheWorldOfTheMap) {
  Slam slam(scene_rig(), sequential_options(), saved_and_loaded());
  const std::size_t known = slam.keyframes().size();
  ASSERT_GT(known, 0U);
  double time = 100;
  for (int i = 6; i < kSceneFrames; ++i) {
    const TrackResult result = slam.track(at_time(scene_pairs()[static_cast<std::size_t>(i)], time += 0.1));
    ASSERT_EQ(result.status, TrackStatus::kTracking) << i << ": " << result.reason;
    EXPECT_EQ(result.reason, i == 6 ? "found in the map" : "");
    EXPECT_LT(distance_from_truth(result.world_from_camera, i), 0.05) << i;
  }
  slam.finish();
  EXPECT_GT(slam.keyframes().size(), known);
}

// A wrong pose would be worse than none.
TEST(ContinuedMap, AnotherPlaceIsNotTakenForThisOne) {
  Slam slam(scene_rig(), sequential_options(), saved_and_loaded());
  double time = 100;
  for (const StereoFrame& pair : scene_pairs()) {
    const TrackResult result = slam.track(mirrored(pair, time += 0.1));
    EXPECT_EQ(result.status, TrackStatus::kInitializing);
    EXPECT_EQ(result.reason, "not recognized in the map");
  }
}

TEST(Relocalization, ALostCameraIsFoundWhereItIsAndNotWhereItsVelocityLed) {
  Slam slam(scene_rig(), sequential_options());
  double time = 0;
  for (const StereoFrame& pair : scene_pairs()) slam.track(at_time(pair, time += 0.1));
  StereoFrame black;
  black.problem = "black";
  TrackResult result;
  for (int i = 0; i < 30; ++i) result = slam.track(at_time(black, time += 0.1));
  ASSERT_EQ(result.status, TrackStatus::kLost);
  constexpr int kPlace = 5;
  for (int tries = 0; tries < 10 && result.status == TrackStatus::kLost; ++tries)
    result = slam.track(at_time(scene_pairs()[kPlace], time += 0.1));
  EXPECT_EQ(result.status, TrackStatus::kTracking);
  EXPECT_EQ(result.reason, "found in the map");
  EXPECT_LT(distance_from_truth(result.world_from_camera, kPlace), 0.05);
}

// Frames that could not be seen lie between the last one before and the first one after.
TEST(Relocalization, FramesOfTheGapAreCorrectedOnceItIsClosed) {
  Slam slam(scene_rig(), sequential_options());
  std::vector<StereoFrame> pairs = scene_pairs();
  StereoFrame black;
  black.problem = "black";
  double time = 0;
  for (const StereoFrame& pair : pairs) slam.track(at_time(pair, time += 0.1));
  // Forward at the last velocity, says dead reckoning; but the boat is where it was six frames ago.
  constexpr int kGap = 30, kBack = kSceneFrames - 7;
  for (int i = 0; i < kGap; ++i) slam.track(at_time(black, time += 0.1));
  for (int i = 0; i < 4; ++i) slam.track(at_time(pairs[static_cast<std::size_t>(kBack + i)], time += 0.1));
  slam.finish();
  const std::vector<TrajectoryPose> trajectory = slam.trajectory();
  ASSERT_EQ(trajectory.size(), static_cast<std::size_t>(kSceneFrames + kGap + 4));
  const Eigen::Vector3d from = scene_pose(kSceneFrames - 1).translation, to = scene_pose(kBack).translation;
  const double way = (to - from).norm();
  for (int i = 0; i < kGap; ++i) {
    const TrajectoryPose& pose = trajectory[static_cast<std::size_t>(kSceneFrames + i)];
    EXPECT_NE(pose.status, TrackStatus::kTracking);
    const Eigen::Vector3d at = pose.world_from_camera.translation;
    EXPECT_LT((at - from).norm() + (at - to).norm(), 3 * way + 0.1) << i;
  }
  EXPECT_LT((trajectory[kSceneFrames + kGap - 1].world_from_camera.translation - to).norm(), 0.1);
}

TEST(Relocalization, WithoutAnyKnownPlaceTrackingBeginsAnew) {
  SlamOptions options = sequential_options();
  options.tracker.state.relocalization_frames = 2;
  Slam slam(scene_rig(), options);
  double time = 0;
  for (const StereoFrame& pair : scene_pairs()) slam.track(at_time(pair, time += 0.1));
  StereoFrame black;
  black.problem = "black";
  TrackResult result;
  for (int i = 0; i < 30; ++i) result = slam.track(at_time(black, time += 0.1));
  for (int i = 0; i < 2; ++i) {
    result = slam.track(mirrored(scene_pairs()[0], time += 0.1));
    EXPECT_EQ(result.status, TrackStatus::kLost);
  }
  result = slam.track(mirrored(scene_pairs()[0], time += 0.1));
  EXPECT_EQ(result.status, TrackStatus::kTracking);
  EXPECT_THAT(result.reason, testing::HasSubstr("begun anew"));
}

// What was mapped after the loss is in the wrong place until a loop joins it to the map from before, however
// far that is from where dead reckoning put it.
TEST(Relocalization, ASubmapIsJoinedByALoop) {
  SlamOptions options = sequential_options();
  options.tracker.state.relocalization_frames = 0;
  options.tracker.keyframe.max_frames = 2;
  options.loop.detection.max_drift = options.loop.detection.max_drift_floor = 0.001;
  Slam slam(scene_rig(), options);
  double time = 0;
  for (const StereoFrame& pair : scene_pairs()) slam.track(at_time(pair, time += 0.1));
  StereoFrame black;
  black.problem = "black";
  for (int i = 0; i < 30; ++i) slam.track(at_time(black, time += 0.1));
  TrackResult result;
  std::vector<int> shown;
  for (int i = 0; i < 2 * kSceneFrames; ++i) {
    shown.push_back(i < kSceneFrames ? i : 2 * kSceneFrames - 1 - i);
    result = slam.track(at_time(scene_pairs()[static_cast<std::size_t>(shown.back())], time += 0.1));
    if (i == 0) {
      EXPECT_THAT(result.reason, testing::HasSubstr("begun anew"));
      EXPECT_GT(distance_from_truth(result.world_from_camera, 0), 0.5) << "too near for this test";
    }
  }
  slam.finish();
  int closed = 0;
  for (const LoopAttempt& attempt : slam.loops()) closed += attempt.closure.has_value();
  EXPECT_GT(closed, 0);
  const std::vector<TrajectoryPose> trajectory = slam.trajectory();
  ASSERT_GE(trajectory.size(), shown.size());
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const SE3& pose = trajectory[trajectory.size() - shown.size() + i].world_from_camera;
    EXPECT_LT((pose.translation - scene_pose(shown[i]).translation).norm(), 0.1) << i;
  }
}

}  // namespace
}  // namespace spslam
