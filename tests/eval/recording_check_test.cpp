// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/eval/recording_check.h"

#include <gmock/gmock.h>

#include "system/synthetic_scene.h"

namespace spslam {
namespace {

using testing::HasSubstr;

// The harbour passed in a swell, so that each frame has a pitch of its own.
SE3 pose_at(double frame) {
  Vector6d twist;
  twist << 0, 0, 0.1 * frame, 0.06 * std::sin(0.35 * frame), 0, 0.02 * std::sin(0.2 * frame);
  return SE3::exp(twist);
}

// The right eye is exposed `delay` frames after the left one.
StereoFrame pair_at(double frame, double delay) {
  const StereoRig rig = test::scene_rig();
  const SE3 right = pose_at(frame + delay) * SE3{Eigen::Matrix3d::Identity(), {rig.baseline, 0, 0}};
  return {test::kFrameTime * frame, test::render_eye(rig, pose_at(frame)), test::render_eye(rig, right), ""};
}

RecordingSample sample_with_delay(double delay) {
  RecordingSample sample;
  sample.rig = test::scene_rig();
  PairMatcher matcher;
  for (int i = 0; i < 40; ++i) sample.times.push_back(test::kFrameTime * i);
  for (const int i : {2, 9, 14, 21, 27, 33})
    sample.pairs.push_back(
        measure_pair(matcher, pair_at(i, delay), pair_at(i - 1, delay), pair_at(i + 1, delay)));
  return sample;
}

const Finding& find(const std::vector<Finding>& findings, const std::string& name) {
  for (const Finding& finding : findings)
    if (finding.name == name) return finding;
  throw std::runtime_error("no finding " + name);
}

TEST(RecordingCheck, SoundRecording) {
  const std::vector<Finding> findings = check_recording(sample_with_delay(0));
  EXPECT_EQ(findings.size(), 10U);
  for (const Finding& finding : findings)
    EXPECT_EQ(finding.judgement, Judgement::kOk)
        << finding.name << ": " << finding.text << " -> " << finding.advice;
  EXPECT_EQ(worst_judgement(findings), Judgement::kOk);
  EXPECT_THAT(find(findings, "instants").text, HasSubstr("scatter"));
}

TEST(RecordingCheck, AnEyeShiftedByAFrameIsTheOnlyFault) {
  for (const int delay : {-1, 1}) {
    const std::vector<Finding> findings = check_recording(sample_with_delay(delay));
    for (const Finding& finding : findings)
      EXPECT_EQ(finding.judgement, finding.name == "instants" ? Judgement::kBad : Judgement::kOk)
          << finding.name << ": " << finding.text << " -> " << finding.advice;
    EXPECT_THAT(find(findings, "instants").advice,
                HasSubstr(delay < 0 ? "left image before" : "left image after"));
  }
}

TEST(RecordingCheck, EyesExposedApartByPartOfAFrame) {
  const RecordingSample sample = sample_with_delay(0.4);
  const Instants instants = measure_instants(sample.pairs, {sample.rig.width, sample.rig.height});
  EXPECT_TRUE(instants.is_told);
  EXPECT_EQ(instants.fitting, 0);
  EXPECT_NEAR(instants.delay, 0.4, 0.05);
  EXPECT_LT(instants.delay_sigma, 0.05);
  EXPECT_EQ(find(check_recording(sample), "instants").judgement, Judgement::kWarning);
}

TEST(RecordingCheck, ACameraAtRestDoesNotTellInstants) {
  RecordingSample sample = sample_with_delay(0);
  for (SampledPair& pair : sample.pairs) pair.before = pair.after = pair.matches;
  const std::vector<Finding> findings = check_recording(sample);
  EXPECT_EQ(find(findings, "instants").judgement, Judgement::kOk);
  EXPECT_THAT(find(findings, "instants").text, HasSubstr("cannot be told"));
}

TEST(RecordingCheck, SwappedEyesAreTheOnlyFault) {
  RecordingSample sample = sample_with_delay(0);
  for (SampledPair& pair : sample.pairs)
    for (auto* matches : {&pair.matches, &pair.before, &pair.after})
      for (PairMatch& match : *matches) match.disparity = -match.disparity;
  const std::vector<Finding> findings = check_recording(sample);
  for (const Finding& finding : findings)
    EXPECT_EQ(finding.judgement, finding.name == "sign" ? Judgement::kBad : Judgement::kOk) << finding.name;
  EXPECT_THAT(find(findings, "sign").advice, HasSubstr("left and right seem to be swapped"));
}

TEST(RecordingCheck, Rows) {
  RowOffsets rows{.matches = 500, .spread = 0.1};
  EXPECT_EQ(judge_rows(rows, 0).judgement, Judgement::kOk);
  EXPECT_EQ(judge_rows(rows, 0.6).judgement, Judgement::kWarning) << "from pair to pair";
  rows.median = -0.35;
  EXPECT_EQ(judge_rows(rows, 0).judgement, Judgement::kWarning);
  EXPECT_THAT(judge_rows(rows, 0).advice, HasSubstr("1.5 px (tracker.follow.max_row_offset)"));
  rows.median = -1.1;
  EXPECT_EQ(judge_rows(rows, 0).judgement, Judgement::kBad);
  rows = {.matches = 500, .spread = 0.1, .worst_corner = -0.6, .corner_sigma = 0.01};
  EXPECT_EQ(judge_rows(rows, 0).judgement, Judgement::kWarning);
  rows.corner_sigma = 0.1;
  EXPECT_EQ(judge_rows(rows, 0).judgement, Judgement::kOk) << "a corner that nobody knows";
  rows = {.matches = 500, .spread = 1.2};
  EXPECT_EQ(judge_rows(rows, 0).judgement, Judgement::kBad);
  rows = {.matches = 20, .median = 5};
  EXPECT_EQ(judge_rows(rows, 0).judgement, Judgement::kOk) << "too few to tell";
}

TEST(RecordingCheck, DisparitiesBeyondInfinity) {
  RecordingSample sample = sample_with_delay(0);
  for (SampledPair& pair : sample.pairs)
    for (std::size_t i = 0; i < pair.matches.size(); i += 20) pair.matches[i].disparity = -0.8F;
  EXPECT_EQ(find(check_recording(sample), "infinity").judgement, Judgement::kWarning);
  for (SampledPair& pair : sample.pairs)
    for (std::size_t i = 0; i < pair.matches.size(); i += 10) pair.matches[i].disparity = -1.8F;
  EXPECT_EQ(find(check_recording(sample), "infinity").judgement, Judgement::kBad);
}

TEST(RecordingCheck, Times) {
  const std::vector<double> times = {0, 0.1, 0.2, 0.3, 0.6, 0.7, 0.72, 0.8, 0.9};
  const TimeSteps steps = measure_times(times);
  EXPECT_EQ(steps.intervals, 8);
  EXPECT_NEAR(steps.median, 0.1, 1e-9);
  EXPECT_NEAR(steps.longest, 0.3, 1e-9);
  EXPECT_EQ(steps.gaps, 1);
  EXPECT_EQ(steps.short_ones, 1);
  EXPECT_EQ(measure_times({}).intervals, 0);
}

TEST(RecordingCheck, Images) {
  cv::Mat image(100, 100, CV_8UC1, cv::Scalar(255));
  image.rowRange(0, 60).setTo(0);
  const ImageStatistics statistics = measure_image(image);
  EXPECT_DOUBLE_EQ(statistics.saturated, 0.4);
  EXPECT_DOUBLE_EQ(statistics.black, 0.6);
  EXPECT_NEAR(statistics.contrast, 255 * std::sqrt(0.24), 1e-6);
  RecordingSample sample = sample_with_delay(0);
  const auto images = [&] { return find(check_recording(sample), "images"); };
  for (SampledPair& pair : sample.pairs) pair.left_repeats = pair.right_repeats = true;
  EXPECT_EQ(images().judgement, Judgement::kWarning);
  for (SampledPair& pair : sample.pairs) pair.left_repeats = false;
  EXPECT_THAT(images().advice, HasSubstr("of one eye repeat"));
  EXPECT_EQ(images().judgement, Judgement::kBad);
}

TEST(RecordingCheck, TheSameImageForBothEyes) {
  const StereoFrame pair = pair_at(0, 0);
  PairMatcher matcher;
  RecordingSample sample;
  sample.rig = test::scene_rig();
  sample.pairs.push_back(measure_pair(matcher, {0, pair.left, pair.left, ""}));
  EXPECT_FALSE(sample.pairs[0].has_neighbours);
  const std::vector<Finding> findings = check_recording(sample);
  EXPECT_THAT(find(findings, "matches").advice, HasSubstr("the same images"));
  EXPECT_EQ(findings.size(), 5U) << "nothing of rows and disparities";
}

TEST(RecordingCheck, EyesOfTwoScenes) {
  StereoFrame pair = pair_at(0, 0);
  cv::flip(pair.right, pair.right, -1);
  PairMatcher matcher;
  RecordingSample sample;
  sample.rig = test::scene_rig();
  sample.pairs.push_back(measure_pair(matcher, pair));
  EXPECT_EQ(find(check_recording(sample), "matches").judgement, Judgement::kBad);
}

TEST(RecordingCheck, CalibrationOfAnotherSize) {
  RecordingSample sample;
  sample.rig = test::scene_rig();
  EXPECT_EQ(find(check_recording(sample), "calibration").judgement, Judgement::kOk);
  sample.rig.cx = 80;
  EXPECT_EQ(find(check_recording(sample), "calibration").judgement, Judgement::kWarning);
}

TEST(RecordingCheck, NoUsablePair) {
  RecordingSample sample;
  sample.rig = test::scene_rig();
  sample.unusable = 3;
  sample.first_problem = "left image 0.png: file is missing";
  const std::vector<Finding> findings = check_recording(sample);
  EXPECT_EQ(find(findings, "pairs").judgement, Judgement::kBad);
  EXPECT_THAT(find(findings, "pairs").advice, HasSubstr("0.png"));
}

}  // namespace
}  // namespace spslam
