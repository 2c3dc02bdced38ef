// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/eval/planar.h"

#include <gmock/gmock.h>

#include "eval/synthetic.h"

namespace spslam {
namespace {

using testing_eval::figure_of_eight;
using testing_eval::straight_line;
using testing_eval::transformed;

std::vector<SE3> poses_of(const Trajectory& trajectory) {
  std::vector<SE3> poses;
  for (const StampedPose& pose : trajectory) poses.push_back(pose.world_from_camera);
  return poses;
}

// As an RTK receiver gives it: east, north, no height, heading only.
Trajectory rtk_of(const Trajectory& camera) {
  Trajectory truth;
  for (const StampedPose& pose : camera) {
    const Eigen::Vector3d p = pose.world_from_camera.translation,
                          ahead = pose.world_from_camera.rotation.col(2);
    const double heading = std::atan2(ahead.x(), ahead.z()) * 180 / M_PI;
    const SE3 flat = planar_pose(p.x() + 500, p.z() - 200, heading);
    truth.push_back({pose.timestamp, flat});
  }
  return truth;
}

TEST(Planar, UpIsFoundInEitherWorld) {
  const Trajectory camera = figure_of_eight(1000);
  EXPECT_LT((up_direction(poses_of(camera), UpAxis::kAuto) + Eigen::Vector3d::UnitY()).norm(), 0.02);
  EXPECT_LT((up_direction(poses_of(rtk_of(camera)), UpAxis::kAuto) - Eigen::Vector3d::UnitZ()).norm(), 1e-9);
  const SE3 turn{so3_exp({0.3, 0.2, -0.6}), {1, 2, 3}};
  EXPECT_LT((up_direction(poses_of(transformed(camera, turn)), UpAxis::kAuto) + turn.rotation.col(1)).norm(),
            0.02);
  EXPECT_EQ(up_direction(poses_of(camera), UpAxis::kMinusX), Eigen::Vector3d(-1, 0, 0));
}

TEST(Planar, APitchedCameraDoesNotShortenTheWay) {
  // The camera looks 10 degrees down and the first camera's frame is the world: the level way climbs in it.
  const SE3 pitch{so3_exp({10 * M_PI / 180, 0, 0}), {0, 0, 0}};
  Trajectory camera = transformed(straight_line(300), pitch.inverse());
  for (StampedPose& pose : camera) pose.world_from_camera.rotation.setIdentity();
  const auto flat = planar_poses(associate(camera, straight_line(300), {}), UpAxis::kAuto, UpAxis::kAuto);
  EXPECT_NEAR(estimate_path_length(flat), 29.9, 1e-3);
}

TEST(Planar, HeightRollAndPitchDoNotCount) {
  const Trajectory camera = figure_of_eight(1000);
  EvaluationOptions options;
  options.planar = true;
  const Evaluation e = evaluate(camera, rtk_of(camera), options);
  EXPECT_LT(e.ate.position.rmse, 5e-3);
  EXPECT_LT(e.rpe_per_second.translation.rmse, 5e-2) << "roll and pitch turn the body frame a little";
  EXPECT_LT(e.rpe_per_second.rotation.rmse, 1.0);
  EXPECT_NEAR(e.scale_ratio, 1, 1e-3);
}

TEST(Planar, FindsAScaleErrorOfAStraightRunWithoutDegeneracy) {
  const Trajectory truth = straight_line(300);
  EvaluationOptions options;
  options.planar = true;
  options.align = AlignMode::kSim3;
  const Evaluation e = evaluate(transformed(truth, testing_eval::some_motion(), 0.8), truth, options);
  EXPECT_NEAR(e.scale_ratio, 1.25, 1e-6);
  EXPECT_LT(e.ate.position.rmse, 1e-6);
  EXPECT_THAT(e.notes, testing::Not(testing::Contains(testing::HasSubstr("degenerate"))));
}

TEST(Planar, TheBodyOfTheTruthMayBeTurned) {
  const Trajectory camera = figure_of_eight(500);
  Trajectory truth = rtk_of(camera);
  for (StampedPose& pose : truth) {
    const Eigen::Vector3d up(0, 0, 1);
    pose.world_from_camera.rotation = so3_exp(1.2 * up) * pose.world_from_camera.rotation;
  }
  EvaluationOptions options;
  options.planar = true;
  EXPECT_LT(evaluate(camera, truth, options).rpe_per_second.translation.rmse, 5e-2);
}

TEST(Planar, FindsAKnownHeadingDrift) {
  const Trajectory truth = straight_line(300);
  Trajectory estimate = truth;
  for (StampedPose& pose : estimate) pose.world_from_camera.rotation = so3_exp({0, 0.01 * pose.timestamp, 0});
  EvaluationOptions options;
  options.planar = true;
  EXPECT_NEAR(evaluate(estimate, truth, options).rpe_per_second.rotation.mean, 0.01 * 180 / M_PI, 1e-6);
}

}  // namespace
}  // namespace spslam
