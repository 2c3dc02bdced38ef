// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/io/calibration.h"

#include <gmock/gmock.h>

#include "io/synthetic_folder.h"

namespace spslam {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;

TEST(Calibration, KittiRoundTrip) {
  const StereoRig rig = small_rig();
  const StereoRig read = parse_kitti_calibration(format_kitti_calibration(rig), "c").rig;
  EXPECT_DOUBLE_EQ(read.fx, rig.fx);
  EXPECT_DOUBLE_EQ(read.cy, rig.cy);
  EXPECT_NEAR(read.baseline, rig.baseline, 1e-12);
  EXPECT_EQ(read.width, 0) << "the file does not say";
}

TEST(Calibration, KittiIgnoresWhatIsNotStereoGrey) {
  const StereoCalibration calibration = parse_kitti_calibration(
      "calib_time: 09-Jan-2012 13:57:47\r\nP0: 7 0 3 0 0 7 2 0 0 0 1 0\r\nP1: 7 0 3 -3.5 0 7 2 0 0 0 1 0\r\n"
      "P2: 7 0 3 1 0 7 2 0 0 0 1 0\r\nTr: 1 2 3\r\n",
      "c");
  EXPECT_DOUBLE_EQ(calibration.rig.baseline, 0.5);
}

// calib.txt of sequences 00 to 02, shortened.
TEST(Calibration, KittiColourPair) {
  const StereoCalibration calibration = parse_kitti_calibration(
      "P0: 718.856 0 607.1928 0 0 718.856 185.2157 0 0 0 1 0\n"
      "P1: 718.856 0 607.1928 -386.1448 0 718.856 185.2157 0 0 0 1 0\n"
      "P2: 718.856 0 607.1928 45.38225 0 718.856 185.2157 -0.1130887 0 0 1 0.003779761\n"
      "P3: 718.856 0 607.1928 -337.2877 0 718.856 185.2157 2.369057 0 0 1 0.004915215\n",
      "c", KittiPair::kColour);
  EXPECT_NEAR(calibration.rig.baseline, 0.5323, 1e-4);
  EXPECT_NEAR(calibration.reference_from_left.translation.x(), -0.0599, 1e-4)
      << "camera 2 is left of camera 0";
  EXPECT_LT(calibration.reference_from_left.translation.tail<2>().norm(), 0.005);
}

// calib_cam_to_cam.txt of 2011_09_26, shortened.
TEST(Calibration, KittiRaw) {
  const char* text =
      "calib_time: 09-Jan-2012 13:57:47\ncorner_dist: 9.950000e-02\nS_00: 1.392000e+03 5.120000e+02\n"
      "S_rect_00: 1.242000e+03 3.750000e+02\n"
      "P_rect_00: 721.5377 0 609.5593 0 0 721.5377 172.854 0 0 0 1 0\nS_rect_01: 1.242000e+03 3.750000e+02\n"
      "P_rect_01: 721.5377 0 609.5593 -387.5744 0 721.5377 172.854 0 0 0 1 0\n";
  const StereoRig rig = parse_kitti_calibration(text, "c").rig;
  EXPECT_NEAR(rig.baseline, 0.5372, 1e-4);
  EXPECT_EQ(rig.width, 1242);
  EXPECT_EQ(rig.height, 375);
  EXPECT_THAT(message_of([&] { parse_kitti_calibration(text, "c", KittiPair::kColour); }),
              HasSubstr("no line 'P2:' (or 'P_rect_02:')"));
  std::string sizes = text;
  sizes.replace(sizes.rfind("3.75"), 4, "3.74");
  EXPECT_THAT(message_of([&] { parse_kitti_calibration(sizes, "c"); }),
              HasSubstr("S_rect_00 and S_rect_01 must be one image size"));
}

TEST(Calibration, KittiPairThatIsNoneIsExplained) {
  const auto message = [](const std::string& right) {
    return message_of([&] { parse_kitti_calibration("P0: 7 0 3 0 0 7 2 0 0 0 1 0\nP1: " + right, "c"); });
  };
  EXPECT_THAT(message("7 0 3.5 -3.5 0 7 2 0 0 0 1 0"),
              AllOf(HasSubstr("c: cx differs between P0 and P1: 3.0000 and 3.5000 px"),
                    HasSubstr("disparity at infinity is 0"), testing::Not(HasSubstr("rectified"))));
  EXPECT_THAT(message("8 0 3 -3.5 0 7 2 0 0 0 1 0"), HasSubstr("fx differs between P0 and P1: 7.0000 and 8"));
  EXPECT_THAT(message("7 0 3 -3.5 0 7 1 0 0 0 1 0"), HasSubstr("cy differs between P0 and P1: 2.0000 and 1"));
  EXPECT_THAT(message("7 0 3 3.5 0 7 2 0 0 0 1 0"), HasSubstr("swapped"));
  EXPECT_THAT(message("7 0 3"), HasSubstr("c:2: has 3 numbers"));
}

TEST(Calibration, YamlRoundTripIsExact) {
  StereoRig rig = small_rig();
  rig.fx = 1.0 / 3, rig.baseline = 0.1;
  const StereoRig read = parse_calibration_yaml(format_calibration_yaml(rig), "c").rig;
  EXPECT_EQ(read.fx, rig.fx);
  EXPECT_EQ(read.baseline, rig.baseline);
  EXPECT_EQ(read.width, rig.width);
  EXPECT_EQ(read.height, rig.height);
}

constexpr const char* kRaw =
    "width: 640\nheight: 480\n"
    "left: {fx: 400, fy: 401, cx: 320, cy: 240, model: equidistant, distortion: [0.01, 0.02, 0.03, 0.04]}\n"
    "right: {fx: 402, fy: 403, cx: 321, cy: 241, model: equidistant, distortion: [0.05, 0.06, 0.07, 0.08]}\n"
    "right_from_left: [1, 0, 0, -0.1, 0, 1, 0, 0, 0, 0, 1, 0]\n";

TEST(Calibration, YamlRawPair) {
  const StereoCalibration calibration = parse_calibration_yaml(kRaw, "c");
  ASSERT_TRUE(calibration.raw);
  EXPECT_EQ(calibration.raw->left.lens, LensModel::kEquidistant);
  EXPECT_THAT(calibration.raw->right.distortion, testing::ElementsAre(0.05, 0.06, 0.07, 0.08));
  EXPECT_EQ(calibration.raw->right.fy, 403);
  EXPECT_EQ(calibration.raw->right_from_left.translation.x(), -0.1);
}

// The files written out in the documentation: what they show can be copied.
TEST(Calibration, DocumentedFilesAreRead) {
  const fs::path file = fs::path(SPSLAM_TEST_DATA).parent_path().parent_path() / "docs" / "RECORDINGS.md";
  const std::string page = read_text_file(file), begin = "```yaml\n";
  std::vector<StereoCalibration> calibrations;
  for (std::size_t at = 0; (at = page.find(begin, at)) != std::string::npos;) {
    at += begin.size();
    calibrations.push_back(parse_calibration_yaml(page.substr(at, page.find("```", at) - at), "page"));
  }
  ASSERT_EQ(calibrations.size(), 2u);
  EXPECT_EQ(calibrations[0].rig.baseline, 0.08);
  ASSERT_TRUE(calibrations[1].raw);
  EXPECT_NEAR(Rectifier(*calibrations[1].raw).rig().baseline, 0.11, 0.001);
}

TEST(Calibration, EurocSensor) {
  const EurocSensor sensor = parse_euroc_sensor(euroc_sensor_text(0.08), "s");
  EXPECT_EQ(sensor.camera.width, 64);
  EXPECT_EQ(sensor.camera.fx, 50);
  EXPECT_EQ(sensor.camera.lens, LensModel::kRadtan);
  EXPECT_EQ(sensor.camera.distortion.size(), 4u);
  EXPECT_LT((sensor.body_from_camera.translation - Eigen::Vector3d(0.08, 0, 0.25)).norm(), 1e-12);
}

std::string with(std::string text, const std::string& what, const std::string& instead) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), instead);
}

