// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Where `spslam run` writes: what it refuses, what it replaces, and what is left when something cannot be
// written.

#include <gmock/gmock.h>

#include "cli/run_fixture.h"

namespace spslam {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kOurConfig = "# spslam 0.1.0, of an earlier run\n";

TEST_F(Run, ResultsAreReplacedOnlyIfThatIsSaid) {
  scratch.write("out/notes.txt", "mine");
  scratch.write("out/config.yaml", kOurConfig);
  scratch.write("out/metrics.json", "of an earlier run");
  const ProcessResult refused = run({});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("not empty"), HasSubstr("--overwrite")));
  EXPECT_EQ(result("metrics.json"), "of an earlier run");
  EXPECT_EQ(run({"--overwrite"}).exit_code, 0);
  EXPECT_EQ(result("notes.txt"), "mine");
  EXPECT_THAT(result("metrics.json"), HasSubstr("ate_m"));
  EXPECT_EQ(run({"--overwrite"}).exit_code, 0);
}

// A web site's report.html, say.
TEST_F(Run, AFolderOfSomethingElseIsLeftAlone) {
  const std::vector<std::vector<std::pair<const char*, const char*>>> folders = {
      {{"notes.txt", "mine"}},
      {{"report.html", "mine"}},
      {{"config.yaml", "port: 80\n"}},
      {{"log.txt", "12:00 started\n"}},
      {{"config.yaml", kOurConfig}, {"log.txt", "12:00 started\n"}}};
  for (const auto& files : folders) {
    fs::remove_all(out());
    for (const auto& [name, text] : files) scratch.write(std::string("out/") + name, text);
    const ProcessResult refused = run({"--overwrite"});
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.err, AllOf(HasSubstr("no results of a run"), HasSubstr("--output")));
    for (const auto& [name, text] : files) EXPECT_EQ(result(name), text);
    EXPECT_EQ(std::distance(fs::directory_iterator(out()), {}), std::ssize(files));
  }
}

TEST_F(Run, WhatFailedAtOnceNeedsNoOverwrite) {
  scratch.write("out/log.txt", "2026-01-01 12:00:00.000 info spslam 0.1.0\n");
  EXPECT_EQ(run({"--samples", "0"}).exit_code, 0);
  EXPECT_EQ(run({"--samples", "0"}).exit_code, 1) << "now there are results";
}

TEST_F(Run, OutputThatCannotBeAFolder) {
  const std::string file = scratch.write("file", "x");
  for (const std::string& place : {file, file + "/below", std::string("/proc/spslam")}) {
    const ProcessResult refused = run_spslam({"run", scene(), "--output", place});
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.err, AllOf(HasSubstr(place), HasSubstr("--output")));
  }
}

TEST_F(Run, FullDiskLosesNothingElse) {
  scratch.write("out/config.yaml", kOurConfig);
  fs::create_symlink("/dev/full", out() + "/trajectory_tum.txt.partial");
  const ProcessResult full = run({"--overwrite"});
  EXPECT_EQ(full.exit_code, 1);
  EXPECT_THAT(full.err, AllOf(HasSubstr("trajectory_tum.txt"), HasSubstr("space")));
  EXPECT_FALSE(fs::exists(out() + "/trajectory_tum.txt"));
  EXPECT_EQ(frames().size(), 16U);
  EXPECT_EQ(lines("trajectory_kitti.txt"), 16U);
  EXPECT_THAT(full.out, HasSubstr("16 tracking")) << "the summary";
}

TEST_F(Run, FullDiskDoesNotCostTheMap) {
  scratch.write("out/config.yaml", kOurConfig);
  fs::create_symlink("/dev/full", out() + "/trajectory_tum.txt.partial");
  fs::create_symlink("/dev/full", out() + "/loops.csv.partial");
  scratch.write("out/samples", "a file where a folder should be");
  const ProcessResult full = run({"--overwrite", "--save-map", scratch.path("a.map")});
  EXPECT_EQ(full.exit_code, 1);
  EXPECT_THAT(full.err, AllOf(HasSubstr("3 things failed"), HasSubstr("trajectory_tum.txt"),
                              HasSubstr("loops.csv"), HasSubstr("samples")));
  EXPECT_THAT(full.out, AllOf(HasSubstr("16 tracking"), HasSubstr("results ")));
  EXPECT_THAT(read_file(scratch.path("a.map")), testing::StartsWith("SPSLMAP"));
}

TEST_F(Run, FullDiskIsNoticedBeforeComputing) {
  scratch.write("out/config.yaml", kOurConfig);
  fs::create_symlink("/dev/full", out() + "/config.yaml.partial");
  EXPECT_EQ(run({"--overwrite"}).exit_code, 1);
  EXPECT_FALSE(fs::exists(out() + "/frames.csv"));
}

TEST_F(Run, AMapThatCannotBeSavedIsSaidBeforeComputing) {
  scratch.write("file", "x");
  for (const std::string& map : {scratch.path("none/a.map"), scratch.path(""), scratch.path("file/a.map"),
                                 std::string("/dev/full"), std::string("/proc/a.map")}) {
    const ProcessResult refused = run({"--save-map", map, "--overwrite"});
    EXPECT_EQ(refused.exit_code, 1) << map;
    EXPECT_THAT(refused.err, AllOf(HasSubstr("--save-map"), HasSubstr(map.substr(0, map.size() - 1))));
    EXPECT_FALSE(fs::exists(out())) << map;
  }
}

TEST_F(Run, AMapIsReplacedOnlyIfThatIsSaid) {
  const std::string map = scratch.write("photo.map", "something dear");
  const ProcessResult refused = run({"--save-map", map});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("photo.map exists"), HasSubstr("--overwrite")));
  EXPECT_EQ(read_file(map), "something dear");
  EXPECT_FALSE(fs::exists(out()));
  EXPECT_EQ(run({"--save-map", map, "--overwrite"}).exit_code, 0);
  EXPECT_THAT(read_file(map), testing::StartsWith("SPSLMAP"));
  EXPECT_EQ(run({"--save-map", out("other") + "/a.map"}).exit_code, 1) << "that folder is not made";
}

TEST_F(Run, AMapMayLieInAFolderThatTheRunMakes) {
  for (const char* map : {"new/out/a.map", "new/b.map"}) {
    std::filesystem::remove_all(scratch.path("new"));
    const ProcessResult done =
        run_spslam({"run", scene(), "--output", scratch.path("new/out"), "--sequential", "--samples", "0",
                    "--save-map", scratch.path(map)});
    EXPECT_EQ(done.exit_code, 0) << done.err;
    EXPECT_THAT(read_file(scratch.path(map)), testing::StartsWith("SPSLMAP"));
  }
}

}  // namespace
}  // namespace spslam
