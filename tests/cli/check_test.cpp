// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// `spslam check`, and what of it a run asks by itself.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "cli/run_fixture.h"

namespace spslam {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

using Check = Run;

// The scene with its eyes exchanged.
std::string swap_eyes(const std::string& scene) {
  fs::rename(scene + "/image_0", scene + "/image_2");
  fs::rename(scene + "/image_1", scene + "/image_0");
  fs::rename(scene + "/image_2", scene + "/image_1");
  return scene;
}

// The scene with right images whose rows lie lower.
std::string shift_rows(const std::string& scene, int rows) {
  for (const auto& entry : fs::directory_iterator(scene + "/image_1")) {
    cv::Mat image = cv::imread(entry.path(), cv::IMREAD_GRAYSCALE), shifted;
    cv::copyMakeBorder(image.rowRange(0, image.rows - rows), shifted, rows, 0, 0, 0, cv::BORDER_REPLICATE);
    cv::imwrite(entry.path(), shifted);
  }
  return scene;
}

nlohmann::json check_json(const std::string& dataset, int exit_code) {
  const ProcessResult result = run_spslam({"check", dataset, "--json"});
  EXPECT_EQ(result.exit_code, exit_code) << result.out << result.err;
  return nlohmann::json::parse(result.out);
}

TEST_F(Check, SoundRecording) {
  const ProcessResult result = run_spslam({"check", scene(), "--frames", "8"});
  EXPECT_EQ(result.exit_code, 0) << result.out;
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, AllOf(HasSubstr("8 of 8 sampled pairs"), HasSubstr("rows         ok"),
                                HasSubstr("in all       ok"), Not(HasSubstr("->"))));
}

TEST_F(Check, JsonHasFigures) {
  const nlohmann::json result = check_json(scene(), 0);
  EXPECT_EQ(result["judgement"], "ok");
  EXPECT_EQ(result["checks"].size(), 10U);
  EXPECT_EQ(result["checks"]["pairs"]["values"]["sampled"], 16) << "no more than there are";
  EXPECT_NEAR(result["checks"]["rows"]["values"]["median_px"], 0, 0.1);
  EXPECT_NEAR(result["checks"]["times"]["values"]["interval_s"], 0.1, 1e-9);
}

TEST_F(Check, SwappedEyesAreBadAndARunWarns) {
  const std::string swapped = swap_eyes(own_scene());
  const nlohmann::json result = check_json(swapped, 1);
  EXPECT_EQ(result["judgement"], "bad");
  EXPECT_EQ(result["checks"]["sign"]["judgement"], "bad");
  EXPECT_EQ(result["checks"]["rows"]["judgement"], "ok");
  EXPECT_THAT(run({}, swapped).err, HasSubstr("left and right seem to be swapped"));
}

TEST_F(Check, ShiftedRowsAreBadAndARunWarns) {
  const std::string shifted = shift_rows(own_scene(), 2);
  const nlohmann::json result = check_json(shifted, 1);
  EXPECT_EQ(result["checks"]["rows"]["judgement"], "bad");
  EXPECT_NEAR(result["checks"]["rows"]["values"]["median_px"], 2, 0.1);
  EXPECT_EQ(result["checks"]["sign"]["judgement"], "ok");
  EXPECT_THAT(run({}, shifted).err, AllOf(HasSubstr("2.0 px off"), HasSubstr("`spslam check`")));
}

TEST_F(Check, AMissingImageIsAWarning) {
  const std::string broken = own_scene();
  fs::remove(broken + "/image_1/" + test::scene_image_name(4));
  const nlohmann::json result = check_json(broken, 0);
  EXPECT_EQ(result["checks"]["pairs"]["judgement"], "warning");
  EXPECT_THAT(std::string(result["checks"]["pairs"]["advice"]), HasSubstr("000004.png"));
}

TEST_F(Check, OpensAsARunDoes) {
  EXPECT_EQ(run_spslam({"check", "/no/such/folder"}).exit_code, 1);
  EXPECT_EQ(run_spslam({"check", scene(), "--frames", "0"}).exit_code, 2);
  const ProcessResult rate = run_spslam({"check", scene(), "--rate", "20", "--json"});
  EXPECT_NEAR(nlohmann::json::parse(rate.out)["checks"]["times"]["values"]["interval_s"], 0.05, 1e-9);
}

// Published and rendered sequences are sound, up to warnings.
class CheckSharedData : public testing::TestWithParam<const char*> {};

TEST_P(CheckSharedData, NothingIsBad) {
  const fs::path folder = fs::path(SPSLAM_SHARED_DATA) / GetParam();
  if (!fs::is_directory(folder)) GTEST_SKIP() << folder.string() << " is not here; set SPSLAM_SHARED_DATA";
  const nlohmann::json result = check_json(folder, 0);
  for (const char* name : {"matches", "instants", "sign", "infinity", "disparities", "images", "calibration"})
    EXPECT_EQ(result["checks"][name]["judgement"], "ok") << name;
}

INSTANTIATE_TEST_SUITE_P(Sequences, CheckSharedData,
                         testing::Values("nearshore_bank", "nearshore_loop", "kitti_raw", "kitti_06",
                                         "euroc_still"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace spslam
