// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/sim/inertial.h"

#include <cmath>

#include "spslam/base/random.h"

namespace spslam::sim {
namespace {

using Eigen::Vector3d;

Vector3d normal3(Random& random) {
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return {x, y, z};
}

}  // namespace

ImuSample true_imu(const BoatMotion& motion, double time) {
  constexpr double kStep = 1e-3;  // s; central differences, error below 1e-4 of 25 Hz shaking
  const SE3 before = motion.world_from_body(time - kStep), now = motion.world_from_body(time),
            after = motion.world_from_body(time + kStep);
  const Vector3d turn = so3_log(before.rotation.transpose() * after.rotation) / (2 * kStep);
  const Vector3d acceleration =
      (after.translation - 2 * now.translation + before.translation) / (kStep * kStep);
  return {time, turn, now.rotation.transpose() * (acceleration + Vector3d(0, 0, 9.81))};
}

std::vector<ImuSample> simulate_imu(const BoatMotion& motion, const ImuOptions& options, double until,
                                    std::uint32_t seed) {
  std::vector<ImuSample> samples;
  if (options.rate <= 0) return samples;
  Random random(seed + 101);
  Vector3d gyro_bias = options.gyro_bias * normal3(random), accel_bias = options.accel_bias * normal3(random);
  const double root = std::sqrt(options.rate);
  const int count = static_cast<int>(std::floor(until * options.rate + 1e-9)) + 1;
  for (int i = 0; i < count; ++i) {
    ImuSample sample = true_imu(motion, i / options.rate);
    sample.angular_rate += gyro_bias + options.gyro_noise * root * normal3(random);
    sample.acceleration += accel_bias + options.accel_noise * root * normal3(random);
    gyro_bias += options.gyro_walk / root * normal3(random);
    accel_bias += options.accel_walk / root * normal3(random);
    samples.push_back(sample);
  }
  return samples;
}

std::vector<GnssFix> simulate_gnss(const BoatMotion& motion, const GnssOptions& options, double until,
                                   std::uint32_t seed) {
  std::vector<GnssFix> fixes;
  if (options.rate <= 0) return fixes;
  Random random(seed + 103);
  const double step = 1 / options.rate, keep = std::exp(-step / options.wander_time);
  Vector3d slow = options.wander * normal3(random);
  bool out = random.uniform() < options.outages;
  // Rates of a two-state process whose share of time without a fix is options.outages.
  const double back = step / options.outage_duration;
  const double lose = options.outages < 1 ? back * options.outages / (1 - options.outages) : 1;
  for (int i = 0; i * step <= until + 1e-9; ++i) {
    const Vector3d error = slow + options.noise * normal3(random);
    if (!out)
      fixes.push_back({i * step,
                       motion.world_from_body(i * step).translation + error.cwiseProduct(Vector3d(1, 1, 2)),
                       std::hypot(options.noise, options.wander)});
    slow = keep * slow + options.wander * std::sqrt(1 - keep * keep) * normal3(random);
    out = random.uniform() < (out ? 1 - back : lose);
  }
  return fixes;
}

}  // namespace spslam::sim
