// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/eval/association.h"

#include <gmock/gmock.h>

#include <limits>

#include "eval/synthetic.h"

namespace spslam {
namespace {

using testing::HasSubstr;
using testing_eval::message_of;

Trajectory at(std::initializer_list<double> times) {
  Trajectory poses;
  for (const double t : times) poses.push_back({t, {Eigen::Matrix3d::Identity(), {t, 0, 0}}});
  return poses;
}

std::vector<double> truth_times(const std::vector<AssociatedPose>& pairs) {
  std::vector<double> times;
  for (const AssociatedPose& pair : pairs) times.push_back(pair.truth.translation.x());
  return times;
}

TEST(Association, TakesTheNearestWithinTheTolerance) {
  const auto pairs = associate(at({0.0, 1.011, 2.0, 3.0}), at({0.01, 0.99, 1.02, 2.5, 2.99}), {});
  EXPECT_THAT(truth_times(pairs), testing::ElementsAre(0.01, 1.02, 2.99));
}

TEST(Association, OneTruthPoseServesOnlyTheNearestEstimate) {
  const auto pairs = associate(at({0.985, 0.99, 1.0, 1.01}), at({1.001}), {});
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].timestamp, 1.0);
}

TEST(Association, OffsetIsAddedToTheTruth) {
  AssociationOptions options;
  options.offset = 100;
  const auto pairs = associate(at({100, 101, 102}), at({0, 1, 2}), options);
  EXPECT_THAT(truth_times(pairs), testing::ElementsAre(0, 1, 2));
}

TEST(Association, InterpolatesBetweenNeighbours) {
  AssociationOptions options;
  options.interpolate = true;
  Trajectory truth = at({0, 1, 5});
  truth[1].world_from_camera.rotation = so3_exp({0, 0.8, 0});
  const auto pairs = associate(at({-0.1, 0.25, 1, 3, 5.1}), truth, options);
  EXPECT_THAT(truth_times(pairs), testing::ElementsAre(0.25, 1))
      << "no pair outside and none in the gap of 4 s";
  EXPECT_NEAR((so3_log(pairs[0].truth.rotation) - Eigen::Vector3d(0, 0.2, 0)).norm(), 0, 1e-12);
}

TEST(Association, ByIndexNeedsAsManyOfBoth) {
  AssociationOptions options;
  options.by_index = true;
  EXPECT_EQ(associate(at({0, 1, 2}), at({7, 8, 9}), options).size(), 3u);
  EXPECT_THAT(message_of<InputError>([&] {
                associate(at({0, 1}), at({0, 1, 2}), options);
              }),
              testing::AllOf(HasSubstr("2 poses"), HasSubstr("3")));
}

TEST(Association, RefusesWhatIsNotFinite) {
  Trajectory bad = at({0, 1, 2});
  bad[1].world_from_camera.translation.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(message_of<InputError>([&] {
                associate(bad, at({0, 1, 2}), {});
              }),
              testing::AllOf(HasSubstr("pose 2"), HasSubstr("estimate"), HasSubstr("not finite")));
  EXPECT_THAT(message_of<InputError>([&] { associate(at({0, 1, 2}), bad, {}); }), HasSubstr("ground truth"));
}

TEST(Association, RefusesTimesThatGoBackAndEmptyTrajectories) {
  EXPECT_THAT(message_of<InputError>([&] {
                associate(at({0, 2, 1}), at({0, 1, 2}), {});
              }),
              HasSubstr("back in time"));
  EXPECT_THAT(message_of<InputError>([&] { associate({}, at({0, 1, 2}), {}); }), HasSubstr("no pose"));
}

TEST(Association, RefusesANegativeTolerance) {
  AssociationOptions options;
  options.tolerance = -1;
  EXPECT_THAT(message_of<OptionError>([&] { associate(at({0}), at({0}), options); }), HasSubstr("tolerance"));
}

TEST(Association, PathLengths) {
  EXPECT_DOUBLE_EQ(path_length(at({0, 3, 4})), 4);
  const auto pairs = associate(at({0, 3, 4}), at({0, 3.01, 4}), {});
  EXPECT_DOUBLE_EQ(estimate_path_length(pairs), 4);
  EXPECT_DOUBLE_EQ(truth_path_length(pairs), 3.01 + 0.99);
}

}  // namespace
}  // namespace spslam
