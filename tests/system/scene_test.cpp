// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Whole runs on rendered pairs: near the truth, the same bits each time, no state shared between two systems.

#include <gmock/gmock.h>

#include "system/scene_run.h"

namespace spslam {
namespace {

using namespace test;
using testing::Each;

struct PresetLimit {
  Preset preset;
  double ate;  // m, over a way of 1.5 m
};

void PrintTo(const PresetLimit& row, std::ostream* out) {
  *out << option_names(row.preset)[static_cast<int>(row.preset)];
}

class Accuracy : public testing::TestWithParam<PresetLimit> {};

TEST_P(Accuracy, IsNearTheTruth) {
  const SceneRun run = run_pairs(scene_pairs(), sequential_options(GetParam().preset));
  EXPECT_THAT(statuses(run), Each(TrackStatus::kTracking));
  ASSERT_EQ(run.trajectory.size(), scene_pairs().size());
  const Evaluation evaluation = evaluate_scene(run.trajectory);
  EXPECT_LT(evaluation.ate.position.rmse, GetParam().ate);
  EXPECT_NEAR(evaluation.scale_ratio, 1, 2 * GetParam().ate);
  for (const TrackResult& result : run.results) {
    EXPECT_TRUE(result.covariance.allFinite() && result.covariance.llt().info() == Eigen::Success);
    EXPECT_TRUE(result.world_from_camera.is_finite() && std::isfinite(result.entropy));
  }
}

INSTANTIATE_TEST_SUITE_P(System, Accuracy,
                         testing::Values(PresetLimit{Preset::kSpSlam, 0.01},
                                         PresetLimit{Preset::kPaper, 0.05},
                                         PresetLimit{Preset::kBaseline, 0.05}),
                         [](const testing::TestParamInfo<PresetLimit>& row) {
                           std::string name =
                               option_names(row.param.preset)[static_cast<int>(row.param.preset)];
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(System, ParallelStagesAreNearTheTruthToo) {
  SlamOptions options;
  options.threads = Threads::kParallel;
  const SceneRun run = run_pairs(scene_pairs(), options);
  ASSERT_EQ(run.trajectory.size(), scene_pairs().size());
  EXPECT_LT(evaluate_scene(run.trajectory).ate.position.rmse, 0.01);
}

// A gradual, not an exact, agreement would hide a race.
void expect_same_bits(const Trajectory& a, const Trajectory& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].world_from_camera.translation, b[i].world_from_camera.translation) << i;
    EXPECT_EQ(a[i].world_from_camera.rotation, b[i].world_from_camera.rotation) << i;
  }
}

TEST(System, SameBitsOnEveryRun) {
  const SlamOptions options = sequential_options();
  const SceneRun first = run_pairs(scene_pairs(), options);
  ASSERT_FALSE(first.trajectory.empty());
  expect_same_bits(first.trajectory, run_pairs(scene_pairs(), options).trajectory);
}

// Then a machine's load does not count, as with one thread.
TEST(System, ParallelStagesThatWaitForTheMapGiveTheBitsOfSequentialOnes) {
  SlamOptions options;
  options.loop.enabled = false;  // the loop closer is not waited for
  options.threads = Threads::kParallel;
  Slam slam(scene_rig(), options);
  for (const StereoFrame& pair : scene_pairs()) {
    slam.wait_for_map();
    slam.track(pair);
  }
  slam.finish();
  options.threads = Threads::kSequential;
  expect_same_bits(poses_of(slam), run_pairs(scene_pairs(), options).trajectory);
}

TEST(System, TwoInOneProcessShareNothing) {
  const SceneRun alone = run_pairs(scene_pairs(), sequential_options());
  const SceneRun other_alone = run_pairs(scene_pairs(), sequential_options(Preset::kBaseline));
  Slam one(scene_rig(), sequential_options()), two(scene_rig(), sequential_options(Preset::kBaseline));
  for (const StereoFrame& pair : scene_pairs()) {
    one.track(pair);
    two.track(pair);
  }
  one.finish();
  two.finish();
  expect_same_bits(poses_of(one), alone.trajectory);
  expect_same_bits(poses_of(two), other_alone.trajectory);
}

TEST(System, KeyframesAndLandmarksAreListed) {
  Slam slam(scene_rig(), sequential_options());
  for (const StereoFrame& pair : scene_pairs()) slam.track(pair);
  slam.finish();
  ASSERT_FALSE(slam.keyframes().empty());
  EXPECT_EQ(slam.keyframes().front().frame.value, 0);
  EXPECT_GT(slam.keyframes().front().sightings, 50);
  EXPECT_GT(slam.landmark_count(), 50U);
}

TEST(System, OptionOutOfRangeIsRefused) {
  SlamOptions options;
  options.tracker.window_frames = -3;
  EXPECT_THROW(Slam(scene_rig(), options), OptionError);
  StereoRig rig = scene_rig();
  rig.baseline = 0;
  EXPECT_THROW(Slam(rig, SlamOptions{}), InputError);
}

// A boat that goes to and fro gets a map of the place, not of the time.
TEST(System, TheMapGrowsWithTheAreaAndNotWithTheTime) {
  SlamOptions options = sequential_options();
  options.mapper.culling.revisit_gap = 12;
  Slam slam(scene_rig(), options);
  std::vector<std::size_t> keyframes, landmarks;
  double time = 0;
  for (int passage = 0; passage < 24; ++passage) {
    for (int i = 0; i < kSceneFrames; ++i) {
      StereoFrame pair = scene_pairs()[static_cast<std::size_t>(passage % 2 == 0 ? i : kSceneFrames - 1 - i)];
      pair.timestamp = time += 0.1;
      slam.track(pair);
    }
    keyframes.push_back(slam.keyframes().size());
    landmarks.push_back(slam.landmark_count());
  }
  // The ten newest keyframes and the window are exempt from culling, so the first rounds fill it.
  EXPECT_LE(keyframes[23], keyframes[11] + 3);
  EXPECT_LE(static_cast<double>(landmarks[23]), 1.2 * static_cast<double>(landmarks[11]));
}

}  // namespace
}  // namespace spslam
