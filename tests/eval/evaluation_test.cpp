// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/eval/evaluation.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "eval/synthetic.h"

namespace spslam {
namespace {

using testing::HasSubstr;
using testing_eval::figure_of_eight;
using testing_eval::message_of;
using testing_eval::some_motion;
using testing_eval::straight_line;
using testing_eval::transformed;

TEST(Evaluation, KnownNoiseGivesItsOwnRmse) {
  const Trajectory truth = figure_of_eight(4000);
  Trajectory estimate = transformed(truth, some_motion());
  Random random(11);
  const double sigma = 0.05;
  for (StampedPose& pose : estimate)
    for (int k = 0; k < 3; ++k) pose.world_from_camera.translation[k] += sigma * random.normal();
  const Evaluation e = evaluate(estimate, truth, {});
  EXPECT_EQ(e.poses.size(), truth.size());
  EXPECT_NEAR(e.ate.position.rmse, sigma * std::sqrt(3), 0.03 * sigma);
  EXPECT_NEAR(e.ate.position.mean, sigma * std::sqrt(8 / M_PI), 0.03 * sigma) << "Maxwell's distribution";
  EXPECT_NEAR(e.rpe_per_frame.translation.rmse, sigma * std::sqrt(6), 0.05 * sigma);
}

TEST(Evaluation, KnownScale) {
  const Trajectory truth = figure_of_eight(500), estimate = transformed(truth, some_motion(), 1 / 1.31);
  const Evaluation rigid = evaluate(estimate, truth, {});
  EXPECT_NEAR(rigid.scale_ratio, 1.31, 1e-9);
  EXPECT_GT(rigid.ate.position.rmse, 1);
  EXPECT_NEAR(rigid.estimate_length * 1.31, rigid.truth_length, 1e-9);
  EvaluationOptions options;
  options.align = AlignMode::kSim3;
  const Evaluation similar = evaluate(estimate, truth, options);
  EXPECT_LT(similar.ate.position.rmse, 1e-9);
  EXPECT_LT(similar.rpe_per_second.translation.rmse, 1e-9) << "the scale goes into the relative error";
}

TEST(Evaluation, WithoutAlignmentTheOffsetStays) {
  EvaluationOptions options;
  options.align = AlignMode::kNone;
  const Trajectory truth = figure_of_eight(50);
  const Evaluation e = evaluate(transformed(truth, {Eigen::Matrix3d::Identity(), {0, 2, 0}}), truth, options);
  EXPECT_NEAR(e.ate.position.rmse, 2, 1e-12);
}

TEST(Evaluation, AStraightRunSaysThatItIsDegenerate) {
  const Trajectory truth = straight_line(100);
  EXPECT_THAT(evaluate(transformed(truth, some_motion()), truth, {}).notes,
              testing::Contains(HasSubstr("degenerate")));
}

TEST(Evaluation, TooFewPosesSayWhy) {
  const Trajectory truth = straight_line(100);
  Trajectory later = truth;
  for (StampedPose& pose : later) pose.timestamp += 1e9;
  const std::string message = message_of<InputError>([&] { evaluate(later, truth, {}); });
  EXPECT_THAT(message,
              testing::AllOf(HasSubstr("only 0 poses"), HasSubstr("one clock"), HasSubstr("1000000009.900")));
  EXPECT_THAT(message_of<InputError>([&] { evaluate(straight_line(2), truth, {}); }),
              HasSubstr("only 2 poses"));
}

TEST(Evaluation, ATruthOfAnotherSequenceIsWarnedOf) {
  const Trajectory truth = figure_of_eight(400);
  EXPECT_THAT(evaluate(transformed(truth, some_motion(), 1 / 1.9), truth, {}).warnings, testing::IsEmpty());
  const Evaluation small = evaluate(transformed(truth, some_motion(), 1 / 5.9), truth, {});
  EXPECT_THAT(small.warnings, testing::ElementsAre(HasSubstr("5.9 times")));
  EXPECT_THAT(brief_report(small), HasSubstr("WARNING: the estimate"));
  EXPECT_THAT(json_report(small), HasSubstr("5.9 times"));
  Trajectory later = truth;
  for (StampedPose& pose : later) pose.timestamp += 30;
  EXPECT_THAT(evaluate(later, truth, {}).warnings, testing::Contains(HasSubstr("only 100 of 400")));
  // A part of the sequence, and a truth that is slower than the camera or begins later, are as they should
  // be.
  const Trajectory part(truth.begin() + 100, truth.begin() + 200);
  EXPECT_THAT(evaluate(part, truth, {}).warnings, testing::IsEmpty());
  EXPECT_THAT(evaluate(truth, part, {}).warnings, testing::IsEmpty());
  Trajectory slow;
  for (std::size_t i = 0; i < truth.size(); i += 5) slow.push_back(truth[i]);
  EXPECT_THAT(evaluate(truth, slow, {}).warnings, testing::IsEmpty());
}

TEST(Evaluation, StandingStillHasNoScaleToWarnOf) {
  Trajectory truth = straight_line(50), estimate = truth;
  Random random(3);
  for (std::size_t i = 0; i < truth.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      truth[i].world_from_camera.translation[k] = 1e-3 * random.normal();
      estimate[i].world_from_camera.translation[k] = 1e-2 * random.normal();
    }
  EXPECT_THAT(evaluate(estimate, truth, {}).warnings, testing::IsEmpty());
}

TEST(Evaluation, JsonIsReadAgain) {
  const Trajectory truth = figure_of_eight(2000), estimate = transformed(truth, some_motion(), 0.3);
  Evaluation e = evaluate(estimate, truth, {});
  ASSERT_GT(e.kitti.count, 0u);
  const Evaluation again = parse_json_report(json_report(e), "metrics.json");
  e.kitti.lengths.clear();
  e.truth_from_estimate = {};
  EXPECT_EQ(json_report(again), json_report(e));
  for (const char* text : {"", "{}", "[1, 2]", "{\"align\": \"se4\"}"})
    EXPECT_THAT(message_of<InputError>([&] { parse_json_report(text, "metrics.json"); }),
                HasSubstr("metrics.json"));
}

TEST(Evaluation, ByIndexHasNoErrorPerSecond) {
  EvaluationOptions options;
  options.association.by_index = true;
  const Evaluation e = evaluate(straight_line(10), straight_line(10), options);
  EXPECT_EQ(e.rpe_per_second.translation.count, 0u);
  EXPECT_EQ(e.rpe_per_frame.translation.count, 9u);
  EXPECT_EQ(e.duration, 0);
}

TEST(Evaluation, JsonHasEveryFigureAndNullForWhatDoesNotExist) {
  const Trajectory truth = figure_of_eight(200);
  const auto json =
      nlohmann::json::parse(json_report(evaluate(transformed(truth, some_motion(), 0.5), truth, {})));
  EXPECT_EQ(json["associated_poses"], 200);
  EXPECT_EQ(json["align"], "se3");
  EXPECT_NEAR(json["scale_ratio"].get<double>(), 2, 1e-9);
  for (const char* key : {"ate_m", "rpe_m_per_s", "rpe_deg_per_s", "rpe_m_per_frame", "rpe_deg_per_frame"})
    for (const char* figure : {"mean", "max", "rmse", "sd", "median"})
      EXPECT_TRUE(json[key][figure].is_number()) << key << figure;
  EXPECT_TRUE(json["kitti"]["t_rel_percent"].is_null()) << "the path is shorter than 100 m";
  EXPECT_EQ(json["kitti"]["count"], 0);
}

TEST(Evaluation, TextNamesEveryTable) {
  const Trajectory truth = figure_of_eight(200);
  const std::string text = brief_report(evaluate(truth, truth, {}));
  for (const char* word :
       {"associated   200 of 200", "ATE [m]", "RPE per second [m/s]", "RPE per second [deg/s]",
        "RPE per frame [m]", "RPE per frame [deg]", "scale ratio 1.00000", "S.D."})
    EXPECT_THAT(text, HasSubstr(word));
}

}  // namespace
}  // namespace spslam
