// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include <gmock/gmock.h>

#include <filesystem>

#include "cli/process.h"

namespace spslam {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string way() {
  std::string text;
  for (int i = 0; i < 50; ++i) {
    const std::string at = std::to_string(0.1 * i);
    text += at + " " + std::to_string(0.001 * i * i) + " 0 " + at + " 0 0 0 1\n";
  }
  return text;
}

TEST(Report, MakesAPageOfARunsFolder) {
  const TemporaryFolder files;
  files.write("bank/trajectory_tum.txt", way());
  files.write("bank/frames.csv", "frame,timestamp,state,near,far\n0,0,tracking,10,20\n1,0.1,lost,0,0\n");
  files.write("bank/timing.json", R"({"stages": {"total": {"mean": 1, "p50": 2, "p95": 3, "max": 4.25}}})");
  const ProcessResult result = run_spslam(
      {"report", files.path("bank"), "--truth", files.write("truth.txt", way()), "--title", "A & B"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, files.path("bank/report.html") + "\n");
  const std::string page = read_file(files.path("bank/report.html"));
  EXPECT_THAT(page, AllOf(HasSubstr("A &amp; B"), HasSubstr("ATE [m]"), HasSubstr("4.25"), HasSubstr("lost"),
                          Not(HasSubstr("<script"))));
}

TEST(Report, WithoutTruthThereAreNoErrors) {
  const TemporaryFolder files;
  files.write("bank/trajectory_tum.txt", way());
  const ProcessResult result =
      run_spslam({"report", files.path("bank"), "--output", files.path("page.html")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(read_file(files.path("page.html")), AllOf(HasSubstr("bank"), Not(HasSubstr("ATE"))));
}

TEST(Report, SaysWhatIsMissing) {
  const TemporaryFolder files;
  const ProcessResult none = run_spslam({"report", files.path("none")});
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_THAT(none.err, HasSubstr("is not a folder"));
  files.write("empty/other.txt", "");
  const ProcessResult empty = run_spslam({"report", files.path("empty")});
  EXPECT_EQ(empty.exit_code, 1);
  EXPECT_THAT(empty.err, HasSubstr("trajectory_tum.txt"));
}

TEST(Report, SaysThatThePageCannotBeWritten) {
  const TemporaryFolder files;
  files.write("bank/trajectory_tum.txt", way());
  const ProcessResult result =
      run_spslam({"report", files.path("bank"), "--output", files.path("no/such/folder/page.html")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("page.html"));
}

}  // namespace
}  // namespace spslam
