// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Against published figures: trajectories that came with evo (Grupp, 2017), ORB-SLAM2's paper (its Table I,
// KITTI 00: t_rel 0.70 %, r_rel 0.25 deg/100 m), and what an independent program (numpy, no shared line) gave
// for the rest.

#include <gmock/gmock.h>

#include <filesystem>

#include "eval/synthetic.h"
#include "spslam/eval/trajectory_pair.h"

namespace spslam {
namespace {

class Published : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(folder_))
      GTEST_SKIP() << "the published trajectories are not in " << folder_;
  }
  Evaluation of(const char* estimate, const char* truth, EvaluationOptions options = {}) const {
    TrajectoryPairFiles files;
    files.estimate = folder_ / estimate;
    files.truth = folder_ / truth;
    const TrajectoryPair pair = read_trajectory_pair(files);
    options.association.by_index = pair.by_index;
    return evaluate(pair.estimate, pair.truth, options);
  }
  std::filesystem::path folder_ = std::filesystem::path(SPSLAM_SHARED_DATA) / "reference" / "evo";
};

TEST_F(Published, OrbSlamOnKitti00) {
  const Evaluation e = of("KITTI_00_ORB.txt", "KITTI_00_gt.txt");
  EXPECT_TRUE(e.options.association.by_index);
  EXPECT_EQ(e.poses.size(), 4541u);
  EXPECT_NEAR(e.ate.position.rmse, 1.30345, 5e-6);
  EXPECT_NEAR(e.ate.position.mean, 1.15700, 1e-5);
  EXPECT_NEAR(e.ate.position.maximum, 3.58795, 1e-5);
  EXPECT_NEAR(e.ate.position.deviation, 0.60028, 1e-5);
  EXPECT_NEAR(e.ate.position.median, 1.06562, 1e-5);
  EXPECT_NEAR(e.scale_ratio, 1.004698, 1e-6);
  EXPECT_NEAR(e.rpe_per_frame.translation.rmse, 0.028120, 1e-6);
  EXPECT_NEAR(e.rpe_per_frame.rotation.rmse, 0.114974, 1e-5);
  EXPECT_NEAR(e.kitti.t_rel, 0.70, 0.005);
  EXPECT_NEAR(e.kitti.r_rel, 0.25, 0.005);
  EXPECT_NEAR(e.kitti.t_rel, 0.699729, 1e-5);
  EXPECT_NEAR(e.kitti.r_rel, 0.253323, 1e-5);
  EXPECT_EQ(e.kitti.count, 3283u);
}

TEST_F(Published, SptamOnKitti00) {
  const Evaluation e = of("KITTI_00_SPTAM.txt", "KITTI_00_gt.txt");
  EXPECT_NEAR(e.ate.position.rmse, 3.73849, 5e-6);
  EXPECT_NEAR(e.scale_ratio, 1.004527, 1e-6);
  EXPECT_NEAR(e.kitti.t_rel, 1.486961, 1e-5);
  EXPECT_NEAR(e.kitti.r_rel, 0.557706, 1e-5);
}

TEST_F(Published, Freiburg2DeskIsAssociatedByTime) {
  const Evaluation e = of("fr2_desk_ORB.txt", "fr2_desk_groundtruth.txt");
  EXPECT_FALSE(e.options.association.by_index);
  EXPECT_EQ(e.poses.size(), 2223u);
  EXPECT_NEAR(e.ate.position.rmse, 0.008144, 1e-6);
  EXPECT_NEAR(e.scale_ratio, 0.997002, 1e-6);
  EXPECT_EQ(e.rpe_per_second.translation.count, 2161u);
  EXPECT_NEAR(e.rpe_per_second.translation.rmse, 0.007255, 1e-6);
  EXPECT_NEAR(e.rpe_per_second.rotation.rmse, 0.469508, 1e-5);
  EvaluationOptions options;
  options.align = AlignMode::kSim3;
  EXPECT_NEAR(of("fr2_desk_ORB.txt", "fr2_desk_groundtruth.txt", options).ate.position.rmse, 0.006186, 1e-6);
}

TEST_F(Published, TimesAndIndicesDoNotMix) {
  EXPECT_THAT(testing_eval::message_of<InputError>([&] { of("fr2_desk_ORB.txt", "KITTI_00_gt.txt"); }),
              testing::HasSubstr("--times"));
}

}  // namespace
}  // namespace spslam
