// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Each trouble of a real rig does what its name says.

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "sim/small_scene.h"

namespace spslam::sim {
namespace {

SimulatedFrame frame_of(const std::vector<std::string>& settings, std::uint32_t seed = 3) {
  SceneDescription scene = small_scene();
  scene.sensor.read_noise = 0;
  scene.sensor.full_well = 1e6;
  scene.sensor.gain_difference = 0;
  scene.render.samples = 8;
  for (const std::string& setting : settings) apply_setting(scene, setting);
  return *Simulator(scene, seed).next();
}

const SimulatedFrame& plain() {
  static const SimulatedFrame frame = frame_of({});
  return frame;
}

double difference(const cv::Mat& a, const cv::Mat& b) {
  return cv::norm(a, b, cv::NORM_L1) / static_cast<double>(a.total());
}

TEST(Effects, RowOffsetMovesTheRightImageDown) {
  const SimulatedFrame knocked = frame_of({"misalignment.row_offset=3"});
  const cv::Rect upper(0, 0, plain().images.right.cols, plain().images.right.rows - 3);
  const cv::Mat moved = knocked.images.right(upper + cv::Point(0, 3));
  EXPECT_LT(difference(moved, plain().images.right(upper)),
            0.5 * difference(knocked.images.right(upper), plain().images.right(upper)));
  EXPECT_EQ(difference(knocked.images.left, plain().images.left), 0);
}

TEST(Effects, DisparityOffsetMovesItToTheLeft) {
  const SimulatedFrame knocked = frame_of({"misalignment.disparity_offset=3"});
  const cv::Rect left(0, 0, plain().images.right.cols - 3, plain().images.right.rows);
  const cv::Mat original = plain().images.right(left + cv::Point(3, 0));
  EXPECT_LT(difference(knocked.images.right(left), original),
            0.5 * difference(knocked.images.right(left), plain().images.right(left)));
}

TEST(Effects, FogTakesContrast) {
  const auto spread = [](const cv::Mat& image) {
    cv::Scalar mean, deviation;
    cv::meanStdDev(image, mean, deviation);
    return deviation[0];
  };
  EXPECT_LT(spread(frame_of({"air.visibility=15"}).images.left), 0.5 * spread(plain().images.left));
}

TEST(Effects, TheRightEyeIsBrighterByTheGain) {
  const SimulatedFrame frame =
      frame_of({"sensor.gain_difference=0.1", "sensor.gamma=1", "sensor.exposure_bias=-2"});
  const SimulatedFrame same = frame_of({"sensor.gamma=1", "sensor.exposure_bias=-2"});
  EXPECT_NEAR(cv::mean(frame.images.right)[0] / cv::mean(same.images.right)[0], 1.1, 0.02);
  EXPECT_EQ(difference(frame.images.left, same.images.left), 0);
}

TEST(Effects, RainAndDropsChangeTheImage) {
  EXPECT_GT(difference(frame_of({"rain.intensity=1"}).images.left, plain().images.left), 0.5);
  EXPECT_GT(difference(frame_of({"rain.lens_drops=4"}).images.left, plain().images.left), 0.5);
}

TEST(Effects, BoatsAreMarkedAsMoving) {
  SceneDescription scene = small_scene();
  scene.traffic.boats = 6;
  scene.traffic.spread = 12;
  const Simulator simulator(scene, 4);
  int most = 0;
  for (double t = 0; t < simulator.motion().duration(); t += 0.5)
    most = std::max(most, cv::countNonZero(simulator.truth(t).moving));
  EXPECT_GT(most, 50);
}

TEST(Effects, DroppedFramesLeaveGapsAndTimesRise) {
  SceneDescription scene = small_scene();
  scene.timing.dropped = 0.4;
  scene.timing.timestamp_jitter = 0.05;
  scene.rig.width = 32, scene.rig.height = 16;
  Simulator simulator(scene, 4);
  int count = 0, last = -1;
  double time = -1;
  while (const auto frame = simulator.next()) {
    EXPECT_GT(frame->images.timestamp, time);
    EXPECT_GT(frame->index, last);
    time = frame->images.timestamp, last = frame->index, ++count;
  }
  EXPECT_LT(count, 0.8 * simulator.frame_count());
  EXPECT_GT(count, 0.4 * simulator.frame_count());
}

TEST(Effects, AnEyeThatIsLateSeesThePoseOfThen) {
  const SimulatedFrame late = frame_of({"timing.eye_delay=0.1"});
  EXPECT_EQ(difference(late.images.left, plain().images.left), 0);
  EXPECT_GT(difference(late.images.right, plain().images.right), 1);
}

TEST(Effects, WaterChangesFromFrameToFrame) {
  SceneDescription scene = small_scene();
  scene.motion = {0, 1.8, 0, 0, 0, 0, 0.7, 0.9, 0};  // the boat lies still ...
  scene.path.speed = 0.05, scene.path.speed_variation = 0;
  scene.sensor.read_noise = 0, scene.sensor.full_well = 1e6;
  scene.render.samples = 8;
  Simulator simulator(scene, 3);
  const cv::Mat first = simulator.next()->images.left;
  for (int i = 0; i < 3; ++i) simulator.next();
  const SimulatedFrame later = *simulator.next();
  const FrameTruth truth = simulator.truth(later.time);
  cv::Mat change, rigid;
  cv::absdiff(first, later.images.left, change);
  cv::bitwise_not(truth.water, rigid);
  EXPECT_GT(cv::mean(change, truth.water)[0], 2 * cv::mean(change, rigid)[0]);  // ... the water does not
}

TEST(Effects, AnotherSeedIsAnotherWorld) {
  EXPECT_GT(difference(frame_of({}, 4).images.left, plain().images.left), 3);
}

}  // namespace
}  // namespace spslam::sim
