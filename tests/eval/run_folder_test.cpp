// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/eval/run_folder.h"

#include <gmock/gmock.h>

#include <cmath>

#include "base/temporary_folder.h"
#include "eval/synthetic.h"

namespace spslam {
namespace {

using testing::HasSubstr;
using testing_eval::message_of;

TEST(RunFolder, FramesCsvIsReadByTheNamesOfItsColumns) {
  const auto frames = parse_frames_csv(
      "frame,timestamp,state,reason,near,far,keyframe\n"
      "0,1.5,initializing,\"first, of all\",10,20,1\n"
      "1,1.6,tracking,,12,,\n",
      "frames.csv");
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].timestamp, 1.5);
  EXPECT_EQ(frames[0].state, "initializing");
  EXPECT_EQ(frames[0].near, 10);
  EXPECT_EQ(frames[0].far, 20) << "a comma in quotes is no separator";
  EXPECT_TRUE(frames[0].keyframe);
  EXPECT_FALSE(frames[1].keyframe);
  EXPECT_TRUE(std::isnan(frames[1].far));
}

TEST(RunFolder, FramesCsvSaysWhatIsWrong) {
  EXPECT_THAT(message_of<InputError>([] { parse_frames_csv("frame,state\n0,lost\n", "f.csv"); }),
              HasSubstr("timestamp"));
  EXPECT_THAT(message_of<InputError>([] { parse_frames_csv("timestamp\nsoon\n", "f.csv"); }),
              HasSubstr("f.csv:2"));
  EXPECT_TRUE(parse_frames_csv("", "f.csv").empty());
}

TEST(RunFolder, TimingOfEitherShape) {
  const char* flat = R"({"features": {"mean": 1.5, "p50": 1.25, "p95": 2, "max": 9}, "peak_rss_mb": 80.5})";
  const char* nested =
      R"({"stages": {"features": {"mean_ms": 1.5, "p50_ms": 1.25, "p95_ms": 2, "max_ms": 9}}, "peak_rss_mb": 80.5})";
  for (const char* text : {flat, nested}) {
    ReportInput report;
    parse_timing_json(text, "timing.json", report);
    ASSERT_EQ(report.timing.size(), 1u) << text;
    EXPECT_EQ(report.timing[0].name, "features");
    EXPECT_EQ(report.timing[0].p50, 1.25);
    EXPECT_EQ(report.timing[0].maximum, 9);
    EXPECT_THAT(report.facts, testing::ElementsAre(testing::Pair("peak_rss_mb", "80.5")));
  }
  ReportInput report;
  EXPECT_THAT(message_of<InputError>([&] { parse_timing_json("{\"a\": ", "timing.json", report); }),
              HasSubstr("timing.json"));
}

class RunFolderOnDisk : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const { parent_.write("bank/" + name, text); }

  const test::TemporaryFolder parent_;
  const std::filesystem::path folder_ = parent_.path() / "bank";
};

TEST_F(RunFolderOnDisk, ReadsWhatIsThere) {
  write("trajectory_tum.txt", format_tum(testing_eval::straight_line(5)));
  write("frames.csv", "timestamp,state,near,far\n0,tracking,5,6\n");
  write("config.yaml", "preset: paper\n");
  write("samples/b.png", "B");
  write("samples/a.png", "A");
  const ReportInput report = read_run_folder(folder_);
  EXPECT_EQ(report.title, "bank");
  EXPECT_EQ(report.estimate.size(), 5u);
  EXPECT_EQ(report.frames.size(), 1u);
  EXPECT_EQ(report.config, "preset: paper\n");
  ASSERT_EQ(report.images.size(), 2u);
  EXPECT_EQ(report.images[0].caption, "a");
  EXPECT_EQ(report.images[1].png, "B");
}

TEST_F(RunFolderOnDisk, NeedsATrajectoryOrFrames) {
  write("config.yaml", "preset: paper\n");
  EXPECT_THAT(message_of<InputError>([&] { read_run_folder(folder_); }), HasSubstr("trajectory_tum.txt"));
  EXPECT_THAT(message_of<InputError>([&] { read_run_folder(folder_ / "none"); }), HasSubstr("not a folder"));
}

TEST_F(RunFolderOnDisk, WhatIsMissingOrCutOffIsLeftOutAndNamed) {
  const Trajectory truth = testing_eval::straight_line(5);
  write("trajectory_tum.txt", format_tum(truth));
  write("frames.csv", "timestamp,state,near,far\n0,tracking,5,6\n0.1,trac");
  write("metrics.json", json_report(evaluate(truth, truth, {})).substr(0, 200));
  const ReportInput report = read_run_folder(folder_);
  EXPECT_EQ(report.estimate.size(), 5u);
  EXPECT_TRUE(report.frames.empty());
  EXPECT_FALSE(report.evaluation);
  EXPECT_THAT(report.notes,
              testing::ElementsAre(HasSubstr("frames.csv:3"), HasSubstr("timing.json is not there"),
                                   HasSubstr("metrics.json")));
  EXPECT_THAT(html_report(report), HasSubstr("timing.json is not there"));
  write("metrics.json", json_report(evaluate(truth, truth, {})));
  EXPECT_TRUE(read_run_folder(folder_).evaluation);
  write("trajectory_tum.txt", "0.1 0 0");
  write("frames.csv", "timestamp,state,near,far\n0,tracking,5,6\n");
  EXPECT_EQ(read_run_folder(folder_).frames.size(), 1u);
}

}  // namespace
}  // namespace spslam
