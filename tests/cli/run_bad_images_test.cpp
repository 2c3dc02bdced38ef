// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// What `spslam run` says of frames that cannot be used, and of runs that come to nothing by them.

#include <gmock/gmock.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "cli/run_fixture.h"

namespace spslam {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

struct BadImage {
  const char* name;
  std::function<void(const fs::path&)> break_it;
};

void PrintTo(const BadImage& row, std::ostream* out) {
  *out << row.name;
}

class RunBadImage : public Run, public testing::WithParamInterface<BadImage> {};

TEST_P(RunBadImage, InTheMiddleCoastsAndTracksAgain) {
  const std::string dataset = own_scene();
  GetParam().break_it(fs::path(dataset) / "image_1" / test::scene_image_name(6));
  const ProcessResult done = run({}, dataset);
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("15 tracking, 1 coasting"),
                              HasSubstr("not tracked  1 x right image 000006.png"),
                              testing::Not(HasSubstr("stretches"))));
  ASSERT_EQ(frames().size(), 16U);
  for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(frames()[i].state, i == 6 ? "coasting" : "tracking") << i;
  EXPECT_EQ(lines("trajectory_kitti.txt"), 16U);
  EXPECT_THAT(result("frames.csv"), HasSubstr("right image 000006.png"));
  EXPECT_THAT(result("log.txt"), HasSubstr("frame 6: coasting: right image 000006.png"));
  EXPECT_LT(nlohmann::json::parse(result("metrics.json"))["ate_m"]["rmse"], 0.02);
}

INSTANTIATE_TEST_SUITE_P(
    Cli, RunBadImage,
    testing::Values(BadImage{"missing", [](const fs::path& image) { fs::remove(image); }},
                    BadImage{"empty", [](const fs::path& image) { fs::resize_file(image, 0); }},
                    BadImage{"truncated",
                             [](const fs::path& image) { fs::resize_file(image, fs::file_size(image) / 2); }},
                    BadImage{"one_pixel",
                             [](const fs::path& image) {
                               cv::imwrite(image.string(), cv::Mat::zeros(1, 1, CV_8UC1));
                             }}),
    [](const testing::TestParamInfo<BadImage>& row) { return std::string(row.param.name); });

void blacken(const std::string& dataset, int first, int behind) {
  for (int i = first; i < behind; ++i)
    for (const char* eye : {"image_0", "image_1"})
      cv::imwrite((fs::path(dataset) / eye / test::scene_image_name(i)).string(),
                  cv::Mat::zeros(200, 320, CV_8UC1));
}

TEST_F(Run, SaysWhyAndHowOftenNothingWasTracked) {
  const std::string dataset = own_scene();
  blacken(dataset, 5, 10);
  fs::resize_file(fs::path(dataset) / "image_0" / test::scene_image_name(12), 0);
  const ProcessResult done = run({"--rate", "2"}, dataset);
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr(" lost"), HasSubstr("not tracked  "), HasSubstr(" in 2 stretches")));
}

TEST_F(Run, NothingTrackedIsAFailureWithResults) {
  const std::string dataset = own_scene();
  blacken(dataset, 0, test::kSceneFrames);
  const ProcessResult done = run({"--quiet"}, dataset);
  EXPECT_EQ(done.exit_code, 1);
  EXPECT_THAT(done.err, AllOf(HasSubstr("none of the 16 frames could be tracked"),
                              HasSubstr("16 of them because: "), HasSubstr("frames.csv")));
  EXPECT_EQ(frames().size(), 16U);
  EXPECT_FALSE(fs::exists(out() + "/metrics.json"));
  EXPECT_THAT(run({"--overwrite"}, dataset).out,
              AllOf(HasSubstr("16 initializing"), HasSubstr("not tracked  16 x ")));
}

}  // namespace
}  // namespace spslam
