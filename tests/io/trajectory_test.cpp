// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/io/trajectory.h"

#include <gmock/gmock.h>

#include "io/synthetic_folder.h"

namespace spslam {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;

Trajectory random_trajectory(int count, bool planar = false) {
  Random random(3);
  Trajectory trajectory;
  for (int i = 0; i < count; ++i) {
    Vector6d twist;
    for (int k = 0; k < 6; ++k) twist[k] = random.uniform(-3, 3);
    const SE3 pose =
        planar ? planar_pose(100 * twist[0], 100 * twist[1], random.uniform(0, 360)) : SE3::exp(twist);
    trajectory.push_back({1403715273.262 + 0.05 * i, pose});
  }
  return trajectory;
}

void expect_near(const Trajectory& a, const Trajectory& b, double time_tolerance, double pose_tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR(a[i].timestamp, b[i].timestamp, time_tolerance);
    EXPECT_LT((a[i].world_from_camera.rotation - b[i].world_from_camera.rotation).norm(), pose_tolerance);
    EXPECT_LT((a[i].world_from_camera.translation - b[i].world_from_camera.translation).norm(),
              pose_tolerance);
  }
}

TEST(Trajectory, RoundTrips) {
  const Trajectory trajectory = random_trajectory(50);
  std::vector<double> times;
  for (const StampedPose& pose : trajectory) times.push_back(pose.timestamp);
  expect_near(parse_tum(format_tum(trajectory), "t"), trajectory, 0, 1e-8);
  expect_near(parse_kitti_poses(format_kitti_poses(trajectory), "t", times), trajectory, 0, 1e-8);
  SE3 body_from_camera = SE3::exp((Vector6d() << 0.1, -0.2, 0.3, 1, 2, -0.5).finished());
  const std::string euroc = format_euroc_ground_truth(trajectory, body_from_camera);
  expect_near(parse_euroc_ground_truth(euroc, "t", body_from_camera), trajectory, 1e-6, 1e-8);
  const Trajectory planar = random_trajectory(50, true);
  expect_near(parse_usvinland_gps(format_usvinland_gps(planar), "t"), planar, 1e-6, 1e-7);
}

TEST(Trajectory, IsRecognisedByItsFirstLine) {
  const TemporaryFolder folder;
  const Trajectory trajectory = random_trajectory(5, true);
  const std::pair<std::string, TrajectoryFormat> files[] = {
      {format_tum(trajectory), TrajectoryFormat::kTum},
      {format_kitti_poses(trajectory), TrajectoryFormat::kKitti},
      {format_euroc_ground_truth(trajectory), TrajectoryFormat::kEuroc},
      {format_usvinland_gps(trajectory), TrajectoryFormat::kUsvinland},
      {"# nothing\n", TrajectoryFormat::kAuto},
      {"1 2 3\n", TrajectoryFormat::kAuto}};
  for (const auto& [text, format] : files) {
    EXPECT_EQ(recognise_trajectory(text), format);
    write_text_file(folder.path() / "file", text);
    if (format == TrajectoryFormat::kAuto) {
      EXPECT_THAT(message_of([&] { read_trajectory(folder.path() / "file"); }),
                  HasSubstr("TUM has 8 numbers"));
      continue;
    }
    const Trajectory read = read_trajectory(folder.path() / "file");
    EXPECT_EQ(read.size(), 5u);
    EXPECT_EQ(read[2].timestamp == 2, format == TrajectoryFormat::kKitti)
        << "a KITTI row has its index as time";
  }
  write_text_file(folder.path() / "times.txt", "1\n2\n3\n4\n5.5\n");
  write_text_file(folder.path() / "file", format_kitti_poses(trajectory));
  EXPECT_EQ(read_trajectory(folder.path() / "file").back().timestamp, 5.5);
}

