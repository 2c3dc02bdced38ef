// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// `spslam run` as a user sees it: its files, and what becomes of them when something is wrong.

#include <gmock/gmock.h>

#include <Eigen/Eigenvalues>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <thread>

#include "cli/run_fixture.h"

namespace spslam {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kFiles[] = {"trajectory_tum.txt",
                                  "trajectory_kitti.txt",
                                  "trajectory_kitti_times.txt",
                                  "frames.csv",
                                  "covariance.csv",
                                  "keyframes.csv",
                                  "mapping.csv",
                                  "loops.csv",
                                  "config.yaml",
                                  "metrics.json",
                                  "timing.json",
                                  "log.txt",
                                  "samples"};

TEST_F(Run, WritesEveryFile) {
  const ProcessResult result_ = run({"--realtime"});
  ASSERT_EQ(result_.exit_code, 0) << result_.err;
  EXPECT_EQ(result_.err, "") << "no progress without a terminal";
  EXPECT_THAT(result_.out, AllOf(HasSubstr("16 tracking"), HasSubstr("ATE [m]"), HasSubstr(out())));
  for (const char* file : kFiles)
    EXPECT_TRUE(fs::is_directory(out() + "/" + file) || !result(file).empty()) << file;
  EXPECT_EQ(std::distance(fs::directory_iterator(out()), {}), std::ssize(kFiles)) << "and nothing else";
  EXPECT_EQ(std::distance(fs::directory_iterator(out() + "/samples"), {}), 6);
  EXPECT_FALSE(result("samples/frame_000001.png").empty());
  EXPECT_EQ(lines("trajectory_kitti.txt"), 16U);
  EXPECT_EQ(parse_tum(result("trajectory_tum.txt"), "").size(), 16U);
  ASSERT_EQ(frames().size(), 16U);
  EXPECT_EQ(frames()[5].state, "tracking");
  EXPECT_DOUBLE_EQ(frames()[5].timestamp, 0.5);
  EXPECT_TRUE(frames()[0].keyframe);
  EXPECT_GT(lines("keyframes.csv"), 1U);
  EXPECT_THAT(result("config.yaml"), HasSubstr("threads: sequential"));
  const auto metrics = nlohmann::json::parse(result("metrics.json"));
  EXPECT_LT(metrics["ate_m"]["rmse"], 0.01);
  const auto timing = nlohmann::json::parse(result("timing.json"));
  EXPECT_GT(timing["peak_rss_mb"], 1);
  for (const char* stage : {"decode", "front_end", "follow", "motion", "window", "keyframe", "total"}) {
    const auto& spread = timing["stages"][stage];
    EXPECT_LE(spread["p50"], spread["p95"]) << stage;
    EXPECT_LE(spread["p95"], spread["max"]) << stage;
  }
}

TEST_F(Run, SamplesShowNearAndFarFeatures) {
  ASSERT_EQ(run({"--samples", "2"}).exit_code, 0);
  const cv::Mat picture = cv::imread(out() + "/samples/frame_000004.png");
  ASSERT_FALSE(picture.empty());
  const auto drawn = [&](const cv::Scalar& colour) {
    cv::Mat same;
    cv::inRange(picture, colour, colour, same);
    return cv::countNonZero(same);
  };
  EXPECT_GT(drawn({0, 220, 0}), 100);  // near
  EXPECT_GT(drawn({0, 0, 255}), 5);    // far
  std::ofstream(out() + "/samples/notes.txt") << "mine";
  ASSERT_EQ(run({"--samples", "0", "--overwrite"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(out() + "/samples/frame_000004.png"));
  EXPECT_EQ(result("samples/notes.txt"), "mine");
}

TEST_F(Run, ReportReadsTheFolder) {
  ASSERT_EQ(run({}).exit_code, 0);
  const ProcessResult report = run_spslam({"report", out()});
  EXPECT_EQ(report.exit_code, 0) << report.err;
  EXPECT_EQ(report.err, "");
  EXPECT_THAT(result("report.html"), AllOf(HasSubstr("front_end"), HasSubstr("tracker.window_frames"),
                                           HasSubstr("ATE RMSE"), HasSubstr("16 of 16")));
}

TEST_F(Run, EffectiveConfigGivesTheSameRunAgain) {
  ASSERT_EQ(run({"--preset", "baseline", "--set", "tracker.follow.max_missed=3"}).exit_code, 0);
  const std::string first = result("trajectory_tum.txt");
  const std::string config = scratch.write("first.yaml", result("config.yaml"));
  ASSERT_EQ(run({"--overwrite", "--config", config}).exit_code, 0);
  EXPECT_EQ(result("trajectory_tum.txt"), first);
  EXPECT_THAT(result("config.yaml"), AllOf(HasSubstr("# options from: " + config),
                                           HasSubstr("# options: preset baseline with threads=sequential, "
                                                     "tracker.follow.max_missed=3\n")));
}

TEST_F(Run, SaysWhatWasRun) {
  const std::string map = scratch.path("a \n map"), calibration = scene() + "/calib.txt";
  ASSERT_EQ(
      run({"--start", "2", "--end", "12", "--rate", "5", "--calibration", calibration, "--save-map", map})
          .exit_code,
      0);
  for (const char* file : {"config.yaml", "log.txt"})
    EXPECT_THAT(result(file),
                AllOf(HasSubstr("spslam 0."), HasSubstr("spslam run " + scene() + " --output " + out()),
                      HasSubstr("data set: " + scene()), HasSubstr("frames: --start 2, --end 12"),
                      HasSubstr("rate: 5"), HasSubstr("calibration: " + calibration),
                      HasSubstr("saved map: '" + scratch.path("a ? map'"))))
        << file;
  EXPECT_EQ(run_spslam({"config", "--config", out() + "/config.yaml"}).exit_code, 0);
}

TEST_F(Run, TwiceGivesTheSameBytes) {
  ASSERT_EQ(run({}).exit_code, 0);
  const std::string tum = result("trajectory_tum.txt"), kitti = result("trajectory_kitti.txt");
  ASSERT_NE(tum, "");
  ASSERT_EQ(run({"--overwrite", "--quiet"}).exit_code, 0);
  EXPECT_EQ(result("trajectory_tum.txt"), tum);
  EXPECT_EQ(result("trajectory_kitti.txt"), kitti);
}

// The n-th line of a table below its head, by the names of the columns.
std::map<std::string, std::string> row_of(const std::string& table, std::size_t n) {
  std::istringstream lines(table);
  std::string head, line;
  std::getline(lines, head);
  for (std::size_t i = 0; i <= n; ++i) std::getline(lines, line);
  std::map<std::string, std::string> row;
  std::istringstream names(head), values(line);
  for (std::string name; std::getline(names, name, ',');) std::getline(values, row[name], ',');
  return row;
}

TEST_F(Run, KeyframesOfALoadedMapAreNotOfThisRunsFrames) {
  const std::string map = scratch.path("a.map");
  ASSERT_EQ(run({"--end", "8", "--save-map", map}).exit_code, 0);
  EXPECT_EQ(row_of(result("keyframes.csv"), 0)["frame"], "0");
  EXPECT_NE(row_of(result("keyframes.csv"), 0)["reason"], "loaded");
  const std::size_t loaded = lines("keyframes.csv") - 1;
  for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--localize"}}) {
    std::vector<std::string> arguments = {"--overwrite", "--start", "3", "--load-map", map};
    arguments.insert(arguments.end(), more.begin(), more.end());
    ASSERT_EQ(run(arguments).exit_code, 0);
    const std::string table = result("keyframes.csv");
    ASSERT_GE(lines("keyframes.csv"), loaded);
    if (!more.empty()) {
      EXPECT_THAT(result("log.txt"), testing::ContainsRegex("found in the map at [01]\\.[0-9]+ s,"));
    }
    for (std::size_t i = 0; i + 1 < lines("keyframes.csv"); ++i) {
      auto row = row_of(table, i);
      const bool is_loaded = row["reason"] == "loaded";
      EXPECT_EQ(is_loaded, row["frame"].empty()) << i;
      EXPECT_TRUE(is_loaded || i > 0) << "the oldest is the map's";
      EXPECT_TRUE(is_loaded || std::abs(std::stod(row["timestamp"]) - 0.1 * std::stod(row["frame"])) < 1e-6)
          << i;
    }
  }
}

TEST_F(Run, PartOfTheFramesQuietly) {
  const ProcessResult part = run({"--start", "4", "--end", "9", "--quiet"});
  EXPECT_EQ(part.exit_code, 0);
  EXPECT_EQ(part.out + part.err, "");
  ASSERT_EQ(frames().size(), 5U);
  EXPECT_DOUBLE_EQ(frames()[0].timestamp, 0.4);
  EXPECT_THAT(result("frames.csv"), HasSubstr("\n4,0.4"));
  EXPECT_EQ(lines("trajectory_kitti.txt"), 5U);
  const ProcessResult error =
      run_spslam({"evaluate", out() + "/trajectory_kitti.txt", scene() + "/poses.txt", "--json"});
  ASSERT_EQ(error.exit_code, 0) << error.err;
  EXPECT_EQ(nlohmann::json::parse(error.out)["associated_poses"], 5) << "by trajectory_kitti_times.txt";
}

// The whole of it, as a filter needs it: symmetric as given, positive, and what frames.csv makes of it.
TEST_F(Run, CovarianceOfEachPose) {
  const std::string dataset = own_scene();
  fs::resize_file(fs::path(dataset) / "image_0" / test::scene_image_name(0), 0);
  ASSERT_EQ(run({}, dataset).exit_code, 0);
  ASSERT_EQ(lines("covariance.csv"), 17U);
  EXPECT_THAT(result("covariance.csv"),
              testing::StartsWith("frame,timestamp,tx_tx,tx_ty,tx_tz,tx_rx,tx_ry,tx_rz,ty_ty,"));
  auto none = row_of(result("covariance.csv"), 0);
  EXPECT_EQ(none.size(), 23U);
  EXPECT_EQ(none["tx_tx"] + none["rz_rz"] + row_of(result("frames.csv"), 0)["sigma_translation_m"], "");
  const std::vector<std::string> axes = {"tx", "ty", "tz", "rx", "ry", "rz"};
  for (const std::size_t frame : {std::size_t{1}, std::size_t{15}}) {
    auto row = row_of(result("covariance.csv"), frame);
    Matrix6d covariance;
    for (int i = 0; i < 6; ++i)
      for (int j = i; j < 6; ++j)
        covariance(i, j) = covariance(j, i) = std::stod(row[axes[i] + "_" + axes[j]]);
    EXPECT_GT(covariance.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0);
    const double sigma = std::stod(row_of(result("frames.csv"), frame)["sigma_rotation_rad"]);
    EXPECT_NEAR(std::sqrt(covariance.bottomRightCorner<3, 3>().trace()), sigma, 1e-3 * sigma);
  }
}

TEST_F(Run, FramesBeforeTheFirstPoseRepeatIt) {
  const std::string dataset = own_scene();
  for (const int i : {0, 1}) fs::resize_file(fs::path(dataset) / "image_0" / test::scene_image_name(i), 0);
  ASSERT_EQ(run({}, dataset).exit_code, 0);
  EXPECT_EQ(frames()[1].state, "initializing");
  EXPECT_EQ(parse_tum(result("trajectory_tum.txt"), "").size(), 14U);
  const Trajectory rows = parse_kitti_poses(result("trajectory_kitti.txt"), "");
  ASSERT_EQ(rows.size(), 16U);
  EXPECT_EQ(rows[0].world_from_camera.translation, rows[2].world_from_camera.translation);
  EXPECT_NE(rows[2].world_from_camera.translation, rows[3].world_from_camera.translation);
}

TEST_F(Run, EveryColumnIsDocumented) {
  ASSERT_EQ(run({}).exit_code, 0);
  const std::string page = read_file(SPSLAM_SOURCE "/docs/FORMATS.md");
  for (const char* file : {"frames.csv", "covariance.csv", "keyframes.csv", "mapping.csv", "loops.csv"}) {
    const std::size_t section = page.find(std::string("### `") + file);
    ASSERT_NE(section, std::string::npos) << file;
    const std::string table = page.substr(section, page.find("\n#", section + 1) - section);
    std::istringstream head(result(file).substr(0, result(file).find('\n')));
    for (std::string column; std::getline(head, column, ',');)
      EXPECT_THAT(table, HasSubstr("`" + column + "`")) << file;
  }
  for (const char* file : {"metrics.json", "timing.json"}) {
    const nlohmann::json json = nlohmann::json::parse(result(file));
    for (const auto& [key, value] : json.items()) EXPECT_THAT(page, HasSubstr("`" + key + "`")) << file;
  }
}

struct BadRun {
  const char* name;
  std::vector<std::string> arguments;
  int exit_code;
  std::vector<std::string> said;
};

void PrintTo(const BadRun& row, std::ostream* out) {
  *out << row.name;
}

class RefusedRun : public Run, public testing::WithParamInterface<BadRun> {};

TEST_P(RefusedRun, LeavesNoResults) {
  const ProcessResult refused = run(GetParam().arguments);
  EXPECT_EQ(refused.exit_code, GetParam().exit_code);
  EXPECT_EQ(refused.out, "");
  for (const std::string& part : GetParam().said) EXPECT_THAT(refused.err, HasSubstr(part));
  EXPECT_FALSE(fs::exists(out()));
}

INSTANTIATE_TEST_SUITE_P(
    Cli, RefusedRun,
    testing::Values(BadRun{"UnknownKey", {"--set", "tracker.folow.align=false"}, 2, {"tracker.follow.align"}},
                    BadRun{"UnknownOption", {"--sequental"}, 2, {"--sequential"}},
                    BadRun{"NoSuchFrames", {"--start", "99"}, 2, {"99", "16"}},
                    BadRun{"EmptyRange", {"--start", "5", "--end", "5"}, 2, {"start"}},
                    BadRun{"UnknownFormat", {"--format", "kiti"}, 2, {"kitti"}},
                    BadRun{"RateOutOfRange", {"--rate", "-1"}, 2, {"--rate", "-1"}},
                    BadRun{"ToleranceOutOfRange", {"--pair-tolerance", "2"}, 2, {"--pair-tolerance"}},
                    BadRun{"DepthOutOfRange", {"--bit-depth", "17"}, 2, {"--bit-depth"}},
                    BadRun{"OtherFormat", {"--format", "euroc"}, 1, {"sensor.yaml"}},
                    BadRun{"MissingCalibration", {"--calibration", "none.yaml"}, 1, {"none.yaml"}}),
    [](const testing::TestParamInfo<BadRun>& row) { return row.param.name; });

TEST_F(Run, MissingDatasetIsAnInputError) {
  const ProcessResult refused = run({}, scratch.path("none"));
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, HasSubstr("does not exist"));
}

TEST_F(Run, BrokenTruthOfTheFolderIsAWarning) {
  const std::string dataset = own_scene(), poses = dataset + "/poses.txt";
  std::ofstream(poses) << "1 0 0 0 0 1 0 0 0 0 1 0\n";
  const ProcessResult done = run({}, dataset);
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.err, HasSubstr("no ground truth"));
  EXPECT_THAT(result("log.txt"), HasSubstr("1 poses for 16 times"));
  EXPECT_FALSE(fs::exists(out() + "/metrics.json"));
  const ProcessResult refused = run({"--overwrite", "--truth", poses}, dataset);
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, HasSubstr("1 poses for 16 times"));
}

