// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include <gmock/gmock.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "cli/process.h"

namespace spslam {
namespace {

using testing::HasSubstr;

// A bright sky over dark land.
std::string write_scene(const TemporaryFolder& folder, const std::string& name) {
  cv::Mat image(180, 320, CV_8UC1, cv::Scalar(40));
  image.rowRange(0, 60).setTo(210);
  const std::string path = folder.path(name);
  std::filesystem::create_directories(std::filesystem::path(path).parent_path());
  cv::imwrite(path, image);
  return path;
}

TEST(Segment, WritesMaskOverlayAndElements) {
  const TemporaryFolder folder;
  const std::string image = write_scene(folder, "a.png"), output = folder.path("out");
  const ProcessResult result = run_spslam({"segment", image, "--output", output, "--elements"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("a.png: threshold"));
  const cv::Mat mask = cv::imread(output + "/a_mask.png", cv::IMREAD_UNCHANGED);
  ASSERT_EQ(mask.size(), cv::Size(320, 180));
  EXPECT_EQ(mask.type(), CV_8UC1);
  EXPECT_EQ(mask.at<std::uint8_t>(10, 160), 255);
  EXPECT_EQ(mask.at<std::uint8_t>(68, 160), 255);  // grown by 12 px at this width
  EXPECT_EQ(mask.at<std::uint8_t>(78, 160), 0);
  EXPECT_EQ(cv::imread(output + "/a_overlay.png").size(), cv::Size(320, 180));
  EXPECT_EQ(cv::imread(output + "/a_elements.png").size(), cv::Size(320, 5 * 180));
}

TEST(Segment, OverwritesNoneOfTwoImagesOfOneName) {
  const TemporaryFolder folder;
  const std::string first = write_scene(folder, "l/a.png"), second = write_scene(folder, "r/a.png");
  EXPECT_EQ(run_spslam({"segment", first, second, "--output", folder.path("out")}).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder.path("out/a_mask.png")));
  EXPECT_TRUE(std::filesystem::exists(folder.path("out/a_2_mask.png")));
}

TEST(Segment, GoesOnAfterABadImage) {
  const TemporaryFolder folder;
  const std::string bad = folder.write("bad.png", "no image"), good = write_scene(folder, "good.png");
  const ProcessResult result = run_spslam({"segment", bad, good, "--output", folder.path("out")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("bad.png"));
  EXPECT_TRUE(std::filesystem::exists(folder.path("out/good_mask.png")));
}

TEST(Segment, NamesTheNearestOption) {
  const TemporaryFolder folder;
  const std::string image = write_scene(folder, "a.png");
  const ProcessResult unknown =
      run_spslam({"segment", image, "--output", folder.path("out"), "--set", "windw=3"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("window"));
  EXPECT_EQ(
      run_spslam({"segment", image, "--output", folder.path("out"), "--set", "element=disc15"}).exit_code, 0);
  EXPECT_EQ(run_spslam({"segment", image, "--output", folder.path("out"), "--set", "window=0"}).exit_code, 2);
  EXPECT_EQ(
      run_spslam({"segment", image, "--output", folder.path("out"), "--set", "tracker.segmentation.window=5"})
          .exit_code,
      0)
      << "as run calls it";
}

TEST(Segment, SaysIfTheOutputCannotBeWritten) {
  const TemporaryFolder folder;
  const std::string image = write_scene(folder, "a.png"), file = folder.write("file", "");
  const ProcessResult result = run_spslam({"segment", image, "--output", file + "/out"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("cannot be made"));
}

}  // namespace
}  // namespace spslam
