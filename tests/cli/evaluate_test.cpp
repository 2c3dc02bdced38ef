// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/process.h"

namespace spslam {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

// A half circle of 10 m radius in 10 s, scaled.
std::string tum(double scale, double start = 0) {
  std::string text = "# timestamp tx ty tz qx qy qz qw\n";
  for (int i = 0; i <= 100; ++i) {
    const double a = M_PI * i / 100;
    text += std::to_string(start + 0.1 * i) + " " + std::to_string(scale * 10 * (1 - std::cos(a))) + " 0 " +
            std::to_string(scale * 10 * std::sin(a)) + " 0 " + std::to_string(std::sin(a / 2)) + " 0 " +
            std::to_string(std::cos(a / 2)) + "\n";
  }
  return text;
}

std::string kitti_line(int count, double step) {
  std::string text;
  for (int i = 0; i < count; ++i) text += "1 0 0 0 0 1 0 0 0 0 1 " + std::to_string(step * i) + "\n";
  return text;
}

TEST(Evaluate, PrintsTheTable) {
  const TemporaryFolder files;
  const ProcessResult result =
      run_spslam({"evaluate", files.write("e.txt", tum(0.9)), files.write("t.txt", tum(1))});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("101 of 101 poses"), HasSubstr("ATE [m]"), HasSubstr("scale ratio 1.1111")));
}