TEST(Trajectory, TumAsOthersWriteIt) {
  const Trajectory trajectory = parse_tum(
      "# a comment\r\n\r\n1.5 1 2 3 0 0 0 -0.9999\r\n 2.5\t1 2 3 0 0 0 1\r\n2.5 9 9 9 0 0 0 1\r\n", "t");
  ASSERT_EQ(trajectory.size(), 2u) << "the second line of one time is dropped";
  EXPECT_LT((trajectory[0].world_from_camera.rotation - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_EQ(trajectory[1].world_from_camera.translation.x(), 1);
}

struct BadText {
  const char* name;
  std::function<void()> parse;
  std::string message;
};

void PrintTo(const BadText& row, std::ostream* out) {
  *out << row.name;
}

class RefusedTrajectory : public testing::TestWithParam<BadText> {};

TEST_P(RefusedTrajectory, NamesFileAndLine) {
  EXPECT_THAT(message_of(GetParam().parse), HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    Texts, RefusedTrajectory,
    testing::Values(
        BadText{"tum_short", [] { parse_tum("# c\n1 2 3 4 5 6 7\n", "t"); }, "t:2: has 7 values, needs 8"},
        BadText{"tum_nan", [] { parse_tum("1 nan 3 4 0 0 0 1\n", "t"); }, "t:1: 'nan' is not finite"},
        BadText{"tum_word", [] { parse_tum("1 x 3 4 0 0 0 1\n", "t"); }, "t:1: 'x' is not a number"},
        BadText{"tum_quaternion", [] { parse_tum("1 2 3 4 0 0 0 1.2\n", "t"); },
                "t:1: quaternion has length 1.2"},
        BadText{"tum_zero_quaternion", [] { parse_tum("1 2 3 4 0 0 0 0\n", "t"); },
                "t:1: quaternion has length 0"},
        BadText{"tum_backwards", [] { parse_tum("2 2 3 4 0 0 0 1\n1 2 3 4 0 0 0 1\n", "t"); },
                "t:2: time 1.0"},
        BadText{"kitti_short", [] { parse_kitti_poses("1 0 0 0\n", "t"); }, "t:1: has 4 values, needs 12"},
        BadText{"kitti_stretched", [] { parse_kitti_poses("2 0 0 0 0 1 0 0 0 0 1 0\n", "t"); },
                "t:1: the first three"},
        BadText{"kitti_mirrored", [] { parse_kitti_poses("1 0 0 0 0 1 0 0 0 0 -1 0\n", "t"); },
                "t:1: the first three"},
        BadText{"kitti_more_rows",
                [] {
                  parse_kitti_poses("1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 0\n", "t",
                                    std::vector<double>{1});
                },
                "t:2: is pose 2, there are only 1 times"},
        BadText{"kitti_fewer_rows",
                [] {
                  parse_kitti_poses("1 0 0 0 0 1 0 0 0 0 1 0\n", "t", std::vector<double>{1, 2});
                },
                "1 poses for 2 times"},
        BadText{"euroc_seconds", [] { parse_euroc_ground_truth("1.5,1,2,3,1,0,0,0\n", "t"); },
                "t:1: '1.5' is not a whole"},
        BadText{"euroc_short", [] { parse_euroc_ground_truth("15,1,2,3,1,0,0\n", "t"); },
                "t:1: has 7 columns"},
        BadText{"euroc_equal_times",
                [] { parse_euroc_ground_truth("15,1,2,3,1,0,0,0\n15,1,2,3,1,0,0,0\n", "t"); }, "t:2: time"},
        BadText{"usv_short", [] { parse_usvinland_gps("1,2,3,0,0,0,0,0,0,0\n", "t"); },
                "t:1: has 10 columns"},
        BadText{"usv_empty_heading", [] { parse_usvinland_gps("1,2,3,0,0,0,0,0,0,0,\n", "t"); },
                "t:1: '' is not a number"}),
    [](const testing::TestParamInfo<BadText>& row) { return std::string(row.param.name); });

}  // namespace
}  // namespace spslam
