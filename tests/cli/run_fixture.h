// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// A rendered data set and `spslam run` on it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "cli/process.h"
#include "spslam/eval/run_folder.h"
#include "system/synthetic_scene.h"

namespace spslam {

// The data set is rendered once, each test has a place of its own for results.
class Run : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scene_folder = std::make_unique<TemporaryFolder>();
    test::write_scene(scene_folder->path("scene"));
  }
  static void TearDownTestSuite() { scene_folder.reset(); }

  static std::string scene() { return scene_folder->path("scene"); }
  // A copy that a test may damage.
  std::string own_scene() const {
    std::filesystem::copy(scene(), scratch.path("scene"), std::filesystem::copy_options::recursive);
    return scratch.path("scene");
  }
  std::string out(const std::string& name = "out") const { return scratch.path(name); }
  std::string result(const std::string& file) const { return read_file(out() + "/" + file); }
  std::size_t lines(const std::string& file) const {
    const std::string text = result(file);
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  }
  std::vector<ReportFrame> frames() const { return parse_frames_csv(result("frames.csv"), "frames.csv"); }
  ProcessResult run(std::vector<std::string> more, const std::string& dataset = scene()) const {
    std::vector<std::string> arguments = {"run", dataset, "--output", out(), "--sequential"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_spslam(arguments);
  }

  TemporaryFolder scratch;
  static inline std::unique_ptr<TemporaryFolder> scene_folder;
};

}  // namespace spslam
