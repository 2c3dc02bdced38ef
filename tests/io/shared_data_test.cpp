// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Real sequences, where they are (SPSLAM_SHARED_DATA); skipped elsewhere.

#include <gmock/gmock.h>

#include "io/synthetic_folder.h"
#include "spslam/io/dataset.h"
#include "spslam/io/prefetch.h"

namespace spslam {
namespace {

using namespace test;

class SharedData : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::is_directory(root_)) GTEST_SKIP() << "no sequences at " << root_ << " (SPSLAM_SHARED_DATA)";
  }
  const fs::path root_ = SPSLAM_SHARED_DATA;
};

TEST_F(SharedData, Kitti06) {
  const std::unique_ptr<Dataset> dataset = open_dataset(root_ / "kitti_06");
  const StereoRig& rig = dataset->rig();
  EXPECT_EQ(dataset->size(), 51);
  EXPECT_DOUBLE_EQ(rig.fx, 707.0912);
  EXPECT_DOUBLE_EQ(rig.cx, 601.8873);
  EXPECT_DOUBLE_EQ(rig.cy, 183.1104);
  EXPECT_NEAR(rig.baseline, 0.537150653267924, 1e-12);
  EXPECT_EQ(rig.width, 1226);
  EXPECT_EQ(rig.height, 370);
  ASSERT_TRUE(dataset->ground_truth());
  EXPECT_EQ(dataset->ground_truth()->size(), 51u);
  double length = 0;
  for (std::size_t i = 1; i < 51; ++i)
    length += (dataset->ground_truth()->at(i).world_from_camera.translation -
               dataset->ground_truth()->at(i - 1).world_from_camera.translation)
                  .norm();
  EXPECT_NEAR(length, 59.9, 0.1);
  int good = 0;
  for (Prefetcher frames(*dataset, 0, 5); const auto frame = frames.next();)
    good += frame->pair.problem.empty();
  EXPECT_EQ(good, 5);
}

TEST_F(SharedData, OthersInKittiLayout) {
  const std::pair<const char*, int> sequences[] = {
      {"kitti_raw", 220}, {"nearshore_bank", 240}, {"nearshore_loop", 250}};
  for (const auto& [name, frames] : sequences) {
    const std::unique_ptr<Dataset> dataset = open_dataset(root_ / name);
    EXPECT_EQ(dataset->size(), frames);
    EXPECT_EQ(dataset->ground_truth()->size(), static_cast<std::size_t>(frames));
    EXPECT_EQ(dataset->load(frames - 1).problem, "");
  }
}

TEST_F(SharedData, EurocStill) {
  const std::unique_ptr<Dataset> dataset = open_dataset(root_ / "euroc_still");
  EXPECT_EQ(dataset->size(), 12);
  EXPECT_EQ(dataset->unpaired(), 0);
  EXPECT_EQ(dataset->rig().width, 752);
  EXPECT_NEAR(dataset->rig().baseline, 0.11008, 1e-4);
  EXPECT_NEAR(dataset->rig().fx, 435, 5) << "published rectifications of this rig have 435.2 px";
  EXPECT_EQ(dataset->load(11).problem, "");
}

TEST_F(SharedData, PublishedTrajectories) {
  const fs::path evo = root_ / "reference" / "evo";
  EXPECT_EQ(read_trajectory(evo / "KITTI_00_gt.txt").size(), 4541u);
  EXPECT_EQ(read_trajectory(evo / "KITTI_00_ORB.txt").size(), 4541u);
  EXPECT_EQ(read_trajectory(evo / "fr2_desk_ORB.txt").size(), 2893u);
  EXPECT_EQ(read_trajectory(evo / "fr2_desk_groundtruth.txt").size(), 20956u)
      << "20957 lines, one time twice";
}

}  // namespace
}  // namespace spslam
