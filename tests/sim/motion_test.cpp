// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/sim/motion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace spslam::sim {
namespace {

double rms(const WaveProcess& process) {
  double sum = 0;
  for (int i = 0; i < 20000; ++i) sum += std::pow(process(0.37 * i), 2);
  return std::sqrt(sum / 20000);
}

SceneDescription with_shape(PathShape shape, double length) {
  SceneDescription scene;
  scene.path.shape = shape;
  scene.path.length = length;
  return scene;
}

TEST(Motion, JonswapPeaksWhereItShould) {
  EXPECT_GT(jonswap(0.5, 0.5), jonswap(0.45, 0.5));
  EXPECT_GT(jonswap(0.5, 0.5), jonswap(0.55, 0.5));
  EXPECT_NEAR(jonswap(4, 0.5) / jonswap(2, 0.5), std::pow(2, -5), 1e-3);  // the tail falls as f^-5
}

TEST(Motion, AProcessHasItsRms) {
  const WaveProcess process({{std::sqrt(2.0), 1.3, 0.4}});
  EXPECT_NEAR(rms(process), 1, 0.01);
}

TEST(Motion, RollHasTheSizeAskedFor) {
  SceneDescription scene = with_shape(PathShape::kFollow, 1500);
  scene.path.bend = 0;
  scene.motion.yaw = scene.motion.pitch = scene.motion.jitter = 0;
  const BoatMotion motion(scene, 3);
  double sum = 0;
  int count = 0;
  for (double t = 0; t < motion.duration(); t += 0.21, ++count)
    sum += std::pow(so3_log(motion.world_from_body(t).rotation).x() * 180 / M_PI, 2);
  EXPECT_NEAR(std::sqrt(sum / count), scene.motion.roll, 0.15);
}

TEST(Motion, ALoopComesBackToItsStart) {
  const SceneDescription scene = with_shape(PathShape::kLoop, 200);
  const Way way(scene.path, 1);
  EXPECT_LT((way.position(way.round_length()) - way.position(0)).norm(), 1e-3);
  EXPECT_NEAR(way.heading(way.round_length()) - way.heading(0), 2 * M_PI, 1e-9);
}

TEST(Motion, ATurnComesBackTheOtherWay) {
  const SceneDescription scene = with_shape(PathShape::kTurn, 100);
  const Way way(scene.path, 1);
  EXPECT_NEAR(way.heading(100), M_PI, 1e-12);
  EXPECT_NEAR(way.position(100).x(), 0, 0.5);
  EXPECT_GT(std::abs(way.position(100).y()), scene.path.turn_radius);
}

TEST(Motion, ArcLengthIsArcLength) {
  const Way way(with_shape(PathShape::kFollow, 100).path, 4);
  double length = 0;
  for (int i = 0; i < 10000; ++i) length += (way.position(0.01 * (i + 1)) - way.position(0.01 * i)).norm();
  EXPECT_NEAR(length, 100, 1e-3);
}

TEST(Motion, TheBoatStops) {
  SceneDescription scene = with_shape(PathShape::kFollow, 60);
  scene.path.stops = 2;
  const BoatMotion motion(scene, 1);
  double still = 0;
  for (double t = 0; t < motion.duration(); t += 0.1)
    if (motion.speed(t) < 0.01) still += 0.1;
  EXPECT_NEAR(still, 2 * scene.path.stop_duration, 2);
}

TEST(Motion, TheLeftEyeIsWhereTheRigSays) {
  SceneDescription scene;
  scene.rig.tilt = 0;
  const BoatMotion motion(scene, 1);
  const SE3 body_from_left = motion.body_from_left();
  EXPECT_LT((body_from_left.translation - Eigen::Vector3d(0.4, 0.04, 0.8)).norm(), 1e-12);
  EXPECT_LT((body_from_left.rotation * Eigen::Vector3d(0, 0, 1) - Eigen::Vector3d(1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((body_from_left.rotation * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d(0, -1, 0)).norm(), 1e-12);
  scene.rig.tilt = 10;
  EXPECT_LT((BoatMotion(scene, 1).body_from_left().rotation * Eigen::Vector3d(0, 0, 1)).z(), -0.1);
}

// Another passage goes the same way with other waves.
TEST(BoatMotion, PassagesDifferInWavesOnly) {
  SceneDescription scene = load_scene("bank");
  const BoatMotion first(scene, 4);
  scene.passage = 2;
  const BoatMotion second(scene, 4);
  EXPECT_EQ(first.way().position(30), second.way().position(30));
  EXPECT_GT((first.world_from_left(3).translation - second.world_from_left(3).translation).norm(), 1e-3);
  EXPECT_LT((first.world_from_left(0.5).translation - second.world_from_left(0.5).translation).norm(), 1.0);
}

}  // namespace
}  // namespace spslam::sim
