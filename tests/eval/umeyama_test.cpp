// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/eval/umeyama.h"

#include <gmock/gmock.h>

#include "eval/synthetic.h"

namespace spslam {
namespace {

using testing_eval::figure_of_eight;
using testing_eval::paired;
using testing_eval::some_motion;
using testing_eval::straight_line;
using testing_eval::transformed;

double largest_error(const AlignResult& aligned, const std::vector<AssociatedPose>& pairs) {
  double largest = 0;
  for (const AssociatedPose& pair : aligned_poses(aligned.truth_from_estimate, pairs))
    largest = std::max(largest, (pair.estimate.translation - pair.truth.translation).norm());
  return largest;
}

class UmeyamaScale : public testing::TestWithParam<double> {};

TEST_P(UmeyamaScale, RecoversASimilarity) {
  const Trajectory truth = figure_of_eight(300);
  const auto pairs = paired(transformed(truth, some_motion(), GetParam()), truth);
  const AlignResult aligned = align_positions(pairs, AlignMode::kSim3, false);
  EXPECT_TRUE(aligned.has_scale);
  EXPECT_EQ(aligned.degenerate, "");
  EXPECT_NEAR(aligned.truth_from_estimate.scale * GetParam(), 1, 1e-9);
  EXPECT_NEAR(
      (aligned.truth_from_estimate.rotation * some_motion().rotation - Eigen::Matrix3d::Identity()).norm(), 0,
      1e-9);
  EXPECT_LT(largest_error(aligned, pairs), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Scales, UmeyamaScale, testing::Values(0.1, 0.7, 1.0, 1.31, 40.0));

TEST(Umeyama, RigidKeepsTheScale) {
  const Trajectory truth = figure_of_eight(300);
  const AlignResult aligned =
      align_positions(paired(transformed(truth, some_motion(), 1.5), truth), AlignMode::kSe3, false);
  EXPECT_EQ(aligned.truth_from_estimate.scale, 1);
  EXPECT_FALSE(aligned.has_scale);
}

TEST(Umeyama, NoneIsTheIdentity) {
  const Trajectory truth = figure_of_eight(10);
  const AlignResult aligned =
      align_positions(paired(transformed(truth, some_motion()), truth), AlignMode::kNone, false);
  EXPECT_TRUE(aligned.truth_from_estimate.rotation.isIdentity());
  EXPECT_TRUE(aligned.truth_from_estimate.translation.isZero());
}

TEST(Umeyama, IsALeastSquaresMinimum) {
  Random random(3);
  Trajectory truth = figure_of_eight(200), estimate = transformed(truth, some_motion());
  for (StampedPose& pose : estimate)
    for (int k = 0; k < 3; ++k) pose.world_from_camera.translation[k] += 0.5 * random.normal();
  const auto pairs = paired(estimate, truth);
  const auto cost = [&](const Similarity& s) {
    double sum = 0;
    for (const AssociatedPose& pair : aligned_poses(s, pairs))
      sum += (pair.estimate.translation - pair.truth.translation).squaredNorm();
    return sum;
  };
  const Similarity best = align_positions(pairs, AlignMode::kSe3, false).truth_from_estimate;
  for (int trial = 0; trial < 50; ++trial) {
    Vector6d step;
    for (int k = 0; k < 6; ++k) step[k] = 1e-3 * random.normal();
    const SE3 moved = SE3::exp(step) * SE3{best.rotation, best.translation};
    EXPECT_GE(cost({1, moved.rotation, moved.translation}), cost(best));
  }
}

TEST(Umeyama, AMirrorImageStaysAnError) {
  const Trajectory truth = figure_of_eight(300);
  Trajectory mirrored = truth;
  for (StampedPose& pose : mirrored) {
    pose.world_from_camera.translation.y() = 5 * std::sin(pose.timestamp);
    pose.world_from_camera.translation.x() *= -1;
  }
  Trajectory tall = truth;
  for (StampedPose& pose : tall) pose.world_from_camera.translation.y() = 5 * std::sin(pose.timestamp);
  const AlignResult aligned = align_positions(paired(mirrored, tall), AlignMode::kSe3, false);
  EXPECT_NEAR(aligned.truth_from_estimate.rotation.determinant(), 1, 1e-12);
  EXPECT_GT(largest_error(aligned, paired(mirrored, tall)), 1.0);
}

TEST(Umeyama, AStraightRunIsCalledDegenerateButFits) {
  const Trajectory truth = straight_line(200);
  const auto pairs = paired(transformed(truth, some_motion(), 1.1), truth);
  const AlignResult aligned = align_positions(pairs, AlignMode::kSim3, false);
  EXPECT_THAT(aligned.degenerate, testing::HasSubstr("straight"));
  EXPECT_NEAR(aligned.truth_from_estimate.scale, 1 / 1.1, 1e-9);
  EXPECT_LT(largest_error(aligned, pairs), 1e-9);
}

TEST(Umeyama, ARunThatStandsStillHasNoScale) {
  Random random(5);
  Trajectory truth, estimate;
  for (int i = 0; i < 30; ++i) {
    truth.push_back({0.1 * i, {}});
    estimate.push_back({0.1 * i, {Eigen::Matrix3d::Identity(), {1e-3 * random.normal(), 0, 0}}});
  }
  const AlignResult aligned = align_positions(paired(estimate, truth), AlignMode::kSim3, false);
  EXPECT_THAT(aligned.degenerate, testing::HasSubstr("stands still"));
  EXPECT_FALSE(aligned.has_scale);
  EXPECT_EQ(aligned.truth_from_estimate.scale, 1);
}

}  // namespace
}  // namespace spslam
