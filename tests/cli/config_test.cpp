// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include <gmock/gmock.h>

#include "cli/process.h"

namespace spslam {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(Config, PrintsEveryOptionWithUnitAndMeaning) {
  const ProcessResult result = run_spslam({"config", "--print"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, AllOf(HasSubstr("threads: parallel  # "), HasSubstr("tracker.window_frames: "),
                                HasSubstr("tracker.state.coast_time: 2  # how long"), HasSubstr("[s]\n")));
  EXPECT_THAT(result.out, testing::Not(HasSubstr("(default"))) << "all are at their default";
}

TEST(Config, FileThenSettingsOverThePreset) {
  const TemporaryFolder folder;
  const std::string file =
      folder.write("my.yaml", "tracker:\n  window_frames: 3\n  state.coast_time: 1.5\nthreads: sequential\n");
  const ProcessResult result =
      run_spslam({"config", "--print", "--preset", "baseline", "--config", file, "--set",
                  "tracker.state.coast_time=4", "--set", "threads=parallel"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("tracker.window_frames: 3 "),
                                HasSubstr("tracker.state.coast_time: 4 "), HasSubstr("threads: parallel"),
                                HasSubstr("tracker.segment: false"), HasSubstr("(default 2)")));
}

TEST(Config, ReadsWhatItPrints) {
  const TemporaryFolder folder;
  for (const char* preset : {"sp-slam", "paper", "baseline"}) {
    const std::string printed = run_spslam({"config", "--print", "--preset", preset}).out;
    ASSERT_NE(printed, "");
    const ProcessResult again =
        run_spslam({"config", "--print", "--config", folder.write("printed.yaml", printed)});
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(again.out, printed);
  }
}

struct BadConfig {
  const char* name;
  std::vector<std::string> arguments;
  std::vector<std::string> said;
};

void PrintTo(const BadConfig& row, std::ostream* out) {
  *out << row.name;
}

class WrongConfig : public testing::TestWithParam<BadConfig> {};

TEST_P(WrongConfig, IsExplained) {
  const TemporaryFolder folder;
  folder.write("key.yaml", "tracker:\n  window_frame: 3\n");
  folder.write("list.yaml", "tracker:\n  window_frames: [3, 4]\n");
  folder.write("twice.yaml", "tracker:\n  window_frames: 3\ntracker.window_frames: 4\n");
  folder.write("line_twice.yaml", "threads: parallel\nthreads: sequential\n");
  folder.write("broken.yaml", "tracker: {window_frames\n");
  std::vector<std::string> arguments = {"config"};
  for (const std::string& word : GetParam().arguments)
    arguments.push_back(word.ends_with(".yaml") ? folder.path(word) : word);
  const ProcessResult result = run_spslam(arguments);
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.out, "");
  for (const std::string& part : GetParam().said) EXPECT_THAT(result.err, HasSubstr(part));
}

INSTANTIATE_TEST_SUITE_P(
    Cli, WrongConfig,
    testing::Values(
        BadConfig{"UnknownKey",
                  {"--set", "tracker.window_frame=3"},
                  {"tracker.window_frame", "tracker.window_frames"}},
        BadConfig{"UnknownKeyInAFile", {"--config", "key.yaml"}, {"key.yaml", "tracker.window_frames"}},
        BadConfig{
            "ListInAFile", {"--config", "list.yaml"}, {"list.yaml", "tracker.window_frames", "single value"}},
        BadConfig{
            "GivenTwice", {"--config", "twice.yaml"}, {"twice.yaml", "tracker.window_frames", "given twice"}},
        BadConfig{
            "LineTwice", {"--config", "line_twice.yaml"}, {"line_twice.yaml", "threads", "given twice"}},
        BadConfig{"NotYaml", {"--config", "broken.yaml"}, {"broken.yaml", "not valid YAML"}},
        BadConfig{"MissingFile", {"--config", "none.yaml"}, {"none.yaml", "cannot be read"}},
        BadConfig{"OutOfRange", {"--set", "tracker.state.coast_time=-1"}, {"tracker.state.coast_time", "-1"}},
        BadConfig{
            "NotANumber", {"--set", "tracker.state.coast_time=soon"}, {"tracker.state.coast_time", "soon"}},
        BadConfig{"WithoutValue", {"--set", "threads"}, {"--set threads", "KEY=VALUE"}},
        BadConfig{"UnknownName", {"--set", "threads=paralel"}, {"threads", "parallel"}},
        BadConfig{"UnknownPreset", {"--preset", "spslam"}, {"sp-slam, paper, baseline"}},
        BadConfig{"UnknownOption", {"--prnt"}, {"--print"}}),
    [](const testing::TestParamInfo<BadConfig>& test) { return test.param.name; });

}  // namespace
}  // namespace spslam
