// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/odometry/motion_model.h"

#include <gtest/gtest.h>

namespace spslam {
namespace {

const Vector6d kTwist = (Vector6d() << 0.4, -0.1, 1.2, 0.2, 0.5, -0.3).finished();  // per second

SE3 at(double time) {
  return SE3::exp(time * kTwist) * SE3{so3_exp({0.1, 0.2, 0.3}), {1, 2, 3}};
}

double difference(const SE3& a, const SE3& b) {
  return (a * b.inverse()).log().norm();
}

TEST(MotionModel, KeepsAConstantTwist) {
  MotionModel model;
  model.add(0.0, at(0.0));
  model.add(0.1, at(0.1));
  EXPECT_LT(difference(model.predict(0.2), at(0.2)), 1e-12);
  EXPECT_LT(difference(model.predict(0.7), at(0.7)), 1e-12);
}

TEST(MotionModel, TimesMayBeUneven) {
  MotionModel model;
  for (const double time : {0.0, 0.13, 0.15, 0.4}) {
    if (time > 0.13) {
      EXPECT_LT(difference(model.predict(time), at(time)), 1e-12) << time;
    }
    model.add(time, at(time));
  }
  EXPECT_EQ(model.last_timestamp(), 0.4);
}

TEST(MotionModel, StandsStillAfterOnePose) {
  MotionModel model;
  EXPECT_LT(difference(model.predict(5), SE3{}), 1e-15);
  model.add(1.0, at(1.0));
  EXPECT_LT(difference(model.predict(1.1), at(1.0)), 1e-15);
}

TEST(MotionModel, FollowsAChangeOfVelocityAtOnce) {
  MotionModel model;
  model.add(0.0, at(0.0));
  model.add(0.1, at(0.1));
  model.add(0.2, at(0.1));  // stopped
  EXPECT_LT(difference(model.predict(0.3), at(0.1)), 1e-12);
}

TEST(MotionModel, CorrectMovesThePoseAndKeepsTheVelocity) {
  MotionModel model;
  model.add(0.0, at(0.0));
  model.add(0.1, at(0.1));
  const SE3 old_from_world{so3_exp({0.2, -0.1, 0.4}), {3, 1, -2}};
  model.correct(at(0.1) * old_from_world);
  EXPECT_LT(difference(model.predict(0.3), at(0.3) * old_from_world), 1e-12);
}

TEST(MotionModel, TheSameTimeAgainDoesNotDivideByZero) {
  MotionModel model;
  model.add(0.1, at(0.0));
  model.add(0.1, at(0.2));
  EXPECT_TRUE(model.predict(0.2).is_finite());
}

}  // namespace
}  // namespace spslam
