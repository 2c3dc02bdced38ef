// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/eval/trajectory_error.h"

#include <gtest/gtest.h>

#include "eval/synthetic.h"

namespace spslam {
namespace {

using testing_eval::figure_of_eight;
using testing_eval::paired;
using testing_eval::straight_line;
using testing_eval::transformed;

// The estimate turns by `rate` rad/s about y more than the truth: every motion of 1 s is wrong by that much.
Trajectory drifting(const Trajectory& truth, double rate) {
  Trajectory estimate;
  for (const StampedPose& pose : truth) {
    SE3 turned = pose.world_from_camera;
    turned.rotation = turned.rotation * so3_exp({0, rate * pose.timestamp, 0});
    estimate.push_back({pose.timestamp, turned});
  }
  return estimate;
}

TEST(TrajectoryError, AteOfAConstantOffset) {
  const Trajectory truth = figure_of_eight(50);
  const AteResult ate =
      absolute_trajectory_error(paired(transformed(truth, {Eigen::Matrix3d::Identity(), {3, 0, 4}}), truth));
  EXPECT_EQ(ate.errors.size(), 50u);
  EXPECT_NEAR(ate.position.mean, 5, 1e-12);
  EXPECT_NEAR(ate.position.rmse, 5, 1e-12);
  EXPECT_NEAR(ate.position.deviation, 0, 1e-6);
}

TEST(TrajectoryError, RpeFindsAKnownRotationDrift) {
  const Trajectory truth = straight_line(100);
  const double rate = 0.02;  // rad/s
  const RpeResult rpe = relative_pose_error_per_second(paired(drifting(truth, rate), truth));
  EXPECT_EQ(rpe.rotation.count, 90u);
  EXPECT_NEAR(rpe.rotation.mean, rate * 180 / M_PI, 1e-9);
  EXPECT_NEAR(rpe.rotation.maximum, rate * 180 / M_PI, 1e-9);
  const RpeResult frame = relative_pose_error_per_frame(paired(drifting(truth, rate), truth));
  EXPECT_EQ(frame.rotation.count, 99u);
  EXPECT_NEAR(frame.rotation.mean, 0.1 * rate * 180 / M_PI, 1e-9);
}

TEST(TrajectoryError, RpeFindsAKnownScaleErrorWhateverTheInterval) {
  const Trajectory truth = straight_line(100);  // 1 m/s
  const auto pairs = paired(transformed(truth, {}, 1.07), truth);
  for (const double interval : {0.5, 1.0, 2.0})
    EXPECT_NEAR(relative_pose_error_per_second(pairs, interval).translation.mean, 0.07, 1e-9) << interval;
  EXPECT_NEAR(relative_pose_error_per_frame(pairs).translation.rmse, 0.007, 1e-9);
  EXPECT_NEAR(relative_pose_error_per_frame(pairs, 10).translation.rmse, 0.07, 1e-9);
}

TEST(TrajectoryError, RpeIsTheSameInAnyWorld) {
  const Trajectory truth = figure_of_eight(200), estimate = drifting(transformed(truth, {}, 1.02), 0.01);
  const RpeResult a = relative_pose_error_per_second(paired(estimate, truth));
  const RpeResult b =
      relative_pose_error_per_second(paired(transformed(estimate, testing_eval::some_motion()), truth));
  EXPECT_NEAR(a.translation.rmse, b.translation.rmse, 1e-12);
  EXPECT_NEAR(a.rotation.rmse, b.rotation.rmse, 1e-9);
}

TEST(TrajectoryError, RpeLeavesOutMotionsOverAGap) {
  Trajectory truth = straight_line(40);
  truth.erase(truth.begin() + 15, truth.begin() + 30);  // nothing from 1.5 to 2.9 s
  const RpeResult rpe = relative_pose_error_per_second(paired(truth, truth));
  for (const double t : rpe.timestamps) EXPECT_TRUE(t < 0.7 || t > 1.9) << t;
  EXPECT_GT(rpe.translation.count, 5u);
}

TEST(TrajectoryError, RpeRefusesIntervalsThatAreNone) {
  EXPECT_THROW(relative_pose_error_per_second({}, 0), OptionError);
  EXPECT_THROW(relative_pose_error_per_frame({}, 0), OptionError);
  EXPECT_EQ(relative_pose_error_per_second({}).translation.count, 0u);
}

TEST(TrajectoryError, KittiFindsAKnownScaleAndTurn) {
  const Trajectory truth = straight_line(9100);  // 909.9 m
  const KittiResult scaled = kitti_error(paired(transformed(truth, {}, 1.01), truth));
  ASSERT_EQ(scaled.lengths.size(), 8u);
  // From the first pose MORE than the length further on: 100.1 m of a motion of 100 m, up to rounding.
  EXPECT_NEAR(scaled.t_rel, 1.0, 2e-3);
  EXPECT_NEAR(scaled.r_rel, 0, 1e-9);
  const double rate = 1e-4;  // rad/s, and rad/m at 1 m/s
  const KittiResult turned = kitti_error(paired(drifting(truth, rate), truth));
  EXPECT_NEAR(turned.r_rel, 100 * rate * 180 / M_PI, 1e-3);
}

TEST(TrajectoryError, KittiCountsStartsAtEveryTenthPose) {
  const Trajectory truth = straight_line(1502);  // 150.1 m: starts 0, 10, ... while 100 m are left
  const KittiResult kitti = kitti_error(paired(truth, truth));
  ASSERT_EQ(kitti.lengths.size(), 1u);
  EXPECT_EQ(kitti.count, kitti.lengths[0].count);
  EXPECT_NEAR(static_cast<double>(kitti.count), 51, 1);
  EXPECT_NEAR(kitti.t_rel, 0, 1e-9);
}

TEST(TrajectoryError, KittiOfAShortPathHasNoFigure) {
  const Trajectory truth = straight_line(900);
  const KittiResult kitti = kitti_error(paired(truth, truth));
  EXPECT_EQ(kitti.count, 0u);
  EXPECT_TRUE(std::isnan(kitti.t_rel) && std::isnan(kitti.r_rel));
}

}  // namespace
}  // namespace spslam