TEST_F(Run, CalibrationOfAnotherSizeIsAnInputError) {
  StereoRig rig = test::scene_rig();
  rig.width = 640, rig.height = 400, rig.cx = 319.5, rig.cy = 199.5;
  const std::string file = scratch.write("other.yaml", format_calibration_yaml(rig));
  const ProcessResult refused = run({"--calibration", file});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("640 x 400"), HasSubstr("320 x 200")));
}

// The loop closer is not waited for, so there is none.
TEST_F(Run, ThreadsWaitForTheMapAndGiveTheSequentialBytes) {
  ASSERT_EQ(run({"--set", "loop.enabled=false"}).exit_code, 0);
  const std::string sequential = result("trajectory_tum.txt");
  const ProcessResult threads = run_spslam(
      {"run", scene(), "--output", out(), "--overwrite", "--quiet", "--set", "loop.enabled=false"});
  ASSERT_EQ(threads.exit_code, 0) << threads.err;
  EXPECT_EQ(result("trajectory_tum.txt"), sequential);
}

TEST_F(Run, AheadOfTheMapIsForThreadsAtTheirOwnPace) {
  EXPECT_EQ(run({"--ahead"}).exit_code, 2) << "--sequential";
  const ProcessResult sequential =
      run_spslam({"run", scene(), "--output", out(), "--ahead", "--set", "threads=sequential"});
  EXPECT_EQ(sequential.exit_code, 2);
  EXPECT_THAT(sequential.err, AllOf(HasSubstr("--ahead"), HasSubstr("threads=sequential")));
  EXPECT_EQ(run_spslam({"run", scene(), "--output", out(), "--ahead", "--realtime"}).exit_code, 2);
  EXPECT_EQ(run_spslam({"run", scene(), "--output", out(), "--ahead"}).exit_code, 0);
  EXPECT_EQ(frames().size(), 16U);
}

