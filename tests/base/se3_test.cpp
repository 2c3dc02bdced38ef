// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/base/se3.h"

#include <gtest/gtest.h>

#include "spslam/base/random.h"

namespace spslam {
namespace {

Vector6d random_twist(Random& random, double size) {
  Vector6d twist;
  for (int i = 0; i < 6; ++i) twist[i] = random.uniform(-size, size);
  return twist;
}

double distance(const SE3& a, const SE3& b) {
  return (a.rotation - b.rotation).norm() + (a.translation - b.translation).norm();
}

class SE3Laws : public testing::TestWithParam<double> {};

TEST_P(SE3Laws, GroupAndAlgebra) {
  Random random(7);
  for (int i = 0; i < 100; ++i) {
    const Vector6d xi = random_twist(random, GetParam());
    const SE3 a = SE3::exp(xi), b = SE3::exp(random_twist(random, 1)), c = SE3::exp(random_twist(random, 1));
    EXPECT_LT((a.log() - xi).norm(), 1e-9);
    EXPECT_LT(distance(a * a.inverse(), SE3{}), 1e-12);
    EXPECT_LT(distance((a * b) * c, a * (b * c)), 1e-12);
    EXPECT_LT(distance(b * a * b.inverse(), SE3::exp(b.adjoint() * xi)), 1e-9);
    EXPECT_NEAR(a.rotation.determinant(), 1, 1e-12);
    const Eigen::Vector3d p(1, 2, 3);
    EXPECT_LT(((a * b) * p - a * (b * p)).norm(), 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, SE3Laws, testing::Values(1e-9, 1e-6, 1e-4, 0.1, 1.0, 1.7));

TEST(SE3, LogNearHalfTurn) {
  const Eigen::Vector3d phi = Eigen::Vector3d(1, -2, 0.5).normalized() * (M_PI - 1e-8);
  EXPECT_LT((so3_exp(so3_log(so3_exp(phi))) - so3_exp(phi)).norm(), 1e-7);
}

TEST(RotationBetween, IsThatOfTheDirections) {
  Random random(9);
  for (const int pairs : {2, 5}) {
    const Eigen::Matrix3d rotation = so3_exp(random_twist(random, 1).tail<3>());
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (int i = 0; i < pairs; ++i) {
      const Eigen::Vector3d a = random_twist(random, 1).head<3>().normalized();
      sum += rotation * a * a.transpose();
    }
    EXPECT_LT((rotation_between(sum) - rotation).norm(), 1e-12);
  }
  // The nearest orthogonal matrix would be a mirror.
  const Eigen::Matrix3d mirrored = Eigen::Vector3d(1, 1, -0.1).asDiagonal();
  EXPECT_LT((rotation_between(mirrored) - Eigen::Matrix3d::Identity()).norm(), 1e-12);
}

}  // namespace
}  // namespace spslam
