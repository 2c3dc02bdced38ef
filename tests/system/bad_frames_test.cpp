// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The table of bad input, of what a caller may hand to Slam::track(): a frame's status and reason, never an
// exception, and the frames after it are tracked again.

#include <gmock/gmock.h>

#include "system/scene_run.h"

namespace spslam {
namespace {

using namespace test;
using testing::Each;
using testing::HasSubstr;

cv::Mat noise_picture(std::uint64_t seed) {
  Random random(seed);
  cv::Mat image(scene_rig().height, scene_rig().width, CV_8UC1);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x)
      image.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(random.below(256));
  return image;
}

cv::Mat black_picture() {
  return cv::Mat::zeros(scene_rig().height, scene_rig().width, CV_8UC1);
}

struct BadPair {
  const char* name;
  std::function<void(StereoFrame&)> break_it;
  std::string reason;  // part of it; "" for any
};

void PrintTo(const BadPair& row, std::ostream* out) {
  *out << row.name;
}

class BadPairInTheMiddle : public testing::TestWithParam<BadPair> {};

constexpr std::size_t kBad = 7;

TEST_P(BadPairInTheMiddle, CoastsAndTracksAgain) {
  std::vector<StereoFrame> pairs = scene_pairs();
  GetParam().break_it(pairs[kBad]);
  const SceneRun run = run_pairs(pairs, sequential_options());
  for (std::size_t i = 0; i < pairs.size(); ++i)
    EXPECT_EQ(run.results[i].status, i == kBad ? TrackStatus::kCoasting : TrackStatus::kTracking) << i;
  const TrackResult& bad = run.results[kBad];
  EXPECT_NE(bad.reason, "");
  EXPECT_THAT(bad.reason, HasSubstr(GetParam().reason));
  EXPECT_GT(bad.covariance.trace(), run.results[kBad - 1].covariance.trace());
  EXPECT_TRUE(bad.world_from_camera.is_finite());
  ASSERT_EQ(run.trajectory.size(), pairs.size()) << "the frame has a pose all the same";
  EXPECT_LT(evaluate_scene(run.trajectory).ate.position.rmse, 0.02);
}

INSTANTIATE_TEST_SUITE_P(
    System, BadPairInTheMiddle,
    testing::Values(
        BadPair{"unreadable",
                [](StereoFrame& pair) {
                  pair.left = pair.right = cv::Mat();
                  pair.problem = "left image 000007.png: PNG is truncated";
                },
                "PNG is truncated"},
        BadPair{"empty", [](StereoFrame& pair) { pair.right = cv::Mat(); }, "right image is empty"},
        BadPair{"one_pixel", [](StereoFrame& pair) { pair.left = cv::Mat::zeros(1, 1, CV_8UC1); },
                "1 x 1 px"},
        BadPair{"eyes_of_different_size",
                [](StereoFrame& pair) { pair.right = pair.right.rowRange(0, 100).clone(); }, "320 x 100 px"},
        BadPair{"sixteen_bit", [](StereoFrame& pair) { pair.left.convertTo(pair.left, CV_16UC1, 256); },
                "not 8 bit grey"},
        BadPair{"black", [](StereoFrame& pair) { pair.left = pair.right = black_picture(); }, ""},
        BadPair{"noise",
                [](StereoFrame& pair) {
                  pair.left = noise_picture(1);
                  pair.right = noise_picture(2);
                },
                ""},
        BadPair{"noise_that_matches", [](StereoFrame& pair) { pair.left = pair.right = noise_picture(3); },
                ""}),
    [](const testing::TestParamInfo<BadPair>& row) { return std::string(row.param.name); });

TEST(BadFrames, LastsTooLongIsLostAndBeginsAnew) {
  std::vector<StereoFrame> pairs = scene_pairs();
  SlamOptions options = sequential_options();
  options.tracker.state.coast_time = 2.5 * kFrameTime;
  for (std::size_t i = 6; i < 10; ++i) pairs[i].left = pairs[i].right = black_picture();
  const SceneRun run = run_pairs(pairs, options);
  EXPECT_EQ(run.results[6].status, TrackStatus::kCoasting);
  EXPECT_EQ(run.results[7].status, TrackStatus::kCoasting);
  EXPECT_LT(run.results[6].covariance.trace(), run.results[7].covariance.trace()) << "the covariance grows";
  EXPECT_EQ(run.results[8].status, TrackStatus::kLost);
  EXPECT_EQ(run.results[9].status, TrackStatus::kLost);
  EXPECT_EQ(run.results[10].status, TrackStatus::kTracking);
  EXPECT_EQ(run.results.back().status, TrackStatus::kTracking);
  EXPECT_EQ(run.trajectory.size(), pairs.size());
}

TEST(BadFrames, UnusableBeginning) {
  std::vector<StereoFrame> pairs = scene_pairs();
  pairs[0].problem = "left image 000000.png: file is missing";
  pairs[1].left = pairs[1].right = black_picture();
  const SceneRun run = run_pairs(pairs, sequential_options());
  EXPECT_EQ(run.results[0].status, TrackStatus::kInitializing);
  EXPECT_EQ(run.results[1].status, TrackStatus::kInitializing);
  EXPECT_NE(run.results[1].reason, "");
  EXPECT_EQ(run.results[2].status, TrackStatus::kTracking);
  EXPECT_EQ(run.trajectory.size(), pairs.size() - 2) << "a pose for each frame since the first usable one";
}

TEST(BadFrames, NothingButBlack) {
  std::vector<StereoFrame> pairs = scene_pairs();
  for (StereoFrame& pair : pairs) pair.left = pair.right = black_picture();
  const SceneRun run = run_pairs(pairs, sequential_options());
  EXPECT_THAT(statuses(run), Each(TrackStatus::kInitializing));
  EXPECT_TRUE(run.trajectory.empty());
}

TEST(BadFrames, CalibrationOfAnotherImageSize) {
  StereoRig rig = scene_rig();
  rig.width = 640, rig.height = 400, rig.cx = 319.5, rig.cy = 199.5;
  const SceneRun run = run_pairs(scene_pairs(), sequential_options(), rig);
  EXPECT_THAT(statuses(run), Each(TrackStatus::kInitializing));
  for (const TrackResult& result : run.results)
    EXPECT_THAT(result.reason, testing::AllOf(HasSubstr("320 x 200"), HasSubstr("640 x 400")));
}

struct BadTime {
  const char* name;
  double time;  // of a copy of frame 7, given after it
};

void PrintTo(const BadTime& row, std::ostream* out) {
  *out << row.name;
}

class BadTimeInTheMiddle : public testing::TestWithParam<BadTime> {};

TEST_P(BadTimeInTheMiddle, LeavesTheFrameOutAndChangesNothing) {
  std::vector<StereoFrame> pairs = scene_pairs();
  StereoFrame again = pairs[kBad];
  again.timestamp = GetParam().time;
  pairs.insert(pairs.begin() + kBad + 1, again);
  const SceneRun run = run_pairs(pairs, sequential_options());
  EXPECT_FALSE(run.results[kBad + 1].frame.valid());
  EXPECT_THAT(run.results[kBad + 1].reason, HasSubstr("left out"));
  // What is known stays known, but nothing was measured.
  EXPECT_EQ(run.results[kBad + 1].status, TrackStatus::kCoasting);
  EXPECT_EQ(run.results[kBad + 1].covariance, run.results[kBad].covariance);
  EXPECT_EQ(run.results[kBad + 1].world_from_camera.translation,
            run.results[kBad].world_from_camera.translation);
  EXPECT_EQ(run.results[kBad + 2].status, TrackStatus::kTracking);
  const SceneRun good = run_pairs(scene_pairs(), sequential_options());
  EXPECT_EQ(format_tum(run.trajectory), format_tum(good.trajectory));
}

INSTANTIATE_TEST_SUITE_P(System, BadTimeInTheMiddle,
                         testing::Values(BadTime{"equal", kFrameTime* kBad},
                                         BadTime{"decreasing", kFrameTime* kBad - 0.05},
                                         BadTime{"negative", -1}, BadTime{"not_a_number", std::nan("")},
                                         BadTime{"infinite", std::numeric_limits<double>::infinity()}),
                         [](const testing::TestParamInfo<BadTime>& row) {
                           return std::string(row.param.name);
                         });

TEST(BadFrames, FirstTimeIsNotANumber) {
  std::vector<StereoFrame> pairs = scene_pairs();
  pairs[0].timestamp = std::nan("");
  const SceneRun run = run_pairs(pairs, sequential_options());
  EXPECT_THAT(run.results[0].reason, HasSubstr("left out"));
  EXPECT_EQ(run.results[1].status, TrackStatus::kTracking);
}

}  // namespace
}  // namespace spslam
