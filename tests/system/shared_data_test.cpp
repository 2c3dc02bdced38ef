// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Short runs on recorded and rendered sequences with known truth. The limits are loose: they tell a broken
// system, docs/RESULTS.md has the figures.

#include <gmock/gmock.h>

#include <filesystem>

#include "spslam/io/prefetch.h"
#include "system/scene_run.h"

namespace spslam {
namespace {

using namespace test;

// The trajectory of the first `frames` frames of a shared sequence.
Trajectory run_shared(const Dataset& dataset, int frames) {
  Slam slam(dataset.rig(), sequential_options());
  Prefetcher prefetcher(dataset, 0, frames);
  while (const auto frame = prefetcher.next()) slam.track(frame->pair);
  slam.finish();
  return poses_of(slam);
}

std::filesystem::path shared(const char* name) {
  return std::filesystem::path(SPSLAM_SHARED_DATA) / name;
}

#define SKIP_WITHOUT(name)                    \
  if (!std::filesystem::exists(shared(name))) \
  GTEST_SKIP() << shared(name).string() << " is not here; set SPSLAM_SHARED_DATA"

TEST(RealData, KittiStreet) {
  SKIP_WITHOUT("kitti_06");
  const auto dataset = open_dataset(shared("kitti_06"));
  const Trajectory trajectory = run_shared(*dataset, 50);
  ASSERT_EQ(trajectory.size(), 50U);
  const Evaluation evaluation = evaluate(trajectory, *dataset->ground_truth(), {});
  EXPECT_LT(evaluation.ate.position.rmse, 0.3);
}

TEST(RealData, VehicleThatStandsStill) {
  SKIP_WITHOUT("euroc_still");
  const auto dataset = open_dataset(shared("euroc_still"));
  const Trajectory trajectory = run_shared(*dataset, dataset->size());
  ASSERT_EQ(static_cast<int>(trajectory.size()), dataset->size());
  for (const StampedPose& pose : trajectory)
    EXPECT_LT((pose.world_from_camera.translation - trajectory[0].world_from_camera.translation).norm(),
              0.02);
}

TEST(RealData, ScaleAlongABank) {
  SKIP_WITHOUT("nearshore_bank");
  const auto dataset = open_dataset(shared("nearshore_bank"));
  const Trajectory trajectory = run_shared(*dataset, 100);
  ASSERT_EQ(trajectory.size(), 100U);
  const Evaluation evaluation = evaluate(trajectory, *dataset->ground_truth(), {});
  EXPECT_NEAR(evaluation.scale_ratio, 1, 0.02);
}

}  // namespace
}  // namespace spslam
