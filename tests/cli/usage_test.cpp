// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include <gmock/gmock.h>

#include "cli/process.h"

namespace spslam {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

struct UsageCase {
  const char* name;
  std::vector<std::string> arguments;
  std::vector<std::string> said;  // on stderr
};

class WrongUsage : public testing::TestWithParam<UsageCase> {};

TEST_P(WrongUsage, IsExplainedOnStderrWithExitCodeTwo) {
  const ProcessResult result = run_spslam(GetParam().arguments);
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, StartsWith("spslam: "));
  for (const std::string& part : GetParam().said) EXPECT_THAT(result.err, HasSubstr(part));
}

INSTANTIATE_TEST_SUITE_P(
    Cli, WrongUsage,
    testing::Values(
        UsageCase{"Subcommand", {"evalute"}, {"unknown subcommand 'evalute'", "did you mean 'evaluate'?"}},
        UsageCase{"StrangeSubcommand", {"xyzzyplugh"}, {"unknown subcommand 'xyzzyplugh'", "--help"}},
        UsageCase{"NestedSubcommand",
                  {"vocabulary", "trian"},
                  {"unknown subcommand 'trian'", "did you mean 'train'?", "`spslam vocabulary --help`"}},
        UsageCase{"NestedOption",
                  {"vocabulary", "train", "a", "--levls", "3"},
                  {"'--levels'", "`spslam vocabulary train --help`"}},
        UsageCase{"GlobalOption",
                  {"--log-levl", "off"},
                  {"unknown option '--log-levl'", "did you mean '--log-level'?"}},
        UsageCase{"Option",
                  {"evaluate", "a", "b", "--plannar"},
                  {"unknown option '--plannar'", "'--planar'", "spslam evaluate --help"}},
        UsageCase{"OptionWithValue",
                  {"evaluate", "a", "b", "--algin=se3"},
                  {"unknown option '--algin'", "'--align'"}},
        UsageCase{"OptionBeforeArguments", {"evaluate", "--jsno"}, {"'--json'"}},
        UsageCase{
            "OtherWord", {"run", "a", "-o", "b", "--frames", "5"}, {"'--frames'", "did you mean '--end'?"}},
        UsageCase{"LogLevel", {"run", "a", "-o", "b", "--log-level", "loud"}, {"--log-level", "debug"}},
        UsageCase{"NotAboveZero",
                  {"export-map", "a", "-o", "b.ply", "--max-uncertainty", "0"},
                  {"--max-uncertainty: '0' is not a number above 0. See"}},
        UsageCase{"MissingArgument", {"evaluate", "a"}, {"GROUNDTRUTH is required"}},
        UsageCase{"OneArgumentTooMany", {"evaluate", "a", "b", "c"}, {"unexpected argument 'c'"}},
        UsageCase{"UnknownName", {"evaluate", "a", "b", "--align", "se4"}, {"'se4'", "none, se3, sim3"}},
        UsageCase{"NotANumber", {"evaluate", "a", "b", "--tolerance", "soon"}, {"--tolerance", "soon"}}),
    [](const testing::TestParamInfo<UsageCase>& test) { return test.param.name; });

TEST(Usage, NoSubcommandPrintsTheHelp) {
  const ProcessResult result = run_spslam({});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("Usage"), HasSubstr("evaluate")));
}

TEST(Usage, HelpAndVersionGoToStdout) {
  const ProcessResult version = run_spslam({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_THAT(version.out, testing::MatchesRegex("spslam [0-9]+\\.[0-9]+\\.[0-9]+\n"));
  const ProcessResult help = run_spslam({"evaluate", "--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, AllOf(HasSubstr("--align"), HasSubstr("GROUNDTRUTH")));
  EXPECT_EQ(help.err, "");
}

TEST(Usage, LogLevelBeforeTheSubcommandAndBehindIt) {
  const std::string nowhere = "/no/such/folder";
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"--log-level", "debug", "run", nowhere, "-o", "out"},
        {"run", nowhere, "-o", "out", "--log-level", "debug"},
        {"vocabulary", "info", nowhere, "--log-level=debug"}})
    EXPECT_THAT(run_spslam(arguments).err, HasSubstr(nowhere)) << "the command line is right";
}

TEST(Usage, OutputThatDoesNotArriveIsAFailure) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"config", "--print"}, {"run", "--help"}, {"--version"}}) {
    const ProcessResult full = run_spslam(arguments, "/dev/full");
    EXPECT_EQ(full.exit_code, 1) << arguments[0];
    EXPECT_THAT(full.err, HasSubstr("stdout"));
  }
}

TEST(Usage, LocalizingNeedsAMapAndMakesNone) {
  const ProcessResult without = run_spslam({"run", "nowhere", "-o", "out", "--localize"});
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_THAT(without.err, testing::HasSubstr("--load-map"));
  const ProcessResult saving =
      run_spslam({"run", "nowhere", "-o", "out", "--localize", "--load-map", "a", "--save-map", "b"});
  EXPECT_EQ(saving.exit_code, 2);
  EXPECT_THAT(saving.err, testing::HasSubstr("--save-map"));
}

}  // namespace
}  // namespace spslam
