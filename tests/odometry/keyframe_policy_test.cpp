// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/odometry/keyframe_policy.h"

#include <gtest/gtest.h>

namespace spslam {
namespace {

// Nothing in it asks for a keyframe.
KeyframeEvidence quiet() {
  KeyframeEvidence e;
  e.frames_since_keyframe = 3;
  e.tracked = e.tracked_before = 500;
  e.entropy = -30;
  return e;
}

std::string reason_of(const KeyframeEvidence& evidence, const KeyframeOptions& options = {}) {
  KeyframePolicy policy;
  const KeyframeDecision decision = policy.decide(evidence, options);
  EXPECT_EQ(decision.insert(), !decision.reason().empty());
  return decision.reason();
}

TEST(KeyframePolicy, NothingFiresOnAQuietFrame) {
  EXPECT_EQ(reason_of(quiet()), "");
}

TEST(KeyframePolicy, EachConditionFiresByItself) {
  const KeyframeOptions options;
  KeyframeEvidence e = quiet();
  e.frames_since_keyframe = options.max_frames;
  EXPECT_EQ(reason_of(e), "frames");
  e = quiet(), e.rotation = options.max_rotation + 0.1;
  EXPECT_EQ(reason_of(e), "motion");
  e = quiet(), e.parallax = options.max_parallax + 0.1;
  EXPECT_EQ(reason_of(e), "motion");
  e = quiet(), e.share_of_keyframe = 1 - options.lost_of_keyframe - 0.01;
  EXPECT_EQ(reason_of(e), "keyframe-points");
  e = quiet(), e.tracked = static_cast<int>((1 - options.lost_of_previous) * e.tracked_before) - 1;
  EXPECT_EQ(reason_of(e), "previous-points");
  e = quiet(), e.tracked = e.tracked_before = options.min_tracked - 1;
  EXPECT_EQ(reason_of(e), "floor");
}

TEST(KeyframePolicy, NoConditionFiresJustBelowItsLimit) {
  const KeyframeOptions options;
  KeyframeEvidence e = quiet();
  e.frames_since_keyframe = options.max_frames - 1;
  e.rotation = options.max_rotation, e.parallax = options.max_parallax;
  e.share_of_keyframe = 1 - options.lost_of_keyframe + 0.01;
  e.tracked_before = 1000, e.tracked = static_cast<int>(1000 * (1 - options.lost_of_previous)) + 1;
  EXPECT_EQ(reason_of(e), "");
}

TEST(KeyframePolicy, AllReasonsAreNamed) {
  KeyframeEvidence e = quiet();
  e.frames_since_keyframe = 1000, e.rotation = 90, e.share_of_keyframe = 0, e.tracked = 1;
  EXPECT_EQ(reason_of(e), "frames+motion+keyframe-points+previous-points+floor");
}

TEST(KeyframePolicy, OnlyTheFloorFiresRightAfterAKeyframe) {
  KeyframeEvidence e = quiet();
  KeyframeOptions options;
  options.min_frames = 5;
  e.rotation = 90, e.share_of_keyframe = 0, e.tracked = 100;
  EXPECT_EQ(reason_of(e, options), "");
  e.tracked = options.min_tracked - 1;
  EXPECT_EQ(reason_of(e, options), "floor");
}

// 1/2 ln((2 pi e)^6 det).
TEST(DifferentialEntropy, ClosedFormOfADiagonalCovariance) {
  Vector6d variances;
  variances << 1e-4, 4e-4, 9e-4, 1e-6, 2e-6, 5e-6;
  double expected = 0;
  for (int i = 0; i < 6; ++i) expected += 0.5 * std::log(2 * M_PI * std::exp(1.0) * variances[i]);
  EXPECT_NEAR(differential_entropy(variances.asDiagonal()), expected, 1e-10);
}

TEST(DifferentialEntropy, DoesNotDependOnTheAxes) {
  Vector6d variances;
  variances << 1, 2, 3, 4, 5, 6;
  const Matrix6d diagonal = variances.asDiagonal();
  Matrix6d turn = Matrix6d::Identity();
  turn.topLeftCorner<3, 3>() = so3_exp({0.3, -0.5, 1});
  turn.bottomRightCorner<3, 3>() = so3_exp({-1, 0.2, 0.1});
  EXPECT_NEAR(differential_entropy(turn * diagonal * turn.transpose()), differential_entropy(diagonal),
              1e-12);
}

TEST(DifferentialEntropy, IsNotANumberWithoutAPositiveDefiniteCovariance) {
  Matrix6d covariance = Matrix6d::Identity();
  covariance(2, 2) = -1;
  EXPECT_TRUE(std::isnan(differential_entropy(covariance)));
  covariance(2, 2) = 0;
  EXPECT_TRUE(std::isnan(differential_entropy(covariance)));
}

// The answers to a row of covariances that grow by a factor in their deviations, in the given units.
std::vector<bool> answers(const std::vector<double>& factors, double translation_unit) {
  Vector6d deviations;
  deviations << 0.01, 0.02, 0.03, 0.001, 0.002, 0.003;
  deviations.head<3>() *= translation_unit;
  KeyframePolicy policy;
  std::vector<bool> out;
  for (const double factor : factors) {
    const Matrix6d covariance = (factor * deviations).cwiseAbs2().asDiagonal();
    KeyframeEvidence e = quiet();
    e.entropy = differential_entropy(covariance);
    out.push_back(policy.decide(e, {}).entropy_changed);
  }
  return out;
}

TEST(KeyframePolicy, EntropyFiresWhenTheUncertaintyGrowsByThirtyPercent) {
  EXPECT_EQ(answers({1, 1, 1.29}, 1), (std::vector<bool>{false, false, false}));
  EXPECT_EQ(answers({1, 1, 1.31}, 1), (std::vector<bool>{false, false, true}));
  // A keyframe begins the comparison anew.
  EXPECT_EQ(answers({1, 1.31, 1.31, 1.31}, 1), (std::vector<bool>{false, true, false, false}));
}

TEST(KeyframePolicy, EntropyIsThatOfTheReasonAlone) {
  KeyframePolicy policy;
  KeyframeEvidence e = quiet();
  policy.decide(e, {});
  e.entropy += 6 * std::log(1.5);
  EXPECT_EQ(policy.decide(e, {}).reason(), "entropy");
  KeyframeOptions off;
  off.entropy = false;
  e.entropy += 100;
  EXPECT_EQ(policy.decide(e, off).reason(), "");
}

TEST(KeyframePolicy, UnitsDoNotChangeTheDecision) {
  const std::vector<double> factors = {1, 1.1, 1.2, 1.25, 1.6, 1, 1.28, 1.5, 0.5, 0.8};
  EXPECT_EQ(answers(factors, 1), answers(factors, 1000));   // mm
  EXPECT_EQ(answers(factors, 1), answers(factors, 0.001));  // km
}

TEST(KeyframePolicy, ACovarianceThatIsNotPositiveDefiniteMakesAKeyframeDue) {
  KeyframeEvidence e = quiet();
  e.entropy = differential_entropy(-Matrix6d::Identity());
  EXPECT_EQ(reason_of(e), "entropy");
}

}  // namespace
}  // namespace spslam
