// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/sim/inertial.h"

#include <gtest/gtest.h>

#include <cmath>

namespace spslam::sim {
namespace {

SceneDescription scene() {
  SceneDescription result;
  result.path.length = 40;
  return result;
}

TEST(Inertial, IntegratedItIsTheMotion) {
  const BoatMotion motion(scene(), 2);
  const double step = 0.002, start = 3, end = 8;
  SE3 pose = motion.world_from_body(start);
  Eigen::Vector3d velocity =
      (motion.world_from_body(start + 1e-4).translation - motion.world_from_body(start - 1e-4).translation) /
      2e-4;
  for (double t = start; t < end - 1e-9; t += step) {
    const ImuSample sample = true_imu(motion, t + step / 2);  // the midpoint rule
    const Eigen::Matrix3d middle = pose.rotation * so3_exp(0.5 * step * sample.angular_rate);
    const Eigen::Vector3d acceleration = middle * sample.acceleration - Eigen::Vector3d(0, 0, 9.81);
    pose.translation += step * velocity + 0.5 * step * step * acceleration;
    velocity += step * acceleration;
    pose.rotation = pose.rotation * so3_exp(step * sample.angular_rate);
  }
  const SE3 truth = motion.world_from_body(end);
  EXPECT_LT(so3_log(truth.rotation.transpose() * pose.rotation).norm(), 1e-4);
  EXPECT_LT((truth.translation - pose.translation).norm(), 0.01);
}

TEST(Inertial, NoiseAndBiasAreAsAskedFor) {
  const BoatMotion motion(scene(), 2);
  ImuOptions options;
  options.gyro_bias = options.gyro_walk = 0;
  const auto samples = simulate_imu(motion, options, 30, 5);
  ASSERT_EQ(samples.size(), 3001U);
  double sum = 0;
  for (const ImuSample& sample : samples)
    sum += (sample.angular_rate - true_imu(motion, sample.time).angular_rate).squaredNorm() / 3;
  EXPECT_NEAR(std::sqrt(sum / static_cast<double>(samples.size())), options.gyro_noise * 10, 0.0005);
}

TEST(Inertial, GnssHasOutages) {
  const BoatMotion motion(scene(), 2);
  GnssOptions options;
  options.outages = 0.3;
  options.outage_duration = 4;
  const auto fixes = simulate_gnss(motion, options, 2000, 5);
  EXPECT_NEAR(static_cast<double>(fixes.size()), 0.7 * 10001, 800);
  double longest = 0;
  for (std::size_t i = 1; i < fixes.size(); ++i)
    longest = std::max(longest, fixes[i].time - fixes[i - 1].time);
  EXPECT_GT(longest, 3);
}

TEST(Inertial, NoStreamWithoutARate) {
  const BoatMotion motion(scene(), 2);
  ImuOptions imu;
  GnssOptions gnss;
  imu.rate = gnss.rate = 0;
  EXPECT_TRUE(simulate_imu(motion, imu, 10, 1).empty());
  EXPECT_TRUE(simulate_gnss(motion, gnss, 10, 1).empty());
}

}  // namespace
}  // namespace spslam::sim
