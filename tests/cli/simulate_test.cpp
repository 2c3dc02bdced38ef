// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <filesystem>

#include "cli/process.h"

namespace spslam {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kScene = R"(
path: {length: 300, speed: 1, bend: 0.1}
shore:
  left: {kind: masonry, distance: 4, height: 1.8, trees: 0, bushes: 0, reeds: 0, piles: 0}
  right: {kind: none}
backdrop: {tree_density: 0, towers: 0}
rig: {focal: 60, width: 104, height: 56, baseline: 0.12}
render: {detail: 0.1, samples: 1, edge_samples: 0}
)";

// `spslam simulate` of the small scene into the folder "data".
std::vector<std::string> command(const TemporaryFolder& folder, const std::vector<std::string>& more = {},
                                 const char* frames = "3") {
  std::vector<std::string> words = {
      "simulate", folder.write("small.yaml", kScene), "--output", folder.path("data"), "--frames", frames};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

std::size_t files_in(const fs::path& folder) {
  std::error_code code;
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder, code), {}));
}

TEST(Simulate, WritesADataSetThatRunReads) {
  const TemporaryFolder folder;
  const ProcessResult simulated = run_spslam(command(folder, {"--seed", "4"}));
  EXPECT_EQ(simulated.exit_code, 0) << simulated.err;
  EXPECT_THAT(simulated.out, HasSubstr("3 pairs"));
  EXPECT_EQ(files_in(folder.path("data/image_0")), 3U);
  EXPECT_FALSE(fs::exists(folder.path("data/INCOMPLETE")));
  EXPECT_THAT(read_file(folder.path("data/scene.yaml")), HasSubstr("seed 4"));
  const ProcessResult tracked =
      run_spslam({"run", folder.path("data"), "--output", folder.path("run"), "--sequential"});
  EXPECT_EQ(tracked.exit_code, 1);
  EXPECT_THAT(tracked.err, HasSubstr("none of the 3 frames could be tracked")) << "the images are tiny";
  EXPECT_THAT(tracked.out, HasSubstr("frames       3"));
}

TEST(Simulate, TheSameSeedGivesTheSameBytes) {
  const TemporaryFolder folder;
  EXPECT_EQ(run_spslam(command(folder, {"--seed", "7"}, "1")).exit_code, 0);
  const auto image = [&] {
    return read_file(fs::directory_iterator(folder.path("data/image_1"))->path().string());
  };
  const std::string first = image();
  EXPECT_EQ(run_spslam(command(folder, {"--seed", "7", "--overwrite"}, "1")).exit_code, 0);
  EXPECT_EQ(image(), first);
  EXPECT_EQ(run_spslam(command(folder, {"--seed", "8", "--overwrite"}, "1")).exit_code, 0);
  EXPECT_NE(image(), first);
}

TEST(Simulate, NamesTheNearestSceneAndKey) {
  const TemporaryFolder folder;
  const ProcessResult scene = run_spslam({"simulate", "lake_lop", "--output", folder.path("data")});
  EXPECT_EQ(scene.exit_code, 2);
  EXPECT_THAT(scene.err, HasSubstr("did you mean 'lake_loop'"));
  const ProcessResult key = run_spslam(command(folder, {"--set", "air.visiblity=50"}));
  EXPECT_EQ(key.exit_code, 2);
  EXPECT_THAT(key.err,
              AllOf(HasSubstr("did you mean 'air.visibility'"), HasSubstr("spslam simulate SCENE --print")));
  const std::string bad = folder.write("bad.yaml", "path: {lenght: 60}\n");
  EXPECT_THAT(run_spslam({"simulate", bad, "--output", folder.path("data")}).err,
              AllOf(HasSubstr("bad.yaml:1"), HasSubstr("path.length"), HasSubstr("--print")));
  EXPECT_FALSE(fs::exists(folder.path("data")));
}

TEST(Simulate, RefusesARigThatCannotBe) {
  const TemporaryFolder folder;
  const ProcessResult result = run_spslam(command(folder, {"--set", "rig.baseline=0"}));
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("rig.baseline"));
  EXPECT_EQ(run_spslam({"simulate", "bank"}).exit_code, 2);  // no --output
}

TEST(Simulate, PrintsTheOptionsOfAScene) {
  const ProcessResult result = run_spslam({"simulate", "fog_traffic", "--print"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("air.visibility"));
}

TEST(Simulate, WritesIntoAnEmptyFolderOnly) {
  const TemporaryFolder folder;
  const std::string other = folder.write("data/letter.txt", "mine");
  const ProcessResult refused = run_spslam(command(folder));
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("not empty"), HasSubstr("--overwrite")));
  // What no simulation wrote is not removed, not even with --overwrite.
  EXPECT_EQ(run_spslam(command(folder, {"--overwrite"})).exit_code, 1);
  EXPECT_EQ(read_file(other), "mine");
  EXPECT_EQ(files_in(folder.path("data")), 1U);
}

TEST(Simulate, AnInterruptedRunLeavesAFolderThatIsRefused) {
  const TemporaryFolder folder;
  RunningSpslam running(command(folder, {}, "3000"));
  for (int i = 0; i < 60000 && files_in(folder.path("data/image_1")) < 2; ++i) usleep(1000);
  running.send(SIGINT);
  const ProcessResult stopped = running.wait();
  EXPECT_EQ(stopped.exit_code, 130);
  EXPECT_THAT(stopped.err, AllOf(HasSubstr("incomplete"), HasSubstr("--overwrite")));
  const std::vector<std::string> run = {"run", folder.path("data"), "--output", folder.path("run")};
  const ProcessResult refused = run_spslam(run);
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, HasSubstr("half written"));
  EXPECT_EQ(run_spslam(command(folder, {"--overwrite"})).exit_code, 0);
  EXPECT_THAT(run_spslam(run).out, HasSubstr("frames       3"));
}

}  // namespace
}  // namespace spslam
