// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The boat's other sensors: an IMU and a GNSS receiver, with their usual faults.
#pragma once

#include <cstdint>
#include <vector>

#include "spslam/sim/motion.h"

namespace spslam::sim {

struct ImuSample {
  double time = 0;               // s
  Eigen::Vector3d angular_rate;  // rad/s, body axes (x bow, y left, z up)
  Eigen::Vector3d acceleration;  // m/s^2, specific force: at rest it is +9.81 upwards
};

// Without noise or bias, from the motion itself.
ImuSample true_imu(const BoatMotion& motion, double time);

// From 0 to `until` s. Discrete noise is density * sqrt(rate); biases start at random and walk.
std::vector<ImuSample> simulate_imu(const BoatMotion& motion, const ImuOptions& options, double until,
                                    std::uint32_t seed);

struct GnssFix {
  double time = 0;           // s
  Eigen::Vector3d position;  // m, of the body in the world (x east, y north, z up)
  double deviation = 0;      // m, what the receiver believes of itself per horizontal axis
};

// Fixes from 0 to `until` s; none during outages. White noise and a slow Gauss-Markov error; vertical errors
// are twice as large.
std::vector<GnssFix> simulate_gnss(const BoatMotion& motion, const GnssOptions& options, double until,
                                   std::uint32_t seed);

}  // namespace spslam::sim
