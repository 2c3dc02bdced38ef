// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Analytic derivatives against central differences.

#include <gtest/gtest.h>

#include "spslam/base/random.h"
#include "spslam/optimize/synthetic.h"

namespace spslam {
namespace {

constexpr double kStep = 1e-6;

Vector6d along(int axis, double length) {
  return length * Vector6d::Unit(axis);
}

Vector6d bounded_twist(Random& random, double translation, double rotation) {
  Vector6d xi;
  for (int i = 0; i < 6; ++i) xi[i] = random.uniform(-1, 1) * (i < 3 ? translation : rotation);
  return xi;
}

struct Case {
  SE3 camera_from_host;
  Eigen::Vector3d bearing, measured;
  double inverse_depth;
};

// Inverse depths near, at, and a little below zero.
Case draw(Random& random) {
  return {SE3::exp(bounded_twist(random, 1, 0.4)),
          {random.uniform(-0.8, 0.8), random.uniform(-0.5, 0.5), 1},
          {random.uniform(0, 640), random.uniform(0, 360), random.uniform(-2, 30)},
          random.below(4) == 0 ? 0 : random.uniform(-0.02, 0.4)};
}

const StereoRig& rig() {
  static const StereoRig value = make_synthetic_world({.points = 0}).truth.rig;
  return value;
}

Eigen::Vector3d residual(const SE3& motion, const Case& c, double inverse_depth) {
  return linearize(rig(), motion, c.bearing, inverse_depth, c.measured).residual;
}

TEST(LinearizeObservation, MatchesTheProjectionOfThePoint) {
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    Case c = draw(random);
    c.inverse_depth = random.uniform(0.05, 0.4);
    const Eigen::Vector3d point = c.camera_from_host * Eigen::Vector3d(c.bearing / c.inverse_depth);
    const Linearized at = linearize(rig(), c.camera_from_host, c.bearing, c.inverse_depth, c.measured);
    ASSERT_TRUE(at.in_front);
    const Eigen::Vector2d left = rig().project(point),
                          right = rig().project(point - Eigen::Vector3d(rig().baseline, 0, 0));
    const Eigen::Vector3d seen(left.x(), left.y(), left.x() - right.x());
    EXPECT_LT((at.residual - (seen - c.measured)).norm(), 1e-9);
  }
}

TEST(LinearizeObservation, DerivativesByMotionAndInverseDepth) {
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    const Case c = draw(random);
    const Linearized at = linearize(rig(), c.camera_from_host, c.bearing, c.inverse_depth, c.measured);
    ASSERT_TRUE(at.in_front);
    for (int axis = 0; axis < 6; ++axis) {
      const Eigen::Vector3d plus = residual(SE3::exp(along(axis, kStep)) * c.camera_from_host, c,
                                            c.inverse_depth),
                            minus = residual(SE3::exp(along(axis, -kStep)) * c.camera_from_host, c,
                                             c.inverse_depth);
      const Eigen::Vector3d numeric = (plus - minus) / (2 * kStep);
      EXPECT_LT((at.by_relative.col(axis) - numeric).norm(), 1e-5 * (1 + numeric.norm())) << axis;
    }
    const Eigen::Vector3d numeric = (residual(c.camera_from_host, c, c.inverse_depth + kStep) -
                                     residual(c.camera_from_host, c, c.inverse_depth - kStep)) /
                                    (2 * kStep);
    EXPECT_LT((at.by_inverse_depth - numeric).norm(), 1e-5 * (1 + numeric.norm()));
  }
}

TEST(LinearizeObservation, SaysWhatIsBehindTheCamera) {
  const SE3 turned{so3_exp({0, M_PI, 0}), Eigen::Vector3d::Zero()};
  EXPECT_FALSE(linearize(rig(), turned, {0, 0, 1}, 0.1, Eigen::Vector3d::Zero()).in_front);
  const SE3 passed{Eigen::Matrix3d::Identity(), {0, 0, -20}};
  EXPECT_FALSE(linearize(rig(), passed, {0, 0, 1}, 0.1, Eigen::Vector3d::Zero()).in_front);
  EXPECT_TRUE(linearize(rig(), passed, {0, 0, 1}, 0, Eigen::Vector3d::Zero()).in_front);
}

}  // namespace
}  // namespace spslam