class RunInterrupted : public Run, public testing::WithParamInterface<int> {};

TEST_P(RunInterrupted, WritesWhatWasDone) {
  // A frame each five seconds: the end is far away when the signal comes.
  RunningSpslam running({"run", scene(), "--output", out(), "--realtime", "--rate", "0.2"});
  for (int i = 0; i < 6000 && result("log.txt").find("frame 0: tracking") == std::string::npos; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  running.send(GetParam());
  const ProcessResult interrupted = running.wait();
  EXPECT_EQ(interrupted.exit_code, 128 + GetParam());
  EXPECT_THAT(interrupted.err, HasSubstr("interrupted after"));
  ASSERT_GE(frames().size(), 1U);
  EXPECT_LT(frames().size(), 16U);
  EXPECT_EQ(lines("trajectory_kitti.txt"), frames().size());
  EXPECT_EQ(parse_tum(result("trajectory_tum.txt"), "").size(), frames().size());
  for (const char* file : {"keyframes.csv", "config.yaml", "timing.json"})
    EXPECT_NE(result(file), "") << file;
}

INSTANTIATE_TEST_SUITE_P(Cli, RunInterrupted, testing::Values(SIGINT, SIGTERM, SIGHUP));

TEST_F(Run, AKillLeavesTheLastCheckpoint) {
  const std::string map = scratch.path("a.map");
  RunningSpslam running({"run", scene(), "--output", out(), "--realtime", "--rate", "2", "--checkpoint",
                         "0.1", "--set", "tracker.window_frames=2", "--save-map", map});
  for (int i = 0; i < 6000 && !fs::exists(map); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  running.send(SIGKILL);
  EXPECT_EQ(running.wait().exit_code, 128 + SIGKILL);
  EXPECT_FALSE(fs::exists(out() + "/frames.csv"));
  EXPECT_GE(parse_tum(result("trajectory_tum.txt"), "").size(), 1U);
  EXPECT_EQ(run_spslam({"export-map", map, "-o", scratch.path("a.ply")}).exit_code, 0);
  const ProcessResult report = run_spslam({"report", out()});
  EXPECT_EQ(report.exit_code, 0);
  EXPECT_THAT(report.err, HasSubstr("frames.csv is not there"));
}

TEST_F(Run, CheckpointsChangeNothing) {
  ASSERT_EQ(run({"--checkpoint", "0"}).exit_code, 0);
  const std::string tum = result("trajectory_tum.txt"), keyframes = result("keyframes.csv");
  ASSERT_EQ(run({"--overwrite", "--checkpoint", "0.000001", "--save-map", scratch.path("a.map")}).exit_code,
            0);
  EXPECT_EQ(result("trajectory_tum.txt"), tum);
  EXPECT_EQ(result("keyframes.csv"), keyframes);
}

}  // namespace
}  // namespace spslam
