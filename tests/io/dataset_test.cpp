// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/io/dataset.h"

#include <gmock/gmock.h>

#include "io/synthetic_folder.h"
#include "spslam/io/euroc.h"

namespace spslam {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;

void expect_all_frames(const Dataset& dataset) {
  ASSERT_EQ(dataset.size(), kFrames);
  for (int i = 0; i < kFrames; ++i) {
    const StereoFrame frame = dataset.load(i);
    EXPECT_EQ(frame.problem, "");
    EXPECT_EQ(frame.timestamp, dataset.timestamp(i));
    EXPECT_TRUE(same_pixels(frame.left, left_image(i))) << i;
    EXPECT_TRUE(same_pixels(frame.right, right_image(i))) << i;
  }
}

void expect_small_rig(const StereoRig& rig) {
  const StereoRig expected = small_rig();
  EXPECT_DOUBLE_EQ(rig.fx, expected.fx);
  EXPECT_DOUBLE_EQ(rig.cx, expected.cx);
  EXPECT_DOUBLE_EQ(rig.cy, expected.cy);
  EXPECT_NEAR(rig.baseline, expected.baseline, 1e-12);
  EXPECT_EQ(rig.width, kWidth);
  EXPECT_EQ(rig.height, kHeight);
}

TEST(Dataset, Kitti) {
  const TemporaryFolder folder;
  const std::unique_ptr<Dataset> dataset = open_dataset(write_kitti(folder.path()));
  expect_all_frames(*dataset);
  expect_small_rig(dataset->rig());
  EXPECT_FALSE(dataset->ground_truth());
  EXPECT_THAT(dataset->description(), HasSubstr("(kitti): 6 pairs of 64 x 48 px"));
  EXPECT_THROW(dataset->load(kFrames), InputError);
}

TEST(Dataset, KittiTruthInThePosesFolder) {
  const TemporaryFolder folder;
  const fs::path sequence = write_kitti(folder.path() / "sequences" / "04");
  fs::create_directories(folder.path() / "poses");
  std::string poses;
  for (int i = 0; i < kFrames; ++i) poses += "1 0 0 0 0 1 0 0 0 0 1 " + std::to_string(i) + "\r\n";
  write_text_file(folder.path() / "poses" / "04.txt", poses);
  for (const fs::path& path : {sequence, sequence / ""}) {
    const std::unique_ptr<Dataset> dataset = open_dataset(path);
    ASSERT_TRUE(dataset->ground_truth());
    EXPECT_DOUBLE_EQ(dataset->ground_truth()->at(4).timestamp, 0.4);
    EXPECT_DOUBLE_EQ(dataset->ground_truth()->at(4).world_from_camera.translation.z(), 4);
  }
}

std::string projection(const std::string& name, double x) {  // of a camera at x m of the reference
  return name + ": 50 0 31.5 " + fixed_text(-50 * x, 6) + " 0 50 23.5 0 0 0 1 0\n";
}

TEST(Dataset, KittiInColour) {
  const TemporaryFolder folder;
  write_kitti(folder.path());
  fs::rename(folder.path() / "image_0", folder.path() / "image_2");
  fs::rename(folder.path() / "image_1", folder.path() / "image_3");
  write_text_file(folder.path() / "calib.txt", projection("P0", 0) + projection("P1", 0.5) +
                                                   projection("P2", -0.06) + projection("P3", 0.02));
  std::string poses;
  for (int i = 0; i < kFrames; ++i) poses += "0 0 1 0 0 1 0 0 -1 0 0 0\n";  // heads along x
  write_text_file(folder.path() / "poses.txt", poses);
  const std::unique_ptr<Dataset> dataset = open_dataset(folder.path());
  expect_all_frames(*dataset);
  expect_small_rig(dataset->rig());
  EXPECT_LT(
      (dataset->ground_truth()->at(2).world_from_camera.translation - Eigen::Vector3d(0, 0, 0.06)).norm(),
      1e-9)
      << "the truth is of camera 0, camera 2 stands 0.06 m to its left";
}

TEST(Dataset, KittiRaw) {
  for (const bool colour : {false, true}) {
    const TemporaryFolder folder;
    const fs::path drive = folder.path() / "2011_09_26" / "2011_09_26_drive_0001_sync";
    const fs::path left = drive / (colour ? "image_02" : "image_00"),
                   right = drive / (colour ? "image_03" : "image_01");
    std::string times;
    for (int i = 0; i < kFrames; ++i) {
      write_image(left / "data" / ("0000" + frame_name(i)), left_image(i));
      write_image(right / "data" / ("0000" + frame_name(i)), right_image(i));
      times += "2011-09-26 23:59:59." + std::to_string(100000000 * (i + 3)) + "\n";
    }
    write_text_file(left / "timestamps.txt", times);
    std::string calibration = "calib_time: 09-Jan-2012 13:57:47\n";
    for (const std::string camera : {"00", "01", "02", "03"})
      calibration += "S_rect_" + camera + ": 6.4e+01 4.8e+01\n" +
                     projection("P_rect_" + camera, camera == "01" || camera == "03" ? 0.08 : 0);
    write_text_file(folder.path() / "2011_09_26" / "calib_cam_to_cam.txt", calibration);
    const std::unique_ptr<Dataset> dataset = open_dataset(drive);
    expect_all_frames(*dataset);
    expect_small_rig(dataset->rig());
    EXPECT_NEAR(dataset->timestamp(0), 1317081599.3, 1e-6);
    EXPECT_NEAR(dataset->timestamp(5) - dataset->timestamp(0), 0.5, 1e-6);
    EXPECT_THAT(dataset->description(), HasSubstr("(kitti-raw)"));
    for (const fs::path& eye : {left, right}) fs::remove(eye / "data" / ("0000" + frame_name(2)));
    EXPECT_THAT(open_dataset(drive / "")->load(2).problem, HasSubstr("file is missing"));
  }
}

TEST(Dataset, PlainWithTimesAndWithRate) {
  const TemporaryFolder folder;
  write_plain(folder.path());
  const std::unique_ptr<Dataset> dataset = open_dataset(folder.path());
  expect_all_frames(*dataset);
  expect_small_rig(dataset->rig());
  fs::remove(folder.path() / "times.txt");
  DatasetOptions options;
  options.rate = 20;
  EXPECT_DOUBLE_EQ(open_dataset(folder.path(), options)->timestamp(5), 0.25);
}

TEST(Dataset, PlainPairsNamesThatDifferByOrder) {
  const TemporaryFolder folder;
  write_plain(folder.path());
  for (int i = 0; i < kFrames; ++i)  // left_8 comes before left_11
    for (const std::string eye : {"left", "right"})
      fs::rename(folder.path() / eye / frame_name(i),
                 folder.path() / eye / (eye + "_" + std::to_string(3 * i + 2) + ".png"));
  expect_all_frames(*open_dataset(folder.path()));
}

TEST(Dataset, PlainRawPairIsRectified) {
  const TemporaryFolder folder;
  write_plain(folder.path());
  const std::string camera =
      "{fx: 50, fy: 50, cx: 31.5, cy: 23.5, model: radtan, distortion: [-0.2, 0.05, 0, 0]}";
  write_text_file(folder.path() / "calibration.yaml",
                  "width: 64\nheight: 48\nleft: " + camera + "\nright: " + camera +
                      "\nright_from_left: [1, 0, 0, -0.1,  0, 1, 0, 0,  0, 0, 1, 0,  0, 0, 0, 1]\n");
  const std::unique_ptr<Dataset> dataset = open_dataset(folder.path());
  EXPECT_NEAR(dataset->rig().baseline, 0.1, 1e-9);
  EXPECT_LT(dataset->rig().fx, 50) << "a barrel lens sees more than a pinhole camera of its focal length";
  const StereoFrame frame = dataset->load(1);
  EXPECT_EQ(frame.left.size(), cv::Size(kWidth, kHeight));
  EXPECT_FALSE(same_pixels(frame.left, left_image(1)));
  EXPECT_THAT(dataset->description(), HasSubstr("rectified"));
}

TEST(Dataset, UsvinlandWithPlanarTruth) {
  const TemporaryFolder folder;
  write_usvinland(folder.path());
  write_text_file(folder.path() / "GPSBase.csv",
                  "0.05,10,20,0,0,0,0,0,0,0,90,7\r\n0.25,11,20,0,0,0,0,0,0,0,90,7\r\n");
  const std::unique_ptr<Dataset> dataset = open_dataset(folder.path());
  expect_all_frames(*dataset);
  EXPECT_TRUE(dataset->planar_ground_truth());
  ASSERT_EQ(dataset->ground_truth()->size(), 2u);
  const SE3& pose = dataset->ground_truth()->at(1).world_from_camera;
  EXPECT_LT((pose.rotation * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitX()).norm(), 1e-12)
      << "heading 90 is east";
  EXPECT_LT((pose.rotation * Eigen::Vector3d::UnitY() + Eigen::Vector3d::UnitZ()).norm(), 1e-12)
      << "down is down";
}

TEST(Dataset, UsvinlandRectifiedCalibrationNeedsRectifiedImages) {
  const TemporaryFolder folder;
  write_usvinland(folder.path());
  fs::rename(folder.path() / "PIC_Left_Rectified", folder.path() / "PIC_Left");
  EXPECT_THAT(message_of([&] { open_dataset(folder.path()); }), HasSubstr("PIC_Left_Rectified is missing"));
  fs::rename(folder.path() / "PIC_Left", folder.path() / "PIC_Left_Rectified");
  fs::remove(folder.path() / "calibration.yaml");
  EXPECT_THAT(message_of([&] { open_dataset(folder.path()); }), HasSubstr("calibration is missing"));
}

TEST(Dataset, EurocTruthIsOfTheLeftCamera) {
  const TemporaryFolder folder;
  write_euroc(folder.path());
  const fs::path truth = folder.path() / "mav0" / "state_groundtruth_estimate0";
  fs::create_directories(truth);
  write_text_file(truth / "data.csv",
                  "#timestamp, p\n1403715273262142976,1,2,3,0.7071067811865476,0,0,0.7071067811865476,0,0\n");
  for (const fs::path& path : {folder.path(), folder.path() / "mav0"}) {
    const std::unique_ptr<Dataset> dataset = open_dataset(path);
    expect_all_frames(*dataset);
    EXPECT_NEAR(dataset->rig().baseline, 0.08, 1e-9);
    EXPECT_NEAR(dataset->timestamp(0), 1403715273.262142976, 1e-6);
    ASSERT_TRUE(dataset->ground_truth());
    const SE3& pose = dataset->ground_truth()->front().world_from_camera;
    EXPECT_LT((pose.translation - Eigen::Vector3d(1, 2, 3.25)).norm(), 1e-9)
        << "T_BS of cam0 is 0.25 m along z";
    EXPECT_LT((pose.rotation * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(), 1e-9);
  }
}

TEST(Dataset, EurocUnpairedImagesAreCounted) {
  const TemporaryFolder folder;
  write_euroc(folder.path());
  const fs::path list = folder.path() / "mav0" / "cam1" / "data.csv";
  std::string text = "#t,f\n";
  for (int i = 1; i < kFrames; ++i) {  // 1 ms late, and the third by 20 ms
    const std::string file = std::to_string(kEurocStart + i * 50'000'000LL) + ".png";
    text += std::to_string(kEurocStart + i * 50'000'000LL + (i == 3 ? 20'000'000 : 1'000'000)) + "," + file +
            "\n";
  }
  write_text_file(list, text);
  const std::unique_ptr<Dataset> dataset = open_dataset(folder.path());
  EXPECT_EQ(dataset->size(), 4);
  EXPECT_EQ(dataset->unpaired(), 3);
  EXPECT_THAT(dataset->description(), HasSubstr("3 images without a partner"));
  DatasetOptions options;
  options.pair_tolerance = 0.0005;
  EXPECT_THAT(message_of([&] { open_dataset(folder.path(), options); }),
              AllOf(HasSubstr("none of 6 left and 5 right"), HasSubstr("--pair-tolerance")));
  options.pair_tolerance = 0.02;
  EXPECT_EQ(open_dataset(folder.path(), options)->size(), 5);
}

TEST(PairByTime, TakesTheNearestOfEachOther) {
  const auto images = [](std::initializer_list<std::int64_t> times) {
    std::vector<EurocImage> list;
    for (const std::int64_t time : times) list.push_back({time, "x.png"});
    return list;
  };
  using Pairs = std::vector<std::pair<int, int>>;
  EXPECT_EQ(pair_by_time(images({10, 20, 30}), images({8, 11, 29}), 5), (Pairs{{0, 1}, {2, 2}}));
  EXPECT_EQ(pair_by_time(images({8, 11}), images({10}), 5), (Pairs{{1, 0}}));
  EXPECT_EQ(pair_by_time(images({INT64_MIN, 0}), images({INT64_MAX}), 5), Pairs{});
}

TEST(Dataset, FormatAndCalibrationCanBeGiven) {
  const TemporaryFolder folder;
  write_kitti(folder.path());
  fs::rename(folder.path() / "image_0", folder.path() / "left");
  fs::rename(folder.path() / "image_1", folder.path() / "right");
  fs::create_directories(folder.path() / "PIC_Left");
  DatasetOptions options;
  set_option(options, "format", "plain");
  set_option(options, "calibration", (folder.path() / "calib.txt").string());
  expect_all_frames(*open_dataset(folder.path(), options));
}

}  // namespace
}  // namespace spslam
