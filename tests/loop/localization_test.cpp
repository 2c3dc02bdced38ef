// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The filter that says where in a known map the camera is.

#include "spslam/loop/localization.h"

#include <gmock/gmock.h>

#include <random>

namespace spslam {
namespace {

const SE3 kStep{so3_exp({0, 0.01, 0}), {0, 0.02, -0.2}};  // camera_from_camera before it

UncertainPose pose_at(const SE3& pose, double sigma = 0.05, double turn = 0.005) {
  UncertainPose out{pose, Matrix6d::Zero()};
  out.covariance.diagonal().head<3>().setConstant(sigma * sigma);
  out.covariance.diagonal().tail<3>().setConstant(turn * turn);
  return out;
}

SE3 shifted(const SE3& camera_from_world, double metres) {
  return SE3{Eigen::Matrix3d::Identity(), {metres, 0, 0}} * camera_from_world;
}

Vector6d draw(std::mt19937& random, const Matrix6d& covariance) {
  std::normal_distribution<double> normal;
  Vector6d white;
  for (int i = 0; i < 6; ++i) white[i] = normal(random);
  return Matrix6d(covariance.llt().matrixL()) * white;
}

TEST(LocalizationFilter, NothingIsKnownUntilEnoughAttemptsAgree) {
  LocalizationFilter filter({});
  SE3 truth = kStep;
  EXPECT_FALSE(filter.estimate());
  EXPECT_EQ(filter.add(pose_at(truth)), FilterAnswer::kPending);
  EXPECT_FALSE(filter.estimate());
  // One that contradicts it begins the count anew.
  EXPECT_EQ(filter.add(pose_at(shifted(truth, 3))), FilterAnswer::kPending);
  filter.move(kStep);
  truth = kStep * truth;
  EXPECT_EQ(filter.add(pose_at(truth)), FilterAnswer::kPending);
  filter.move(kStep);
  truth = kStep * truth;
  EXPECT_EQ(filter.add(pose_at(truth)), FilterAnswer::kRestarted);
  ASSERT_TRUE(filter.estimate());
  EXPECT_LT((filter.estimate()->camera_from_world.translation - truth.translation).norm(), 1e-9);
}

TEST(LocalizationFilter, OneWrongPlaceDoesNotMoveItManyDo) {
  LocalizationFilter filter({});
  SE3 truth;
  filter.add(pose_at(truth));
  filter.add(pose_at(truth));
  EXPECT_EQ(filter.add(pose_at(shifted(truth, 2))), FilterAnswer::kPending);
  EXPECT_LT(filter.estimate()->camera_from_world.translation.norm(), 1e-9);
  EXPECT_EQ(filter.add(pose_at(truth)), FilterAnswer::kUsed);
  EXPECT_EQ(filter.add(pose_at(shifted(truth, 2))), FilterAnswer::kPending);
  EXPECT_EQ(filter.add(pose_at(shifted(truth, 2))), FilterAnswer::kRestarted);
  EXPECT_NEAR(filter.estimate()->camera_from_world.translation.x(), 2, 1e-9);
}

TEST(LocalizationFilter, WithoutPlacesItGrowsUncertainAndInTheEndSaysNothing) {
  LocalizationFilter filter({});
  filter.add(pose_at({}));
  filter.add(pose_at({}));
  double before = filter.estimate()->position_sigma();
  int steps = 0;
  for (; filter.estimate() && steps < 100000; ++steps) {
    EXPECT_GE(filter.estimate()->position_sigma(), before);
    before = filter.estimate()->position_sigma();
    filter.move(kStep);
  }
  EXPECT_GT(steps, 50);
  EXPECT_LT(steps, 100000);
  filter.forget();
  EXPECT_FALSE(filter.estimate());
}

TEST(LocalizationFilter, WhatIsNotFiniteChangesNothing) {
  LocalizationFilter filter({});
  filter.add(pose_at({}));
  filter.add(pose_at({}));
  UncertainPose broken = pose_at({});
  broken.camera_from_world.translation.x() = NAN;
  EXPECT_EQ(filter.add(broken), FilterAnswer::kPending);
  EXPECT_TRUE(filter.estimate()->camera_from_world.is_finite());
}

// Errors drawn from the covariances it is told: the mean of the squared Mahalanobis distance of 6 degrees of
// freedom over 200 independent runs lies within 6 +- 0.97 with 99.9 % (standard deviation sqrt(12 / 200)).
TEST(LocalizationFilter, ItsCovarianceIsThatOfItsError) {
  LocalizationOptions options;
  options.map_sigma = options.map_turn_sigma = 0;
  options.gate = 1000;
  options.confirmations = 1;
  std::mt19937 random(7);
  double sum = 0;
  constexpr int kRuns = 200;
  for (int run = 0; run < kRuns; ++run) {
    LocalizationFilter filter(options);
    SE3 truth;
    for (int i = 0; i < 30; ++i) {
      truth = kStep * truth;
      filter.move(SE3::exp(draw(random, drift_covariance(kStep, options))) * kStep);
      if (i % 5 != 0) continue;
      UncertainPose measured = pose_at(truth);
      measured.camera_from_world = SE3::exp(draw(random, measured.covariance)) * truth;
      filter.add(measured);
    }
    const UncertainPose known = *filter.estimate();
    const Vector6d error = (known.camera_from_world * truth.inverse()).log();
    sum += error.dot(known.covariance.ldlt().solve(error));
  }
  EXPECT_NEAR(sum / kRuns, 6, 0.97);
}

TEST(LocalizationFilter, TwoPlacesThatAreNotPreciseConfirmAsMuchAsOneThatIs) {
  const SE3 truth;
  LocalizationOptions options;
  options.start_sigma = 0.7;
  const auto beginning = [&](const std::vector<bool>& precise, double sigma) {
    LocalizationFilter filter(options);
    for (const bool each : precise) filter.add(pose_at(truth, sigma), each);
    return filter.estimate().has_value();
  };
  EXPECT_FALSE(beginning({false, false, false}, 0.3));
  EXPECT_TRUE(beginning({false, false, false, false}, 0.3));
  EXPECT_FALSE(beginning({true, false}, 0.3));
  EXPECT_TRUE(beginning({true, false, false}, 0.3));
  EXPECT_TRUE(beginning({true, true}, 0.3));
  // Those that hardly tell the position begin nothing, however many.
  EXPECT_FALSE(beginning(std::vector<bool>(20, false), 2));
  // Nor do those that do not agree.
  LocalizationFilter filter(options);
  for (int i = 0; i < 20; ++i)
    EXPECT_EQ(filter.add(pose_at(shifted(truth, 5 * i)), false), FilterAnswer::kPending);
}

TEST(LocalizationFilter, WhatIsNotPreciseCorrectsButNeitherBeginsNorContradicts) {
  LocalizationFilter filter({});
  const SE3 truth;
  for (int i = 0; i < 5; ++i) EXPECT_EQ(filter.add(pose_at(truth), false), FilterAnswer::kPending);
  EXPECT_FALSE(filter.estimate());
  filter.add(pose_at(truth));
  filter.add(pose_at(truth));
  const double before = filter.estimate()->position_sigma();
  EXPECT_EQ(filter.add(pose_at(shifted(truth, 0.05)), false), FilterAnswer::kUsed);
  EXPECT_LT(filter.estimate()->position_sigma(), before);
  const double corrected = filter.estimate()->camera_from_world.translation.x();
  EXPECT_GT(corrected, 0);
  for (int i = 0; i < 5; ++i)
    EXPECT_EQ(filter.add(pose_at(shifted(truth, 2)), false), FilterAnswer::kPending);
  EXPECT_EQ(filter.estimate()->camera_from_world.translation.x(), corrected);
  // Between two precise contradictions it refutes neither.
  EXPECT_EQ(filter.add(pose_at(shifted(truth, 2))), FilterAnswer::kPending);
  EXPECT_EQ(filter.add(pose_at(truth, 3, 0.1), false), FilterAnswer::kUsed);
  EXPECT_EQ(filter.add(pose_at(shifted(truth, 2))), FilterAnswer::kRestarted);
}

// Odometry with drift and places with noise, both drawn from their covariances: smoothed, frames are nearer
// to the truth than the filter had them, those before the first place included.
TEST(Smooth, EveryFrameIsPlacedByAllThatWasRecognized) {
  LocalizationOptions options;
  options.map_sigma = options.map_turn_sigma = 0;
  options.confirmations = 1;
  std::mt19937 random(11);
  double filtered = 0, smoothed = 0;
  for (int run = 0; run < 20; ++run) {
    LocalizationFilter filter(options);
    PlacedRun passage;
    std::vector<SE3> truth = {kStep}, known = {{}};
    passage.camera_from_session = {SE3{}};
    for (std::size_t i = 1; i < 60; ++i) {
      const SE3 step = SE3::exp(draw(random, drift_covariance(kStep, options))) * kStep;
      truth.push_back(kStep * truth.back());
      passage.camera_from_session.push_back(step * passage.camera_from_session.back());
      filter.move(step);
      if (i % 10 == 5) {
        UncertainPose measured = pose_at(truth.back());
        measured.camera_from_world = SE3::exp(draw(random, measured.covariance)) * truth.back();
        passage.places.push_back({i, measured});
        filter.add(measured);
      }
      known.push_back(filter.estimate() ? filter.estimate()->camera_from_world : SE3{});
    }
    const std::vector<SE3> out = smooth(passage, options);
    ASSERT_EQ(out.size(), truth.size());
    for (std::size_t i = 0; i < out.size(); ++i) {
      const auto off = [&](const SE3& pose) {
        return (pose * truth[i].inverse()).log().head<3>().squaredNorm();
      };
      if (i >= 5) filtered += off(known[i]);
      smoothed += off(out[i]);
    }
  }
  EXPECT_LT(smoothed / 60, 0.7 * filtered / 55);
}

TEST(Smooth, StandingStillAndOnePlaceAreEnoughAndNoneIsNot) {
  PlacedRun still;
  still.camera_from_session.assign(4, SE3{});
  EXPECT_TRUE(smooth(still, {}).empty());
  const SE3 truth{so3_exp({0, 0.3, 0}), {1, 2, 3}};
  still.places.push_back({2, pose_at(truth)});
  const std::vector<SE3> out = smooth(still, {});
  ASSERT_EQ(out.size(), 4U);
  for (const SE3& pose : out) EXPECT_LT((pose * truth.inverse()).log().norm(), 1e-6);
}

TEST(NearestKeyframes, LookFromNearInTheSameDirection) {
  Map map;
  for (int i = 0; i < 6; ++i) {
    Keyframe keyframe;
    keyframe.id = {i};
    if (i > 0) keyframe.parent = {i - 1};
    keyframe.camera_from_world = SE3{Eigen::Matrix3d::Identity(), {-2.0 * i, 0, 0}};
    if (i == 3)
      keyframe.camera_from_world = SE3{so3_exp({0, M_PI, 0}), {0, 0, 0}} * keyframe.camera_from_world;
    map.add(std::move(keyframe));
  }
  const SE3 here{Eigen::Matrix3d::Identity(), {-6.1, 0, 0}};
  EXPECT_THAT(nearest_keyframes(map, here, 2), testing::ElementsAre(KeyframeId{4}, KeyframeId{2}));
  EXPECT_EQ(nearest_keyframes(map, here, 10).size(), 5U);
  EXPECT_TRUE(nearest_keyframes({}, here, 2).empty());
}

}  // namespace
}  // namespace spslam