TEST(Evaluate, JsonParses) {
  const TemporaryFolder files;
  const ProcessResult result = run_spslam({"evaluate", files.write("e.txt", tum(0.9)),
                                           files.write("t.txt", tum(1)), "--json", "--align", "sim3"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["align"], "sim3");
  EXPECT_NEAR(json["scale_ratio"].get<double>(), 1 / 0.9, 1e-6);
  EXPECT_LT(json["ate_m"]["rmse"].get<double>(), 1e-5);
  EXPECT_EQ(json["rpe_m_per_s"]["count"], 91);
}

// The estimate is in the world of a map that another run began somewhere else.
TEST(Evaluate, OriginsAndShareWithin) {
  const TemporaryFolder files;
  std::string estimate, truth;
  for (int i = 0; i < 10; ++i) {
    const double error = i < 7 ? 0.1 : 0.5;
    estimate += std::to_string(0.1 * i) + " " + std::to_string(3 + i + error) + " 0 0 0 0 0 1\n";
    truth += std::to_string(0.1 * i) + " " + std::to_string(i) + " 0 0 0 0 0 1\n";
  }
  // Both worlds turned by 90 degrees, that of the truth 3 m ahead of that of the estimate.
  const std::string map = files.write("map.txt", "0 -1 0 5 1 0 0 0 0 0 1 0\n");
  const std::string run = files.write("run.txt", "0 -1 0 5 1 0 0 3 0 0 1 0\n");
  const ProcessResult result = run_spslam(
      {"evaluate", files.write("e.txt", estimate), files.write("t.txt", truth), "--origin-estimate", map,
       "--origin-truth", run, "--align", "none", "--within", "0.3", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_NEAR(json["share_within"].get<double>(), 0.7, 1e-9);
  EXPECT_NEAR(json["ate_m"]["max"].get<double>(), 0.5, 1e-5);
}

// The map itself is 2 m beside the truth: localized in it, a run is where the map says, and no error is made.
TEST(Evaluate, TheRunThatMadeTheMapLaysItOnTheWorld) {
  const TemporaryFolder files;
  const auto bend = [](double beside) {
    std::string text;
    for (int i = 0; i < 20; ++i)
      text += std::to_string(0.1 * i) + " " + std::to_string(0.3 * i) + " " +
              std::to_string(0.02 * i * i + beside) + " 0 0 0 0 1\n";
    return text;
  };
  const std::string shifted = files.write("map_estimate.txt", bend(2)),
                    truth = files.write("map_truth.txt", bend(0));
  const std::vector<std::string> plain = {"evaluate", shifted, truth, "--align", "none", "--json"};
  std::vector<std::string> by_map = plain;
  by_map.insert(by_map.end(), {"--map-estimate", shifted, "--map-truth", truth});
  const auto error = [](const ProcessResult& result) {
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return nlohmann::json::parse(result.out)["ate_m"]["rmse"].get<double>();
  };
  EXPECT_NEAR(error(run_spslam(plain)), 2, 1e-5);
  EXPECT_NEAR(error(run_spslam(by_map)), 0, 1e-5);
  by_map.resize(by_map.size() - 2);
  EXPECT_THAT(run_spslam(by_map).err, HasSubstr("--map-truth"));
}

// The map is a tenth too long. Laid on the world as a whole it leaves half of that at each end, laid by its
// nearest pose nothing.
TEST(Evaluate, TheMapsOwnErrorCanBeLeftOut) {
  const TemporaryFolder files;
  const auto straight = [](double step) {
    std::string text;
    for (int i = 0; i < 21; ++i)
      text += std::to_string(0.1 * i) + " " + std::to_string(step * i) + " 0 0 0 0 0 1\n";
    return text;
  };
  const std::string longer = files.write("map_estimate.txt", straight(1.1)),
                    truth = files.write("map_truth.txt", straight(1));
  std::vector<std::string> arguments = {"evaluate", longer,           truth,  "--align",     "none",
                                        "--json",   "--map-estimate", longer, "--map-truth", truth};
  const auto worst = [&] {
    const ProcessResult result = run_spslam(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return nlohmann::json::parse(result.out)["ate_m"]["max"].get<double>();
  };
  EXPECT_NEAR(worst(), 1, 1e-5);
  arguments.emplace_back("--map-nearest");
  EXPECT_NEAR(worst(), 0, 1e-5);
  EXPECT_THAT(run_spslam({"evaluate", longer, truth, "--map-nearest"}).err, HasSubstr("--map-estimate"));
}

TEST(Evaluate, KittiFilesWithoutTimesGoByIndex) {
  const TemporaryFolder files;
  const ProcessResult result = run_spslam({"evaluate", files.write("e.txt", kitti_line(200, 1.01)),
                                           files.write("t.txt", kitti_line(200, 1)), "--json", "--kitti"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["associated_by"], "index");
  EXPECT_NEAR(json["kitti"]["t_rel_percent"].get<double>(), 1.01, 1e-3) << "101 m for 100 m";
  EXPECT_TRUE(json["rpe_m_per_s"]["mean"].is_null());
}

TEST(Evaluate, KittiTimesAreLentToTheOther) {
  const TemporaryFolder files;
  std::string times;
  for (int i = 0; i < 200; ++i) times += std::to_string(0.1 * i) + "\n";
  files.write("sequence/times.txt", times);
  const ProcessResult result =
      run_spslam({"evaluate", files.write("e.txt", kitti_line(200, 0.11)),
                  files.write("sequence/poses.txt", kitti_line(200, 0.1)), "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["associated_by"], "time");
  EXPECT_NEAR(json["rpe_m_per_s"]["rmse"].get<double>(), 0.1, 1e-4);
}

// Of a part of the sequence; the truth's times come by --times, as in the KITTI benchmark's folders.
TEST(Evaluate, TimesBesideAFileAreItsOwn) {
  const TemporaryFolder files;
  std::string times, own;
  for (int i = 0; i < 200; ++i) times += std::to_string(0.1 * i) + "\n";
  for (int i = 50; i < 150; ++i) own += std::to_string(0.1 * i) + "\n";
  files.write("run/trajectory_kitti_times.txt", own);
  const ProcessResult result = run_spslam(
      {"evaluate", files.write("run/trajectory_kitti.txt", kitti_line(100, 0.1)),
       files.write("poses.txt", kitti_line(200, 0.1)), "--times", files.write("t.txt", times), "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["associated_poses"], 100);
  EXPECT_EQ(json["associated_by"], "time");
}

TEST(Evaluate, PlanarTakesRtkGroundTruth) {
  const TemporaryFolder files;
  std::string gps;  // t, east, north, 7 more, heading: the half circle of tum() starting northwards
  for (int i = 0; i <= 50; ++i) {
    const double a = M_PI * i / 50;
    gps += std::to_string(0.2 * i) + "," + std::to_string(500 + 10 * (1 - std::cos(a))) + "," +
           std::to_string(80 + 10 * std::sin(a)) + ",0,0,0,0,0,0,0," + std::to_string(a * 180 / M_PI) + "\n";
  }
  const ProcessResult result =
      run_spslam({"evaluate", files.write("e.txt", tum(1)), files.write("GPSBase.csv", gps), "--planar",
                  "--interpolate", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["associated_poses"], 101);
  EXPECT_LT(json["ate_m"]["rmse"].get<double>(), 0.01);
  EXPECT_LT(json["rpe_deg_per_s"]["rmse"].get<double>(), 0.1);
}

TEST(Evaluate, WarnsOfATruthOfAnotherSequence) {
  const TemporaryFolder files;
  const std::string estimate = files.write("e.txt", tum(1)), truth = files.write("t.txt", tum(5.9));
  EXPECT_THAT(run_spslam({"evaluate", estimate, truth}).out,
              HasSubstr("WARNING: the estimate would have to be 5.9"));
  const ProcessResult json = run_spslam({"evaluate", estimate, truth, "--json"});
  EXPECT_EQ(json.exit_code, 0);
  EXPECT_THAT(json.err, HasSubstr("warning: the estimate would have to be 5.9"));
  EXPECT_EQ(nlohmann::json::parse(json.out)["warnings"].size(), 1U);
}

struct BadInput {
  const char* name;
  std::string estimate;  // "" leaves the file out
  std::string said;
};

class BadInputs : public testing::TestWithParam<BadInput> {};

TEST_P(BadInputs, AreExplainedOnStderrWithExitCodeOne) {
  const TemporaryFolder files;
  const std::string estimate =
      GetParam().estimate.empty() ? files.path("missing.txt") : files.write("e.txt", GetParam().estimate);
  const ProcessResult result = run_spslam({"evaluate", estimate, files.write("t.txt", tum(1))});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, AllOf(StartsWith("spslam: "), HasSubstr(GetParam().said)));
}

INSTANTIATE_TEST_SUITE_P(Cli, BadInputs,
                         testing::Values(BadInput{"Missing", "", "missing.txt"},
                                         BadInput{"NotATrajectory", "hello world\n", "e.txt"},
                                         BadInput{"NotFinite", "0 nan 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n",
                                                  "e.txt"},
                                         BadInput{"OtherClock", tum(1, 1e6), "one clock"},
                                         BadInput{"TooShort", "0 0 0 0 0 0 0 1\n", "only 1 poses"},
                                         BadInput{"NoTimes", kitti_line(5, 1), "--times"}),
                         [](const testing::TestParamInfo<BadInput>& test) { return test.param.name; });

TEST(Evaluate, AFolderIsNoTrajectory) {
  const TemporaryFolder files;
  const std::string truth = files.write("folder/t.txt", tum(1));
  const ProcessResult result = run_spslam({"evaluate", files.path("folder"), truth});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("is a folder"));
}

}  // namespace
}  // namespace spslam
