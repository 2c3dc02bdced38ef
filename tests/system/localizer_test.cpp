// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Localization in a map that stays as it is.

#include <gmock/gmock.h>

#include "spslam/system/localizer.h"
#include "spslam/system/map_encoding.h"
#include "spslam/system/stages.h"
#include "system/scene_run.h"

namespace spslam {
namespace {

using namespace test;
using testing::HasSubstr;

const Map& known_map() {
  static const Map map = saved_and_loaded();
  return map;
}

SlamOptions localizing(Threads threads = Threads::kSequential) {
  SlamOptions options = sequential_options();
  options.threads = threads;
  options.localization.enabled = true;
  options.localization.interval = 2;
  return options;
}

TEST(Localizer, SaysWhereInTheMapTheCameraIs) {
  Slam slam(scene_rig(), localizing(), known_map());
  constexpr int kFirst = 5;
  bool found = false;
  for (int i = kFirst; i < kSceneFrames; ++i) {
    const TrackResult result = slam.track(at_time(scene_pairs()[static_cast<std::size_t>(i)], 100 + 0.1 * i));
    if (result.status != TrackStatus::kTracking) {
      EXPECT_FALSE(found) << i;
      EXPECT_GT(result.covariance(0, 0), 1e3);
      EXPECT_EQ(result.reason, "not recognized in the map");
      continue;
    }
    found = true;
    EXPECT_LT(distance_from_truth(result.world_from_camera, i), 0.05) << i;
    EXPECT_LT(std::sqrt(result.covariance.topLeftCorner<3, 3>().trace()), 0.3);
  }
  slam.finish();
  EXPECT_TRUE(found);
  // The frames before it was found are placed too, backwards.
  const std::vector<TrajectoryPose> trajectory = slam.trajectory();
  ASSERT_EQ(trajectory.size(), static_cast<std::size_t>(kSceneFrames - kFirst));
  for (const TrajectoryPose& pose : trajectory)
    EXPECT_LT(distance_from_truth(pose.world_from_camera, kFirst + static_cast<int>(pose.frame.value)), 0.05);
}

TEST(Localizer, TheMapStaysAsItIs) {
  Slam slam(scene_rig(), localizing(), known_map());
  for (int i = 5; i < kSceneFrames; ++i)
    slam.track(at_time(scene_pairs()[static_cast<std::size_t>(i)], 100 + 0.1 * i));
  slam.finish();
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "after.map";
  slam.save(path);
  const Map after = load_map(path).map;
  EXPECT_EQ(encode_map(after, scene_rig()), encode_map(known_map(), scene_rig()));
}

// A wrong pose would be worse than none.
TEST(Localizer, AnotherPlaceIsLost) {
  Slam slam(scene_rig(), localizing(), known_map());
  for (int i = 0; i < kSceneFrames; ++i) {
    const TrackResult result =
        slam.track(mirrored(scene_pairs()[static_cast<std::size_t>(i)], 100 + 0.1 * i));
    EXPECT_NE(result.status, TrackStatus::kTracking);
    if (result.status == TrackStatus::kLost) {
      EXPECT_GT(result.covariance(0, 0), 1e3);
    }
  }
  slam.finish();
  EXPECT_TRUE(slam.trajectory().empty());
}

TEST(Localizer, IsFoundAgainAfterALoss) {
  Slam slam(scene_rig(), localizing(), known_map());
  double time = 100;
  for (int i = 0; i < kSceneFrames; ++i)
    slam.track(at_time(scene_pairs()[static_cast<std::size_t>(i)], time += 0.1));
  StereoFrame black;
  black.problem = "black";
  TrackResult result;
  for (int i = 0; i < 30; ++i) result = slam.track(at_time(black, time += 0.1));
  ASSERT_EQ(result.status, TrackStatus::kLost);
  // Somewhere else than where its velocity led.
  int tries = 0;
  for (; tries < 10 && result.status != TrackStatus::kTracking; ++tries)
    result = slam.track(at_time(scene_pairs()[static_cast<std::size_t>(2 + tries)], time += 0.1));
  EXPECT_EQ(result.status, TrackStatus::kTracking) << result.reason;
  EXPECT_LT(distance_from_truth(result.world_from_camera, 1 + tries), 0.05);
  slam.finish();
  // Both passages, each smoothed by itself; nothing of the time between.
  const std::vector<TrajectoryPose> trajectory = slam.trajectory();
  const auto later = std::find_if(trajectory.begin(), trajectory.end(), [](const TrajectoryPose& pose) {
    return pose.frame.value >= kSceneFrames + 30;
  });
  ASSERT_NE(later, trajectory.end());
  EXPECT_EQ(later->frame.value, kSceneFrames + 30);
  for (auto pose = trajectory.begin(); pose != later; ++pose)
    if (pose->frame.value < kSceneFrames) {
      EXPECT_LT(distance_from_truth(pose->world_from_camera, static_cast<int>(pose->frame.value)), 0.05);
    }
  for (auto pose = later; pose != trajectory.end(); ++pose)
    EXPECT_LT(distance_from_truth(pose->world_from_camera,
                                  2 + static_cast<int>(pose->frame.value) - kSceneFrames - 30),
              0.05);
}

// However late the other thread answers, what it says counts: one answer places every frame.
TEST(Localizer, AnswersThatComeAfterTheLastFrameCount) {
  SlamOptions options = localizing(Threads::kParallel);
  options.localization.confirmations = 1;
  Slam slam(scene_rig(), options, known_map());
  for (int i = 0; i < kSceneFrames; ++i)
    slam.track(at_time(scene_pairs()[static_cast<std::size_t>(i)], 100 + 0.1 * i));
  slam.finish();
  const std::vector<TrajectoryPose> trajectory = slam.trajectory();
  ASSERT_EQ(trajectory.size(), static_cast<std::size_t>(kSceneFrames));
  for (const TrajectoryPose& pose : trajectory)
    EXPECT_LT(distance_from_truth(pose.world_from_camera, static_cast<int>(pose.frame.value)), 0.1);
}

TEST(Localizer, ThreadsFindItToo) {
  Slam slam(scene_rig(), localizing(Threads::kParallel), known_map());
  double time = 100;
  TrackResult result;
  // Forth and back until the other thread has answered often enough.
  for (int i = 0; i < 40 * kSceneFrames && result.status != TrackStatus::kTracking; ++i) {
    const int round = i % (2 * kSceneFrames - 2);
    const int frame = round < kSceneFrames ? round : 2 * kSceneFrames - 2 - round;
    result = slam.track(at_time(scene_pairs()[static_cast<std::size_t>(frame)], time += 0.1));
    if (result.status == TrackStatus::kTracking) {
      EXPECT_LT(distance_from_truth(result.world_from_camera, frame), 0.1);
    }
  }
  slam.finish();
  EXPECT_EQ(result.status, TrackStatus::kTracking);
}

// Where the first frame is put by a place that is recognized in the last one alone, while odometry's steps
// are half as long again as they are.
double error_of_first(const std::vector<TrajectoryPose>& session) {
  SlamOptions options = localizing();
  options.localization.interval = options.localization.confirmations = 1;
  Localizer localizer(scene_rig(), options, known_map(), built_in_vocabulary());
  Stages odometry(scene_rig(), options, Map{}, built_in_vocabulary());
  for (const StereoFrame& pair : scene_pairs()) {
    TrackerOutput output = odometry.track(pair);
    output.result.world_from_camera.translation *= 1.5;
    if (&pair != &scene_pairs().back()) output.seen.reset();
    localizer.place(output);
  }
  localizer.finish(session);
  const std::vector<TrajectoryPose> trajectory = localizer.trajectory();
  EXPECT_EQ(trajectory.size(), scene_pairs().size());
  return trajectory.empty() ? NAN : distance_from_truth(trajectory.front().world_from_camera, 0);
}

TEST(Localizer, WhatMappingCorrectsOfOdometryInTheEndCounts) {
  std::vector<TrajectoryPose> corrected;
  for (int i = 0; i < kSceneFrames; ++i)
    corrected.push_back({FrameId{i}, scene_pairs()[static_cast<std::size_t>(i)].timestamp,
                         TrackStatus::kTracking, scene_pose(i)});
  const double way = distance_from_truth(scene_pose(kSceneFrames - 1), 0);
  EXPECT_GT(error_of_first({}), 0.4 * way);
  EXPECT_LT(error_of_first(corrected), 0.05);
}

TEST(Localizer, NeedsAMap) {
  EXPECT_THROW(Slam(scene_rig(), localizing(), Map{}), OptionError);
}

}  // namespace
}  // namespace spslam