std::string yaml_message(const std::string& text) {
  return message_of([&] { parse_calibration_yaml(text, "c"); });
}

TEST(Calibration, YamlThatIsWrongIsExplained) {
  const std::string good = format_calibration_yaml(small_rig());
  EXPECT_THAT(yaml_message(""), HasSubstr("c: holds no"));
  EXPECT_THAT(yaml_message("fx: [1"), HasSubstr("not valid YAML"));
  EXPECT_THAT(yaml_message(with(good, "baseline", "base_line")),
              AllOf(HasSubstr("c:8"), HasSubstr("mean 'baseline'")));
  EXPECT_THAT(yaml_message(with(good, "fx: 50", "fx: fifty")),
              AllOf(HasSubstr("c:4: fx"), HasSubstr("'fifty'")));
  EXPECT_THAT(yaml_message(with(good, "fx: 50", "fx: .nan")), HasSubstr("c:4: fx must be a finite number"));
  EXPECT_THAT(yaml_message(with(good, "fx: 50", "fx: -50")),
              HasSubstr("c: stereo calibration: focal length"));
  EXPECT_THAT(yaml_message(with(good, "fx: 50", "#")), HasSubstr("fx is missing"));
  EXPECT_THAT(yaml_message(with(good, "width: 64", "width: 6.4")), HasSubstr("whole number"));
  EXPECT_THAT(yaml_message(with(good, "width: 64", "width: 31")), HasSubstr("principal point"));
}

TEST(Calibration, RawYamlThatIsWrongIsExplained) {
  EXPECT_THAT(yaml_message(with(kRaw, "equidistant", "mirror")), HasSubstr("known are radtan"));
  EXPECT_THAT(yaml_message(with(kRaw, "equidistant", "radtan")), HasSubstr("same kind"));
  EXPECT_THAT(yaml_message(with(kRaw, "0.01, 0.02,", "0.01,")), HasSubstr("3 distortion coefficients"));
  EXPECT_THAT(yaml_message(with(kRaw, "-0.1", "0.1")), HasSubstr("swapped"));
  EXPECT_THAT(yaml_message(with(kRaw, "1, 0, 0, -0.1", "2, 0, 0, -0.1")), HasSubstr("rotation"));
  EXPECT_THAT(yaml_message(with(kRaw, "0, 0, 1, 0]", "0, 0, 1]")), HasSubstr("has 11"));
  EXPECT_THAT(yaml_message(with(kRaw, "{fx: 402", "{f: 402")), HasSubstr("unknown key 'f'"));
}

}  // namespace
}  // namespace spslam
