// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include <gmock/gmock.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "cli/process.h"

namespace spslam {
namespace {

using testing::HasSubstr;

// Twelve pairs, the second six of the same places as the first: boxes that differ from place to place.
std::string write_sequence(const TemporaryFolder& folder) {
  for (const char* eye : {"image_0", "image_1"})
    std::filesystem::create_directories(folder.path("run/") + eye);
  std::string times, poses;
  for (int i = 0; i < 12; ++i) {
    cv::Mat image(180, 320, CV_8UC1, cv::Scalar(120));
    cv::RNG random(static_cast<std::uint64_t>(100 + i % 6));
    for (int box = 0; box < 80; ++box)
      cv::rectangle(image, {random.uniform(0, 320), random.uniform(0, 180)},
                    {random.uniform(0, 320), random.uniform(0, 180)}, cv::Scalar(random.uniform(0, 255)), 2);
    for (const char* eye : {"/image_0/", "/image_1/"})
      cv::imwrite(folder.path("run") + eye + (i < 10 ? "00000" : "0000") + std::to_string(i) + ".png", image);
    times += std::to_string(3 * i) + "\n";
    poses += "1 0 0 0 0 1 0 0 0 0 1 " + std::to_string(10 * (i % 6)) + "\n";
  }
  folder.write("run/times.txt", times);
  folder.write("run/poses.txt", poses);
  folder.write("run/calib.txt", "P0: 300 0 160 0 0 300 90 0 0 0 1 0\nP1: 300 0 160 -30 0 300 90 0 0 0 1 0\n");
  return folder.path("run");
}

TEST(VocabularyCommand, TrainsConvertsDescribesAndMeasures) {
  const TemporaryFolder folder;
  const std::string run = write_sequence(folder), binary = folder.path("a.spv"), text = folder.path("a.txt"),
                    again = folder.path("b.spv");
  ProcessResult result =
      run_spslam({"vocabulary", "train", run, "--output", binary, "--branching", "6", "--levels", "3"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("of 12 images"));
  result = run_spslam({"vocabulary", "info", binary});
  EXPECT_THAT(result.out, HasSubstr("3 levels of at most 6 branches"));
  EXPECT_EQ(run_spslam({"vocabulary", "convert", binary, text}).exit_code, 0);
  EXPECT_EQ(run_spslam({"vocabulary", "convert", text, again}).exit_code, 0);
  EXPECT_EQ(std::filesystem::file_size(again), std::filesystem::file_size(binary));
  for (const std::string& vocabulary : {binary, text, std::string("built-in")}) {
    result = run_spslam({"vocabulary", "recall", vocabulary, run});
    EXPECT_THAT(result.out, HasSubstr("6 revisits; best answer right 100.0 %")) << vocabulary << result.err;
  }
  result = run_spslam({"vocabulary", "recall", binary, run, "--map", run, "--every", "4"});
  EXPECT_THAT(result.out, HasSubstr("3 queries, 3 revisits; best answer right 100.0 %"));
}

TEST(VocabularyCommand, ARunUsesTheOneItIsGiven) {
  const TemporaryFolder folder;
  const std::string run = write_sequence(folder), own = folder.path("own.spv"), out = folder.path("result");
  ASSERT_EQ(run_spslam({"vocabulary", "train", run, "--output", own, "--branching", "6", "--levels", "3"})
                .exit_code,
            0);
  run_spslam({"run", run, "--output", out, "--vocabulary", own, "--samples", "0", "--quiet"});
  EXPECT_THAT(read_file(out + "/config.yaml"), HasSubstr("# vocabulary: " + own));
  const ProcessResult result =
      run_spslam({"run", run, "--output", folder.path("other"), "--vocabulary", folder.path("none.spv")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("none.spv"));
  EXPECT_FALSE(std::filesystem::exists(folder.path("other")));  // before anything is begun
}

TEST(VocabularyCommand, SaysWhatIsWrong) {
  const TemporaryFolder folder;
  const std::string foreign = folder.write("foreign.spv", "not a vocabulary");
  const auto said = [](const std::vector<std::string>& arguments) {
    const ProcessResult result = run_spslam(arguments);
    EXPECT_NE(result.exit_code, 0);
    return result.err;
  };
  EXPECT_THAT(said({"vocabulary", "info", foreign}),
              HasSubstr("foreign.spv: is not a vocabulary of SP-SLAM"));
  EXPECT_THAT(said({"vocabulary", "info", folder.path("none.spv")}), HasSubstr("does not exist"));
  EXPECT_THAT(said({"vocabulary", "convert", "built-in", folder.path("a.spv")}), HasSubstr("ends in .txt"));
  EXPECT_THAT(said({"vocabulary", "train", folder.path("none"), "--output", folder.path("a.spv")}),
              HasSubstr("none"));
  EXPECT_THAT(said({"vocabulary", "train", folder.path("none"), "--output", "x", "--levels", "11"}),
              HasSubstr("levels"));
  EXPECT_THAT(said({"vocabulary"}), HasSubstr("subcommand"));
}

}  // namespace
}  // namespace spslam
