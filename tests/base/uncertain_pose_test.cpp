// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/base/uncertain_pose.h"

#include <gtest/gtest.h>

namespace spslam {
namespace {

UncertainPose pose_at(const Eigen::Vector3d& translation, const Eigen::Vector3d& sigma) {
  Vector6d all;
  all << sigma, 0.01, 0.01, 0.01;
  UncertainPose out;
  out.camera_from_world.translation = translation;
  out.covariance = all.cwiseAbs2().asDiagonal();
  return out;
}

TEST(UncertainPose, FusionTakesFromEachWhatItKnows) {
  const UncertainPose a = pose_at({0.3, 0.9, 0.5}, {0.01, 1, 1}),
                      b = pose_at({1.1, -0.2, -0.5}, {1, 0.01, 1});
  const UncertainPose both = fused(a, b);
  EXPECT_LT((both.camera_from_world.translation - Eigen::Vector3d(0.3, -0.2, 0)).norm(), 1e-3);
  EXPECT_NEAR(std::sqrt(both.covariance(2, 2)), std::sqrt(0.5), 1e-3);
  EXPECT_LT((fused(b, a).camera_from_world.translation - both.camera_from_world.translation).norm(), 1e-3);
}

TEST(UncertainPose, DistanceIsInDeviations) {
  const UncertainPose a = pose_at({0, 0, 0}, {0.3, 0.3, 0.3}), b = pose_at({2, 0, 0}, {0.4, 0.4, 0.4});
  EXPECT_NEAR(squared_distance(a, b), 16, 1e-6);  // 2 m over hypot(0.3, 0.4)
  EXPECT_NEAR(squared_distance(a, a), 0, 1e-12);
  EXPECT_LT(squared_distance(a, b, Matrix6d::Identity()), 4);
}

// A turn of the camera after which what was ahead is to the side: so is its uncertainty.
TEST(UncertainPose, MovingTurnsTheCovariance) {
  const UncertainPose before = pose_at({1, 2, 3}, {0.1, 0.1, 2});
  const SE3 turn{so3_exp({0, M_PI / 2, 0}), {0, 0, 0}};
  const UncertainPose after = moved(before, turn, 0.25 * Matrix6d::Identity());
  EXPECT_NEAR(after.covariance(0, 0), 4 + 0.25, 1e-9);
  EXPECT_NEAR(after.covariance(2, 2), 0.01 + 0.25, 1e-9);
  EXPECT_LT((after.camera_from_world.translation - turn.rotation * Eigen::Vector3d(1, 2, 3)).norm(), 1e-9);
}

}  // namespace
}  // namespace spslam
