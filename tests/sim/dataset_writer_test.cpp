// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/sim/dataset_writer.h"

#include <gmock/gmock.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "base/temporary_folder.h"
#include "sim/small_scene.h"
#include "spslam/base/error.h"
#include "spslam/io/dataset.h"
#include "spslam/io/text.h"

namespace spslam::sim {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class DatasetWriterTest : public testing::Test {
 protected:
  DatasetWriterTest() {
    request_.scene = small_scene();
    request_.scene.truth.depth_every = request_.scene.truth.mask_every = 2;
    request_.output = folder_ / "data";
    request_.frames = 4;
  }

  template <class Exception>
  std::string message_of(const Progress& progress = {}) {
    try {
      simulate_dataset(request_, progress);
    } catch (const Exception& error) {
      return error.what();
    }
    return "no error";
  }

  const test::TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
  SimulationRequest request_;
};

TEST_F(DatasetWriterTest, EveryLayoutCanBeRead) {
  const StereoFrame expected = Simulator(request_.scene, request_.seed).next()->images;
  for (const Layout layout : {Layout::kKitti, Layout::kEuroc, Layout::kUsvinland}) {
    request_.layout = layout;
    request_.output = folder_ / option_names(layout)[static_cast<std::size_t>(layout)];
    const SimulationSummary summary = simulate_dataset(request_);
    EXPECT_EQ(summary.frames, 4);
    const auto dataset = open_dataset(request_.output);
    ASSERT_EQ(dataset->size(), 4);
    EXPECT_NEAR(dataset->rig().baseline, 0.12, 1e-6);
    EXPECT_NEAR(dataset->timestamp(3), 0.3, 1e-6);
    const StereoFrame read = dataset->load(0);
    ASSERT_TRUE(read.problem.empty()) << read.problem;
    ASSERT_EQ(read.left.size(), expected.left.size());
    const double tolerance = layout == Layout::kKitti ? 0 : 3;  // JPEG; rectification's interpolation
    EXPECT_LE(cv::norm(read.left, expected.left, cv::NORM_L1) / static_cast<double>(read.left.total()),
              tolerance);
    ASSERT_TRUE(dataset->ground_truth().has_value());
    EXPECT_EQ(dataset->planar_ground_truth(), layout == Layout::kUsvinland);
    const Trajectory& truth = *dataset->ground_truth();
    ASSERT_EQ(truth.size(), 4U);
    const double way =
        (truth[3].world_from_camera.translation - truth[0].world_from_camera.translation).norm();
    EXPECT_NEAR(way, 0.3 * request_.scene.path.speed, 0.15);
  }
}

TEST_F(DatasetWriterTest, PosesAreOfTheFirstCameraAndLeadBackToTheWorld) {
  simulate_dataset(request_);
  const Trajectory poses = read_trajectory(request_.output / "poses.txt");
  const Trajectory world =
      parse_kitti_poses(read_text_file(request_.output / "world_from_first_camera.txt"), "world");
  const BoatMotion motion(request_.scene, request_.seed);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const SE3 expected = motion.world_from_left(0.1 * static_cast<double>(i));
    const SE3 found = world[0].world_from_camera * poses[i].world_from_camera;
    EXPECT_LT((found.translation - expected.translation).norm(), 1e-6);
    EXPECT_LT((found.rotation - expected.rotation).norm(), 1e-6);
  }
}

TEST_F(DatasetWriterTest, DepthIsInCentimetresAndMasksAreBeside) {
  simulate_dataset(request_);
  const cv::Mat depth = cv::imread((request_.output / "depth" / "000002.png").string(), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(depth.type(), CV_16UC1);
  const FrameTruth truth = Simulator(request_.scene, request_.seed).truth(0.2);
  for (const cv::Point at : {cv::Point(20, 90), cv::Point(180, 60), cv::Point(104, 100)})
    EXPECT_NEAR(depth.at<std::uint16_t>(at), std::min(65535.0F, 100 * truth.depth.at<float>(at)), 0.51);
  EXPECT_FALSE(fs::exists(request_.output / "depth" / "000001.png"));
  for (const char* mask : {"water_mask", "sky_mask", "far_mask", "moving_mask"})
    EXPECT_FALSE(cv::imread((request_.output / mask / "000002.png").string(), cv::IMREAD_UNCHANGED).empty())
        << mask;
}

TEST_F(DatasetWriterTest, TheWrittenSceneSimulatesTheSame) {
  request_.frames = 1;
  simulate_dataset(request_);
  const SceneDescription again = load_scene((request_.output / "scene.yaml").string());
  EXPECT_EQ(again.title, request_.scene.title);
  const auto before = list_options(request_.scene), after = list_options(again);
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(before[i].value, after[i].value) << before[i].key;
}

TEST_F(DatasetWriterTest, AFolderThatIsNotEmptyIsRefused) {
  fs::create_directories(request_.output);
  std::ofstream(request_.output / "mine.txt") << "precious";
  EXPECT_THAT(message_of<OutputError>(), HasSubstr("not empty"));
  request_.overwrite = true;
  EXPECT_THAT(message_of<OutputError>(), HasSubstr("not a simulated data set"));
  EXPECT_TRUE(fs::exists(request_.output / "mine.txt"));
}

TEST_F(DatasetWriterTest, OverwriteReplacesAnEarlierRun) {
  request_.frames = 3;
  simulate_dataset(request_);
  request_.frames = 2;
  EXPECT_THAT(message_of<OutputError>(), HasSubstr("--overwrite"));
  request_.overwrite = true;
  simulate_dataset(request_);
  EXPECT_EQ(open_dataset(request_.output)->size(), 2);
}

TEST_F(DatasetWriterTest, AnInterruptedRunIsRecognised) {
  const SimulationSummary summary = simulate_dataset(request_, [](int written, int) { return written < 2; });
  EXPECT_TRUE(summary.stopped);
  EXPECT_EQ(summary.frames, 2);
  EXPECT_TRUE(fs::exists(request_.output / kIncompleteMarker));
  try {
    open_dataset(request_.output);
    FAIL() << "opened";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(kIncompleteMarker));
  }
  request_.overwrite = true;
  simulate_dataset(request_);
  EXPECT_NO_THROW(open_dataset(request_.output));
}

TEST_F(DatasetWriterTest, WhatCannotBeWrittenIsSaid) {
  std::ofstream(folder_ / "file") << "x";
  request_.output = folder_ / "file";
  EXPECT_THAT(message_of<OutputError>(), HasSubstr("is a file"));
  request_.output = folder_ / "file" / "below";
  EXPECT_THAT(message_of<OutputError>(), HasSubstr("below"));
  // The folder of the right eye vanishes half way, as a disk would.
  request_.output = folder_ / "data";
  const auto spoil = [&](int, int) {
    fs::remove_all(request_.output / "image_1");
    return true;
  };
  EXPECT_THAT(message_of<OutputError>(spoil), HasSubstr("is the disk full"));
  EXPECT_TRUE(fs::exists(request_.output / kIncompleteMarker));
}

TEST_F(DatasetWriterTest, StreamsAreWritten) {
  simulate_dataset(request_);
  const std::string text = read_text_file(request_.output / "imu.csv");
  LineReader imu(text, "imu.csv");
  int samples = 0;
  for (; imu.next(); ++samples) EXPECT_EQ(imu.fields(',').size(), 7U);
  EXPECT_EQ(samples, 31);
}

}  // namespace
}  // namespace spslam::sim
