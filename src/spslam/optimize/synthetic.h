// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// A world whose truth is known, as a Problem: cameras along a gently turning way, points near and far, and
// what the cameras see of them with noise and mismatches. For the tests and benchmarks of whatever solves
// problems, without files.
#pragma once

#include <cstdint>

#include "spslam/optimize/problem.h"

namespace spslam {

struct SyntheticOptions {
  int cameras = 6;
  int hosts = 1;  // the first cameras, which see points first; bearings are in their cameras
  int points = 200;
  double step = 0.2;                   // m between cameras, forward and a little sideways
  double turn = 0.01;                  // rad between cameras, about all axes in turn
  double nearest = 2, farthest = 20;   // m along z, depths of near points (uniform inverse depth)
  double far_share = 0.3;              // of the points at infinity: inverse depth 0
  double position_sigma = 0.3;         // px, 1 sigma, of u and of v
  double disparity_sigma = 0.3;        // px, 1 sigma; also where the true disparity is 0
  double outlier_share = 0;            // of the observations that are off by 20 to 60 px
  bool noise = true;                   // false: exact observations, with the same weights
  Vector4d offset = Vector4d::Zero();  // px, disparity offset of the rig
  std::uint64_t seed = 1;
};

struct SyntheticWorld {
  // Observations with noise, everything else at its true value. The first pose is fixed. A host's own
  // observation is of the disparity only: its bearing is exact by definition.
  Problem truth;
  std::vector<char> is_outlier;  // one an observation
};

// The same world for the same options, on every machine.
SyntheticWorld make_synthetic_world(const SyntheticOptions& options);

// Moves free poses and inverse depths away from where they are: normal noise of these deviations.
struct Disturbance {
  double translation = 0.05;    // m
  double rotation = 0.01;       // rad
  double inverse_depth = 0.02;  // 1/m
  std::uint64_t seed = 1;
};
void disturb(Problem& problem, const Disturbance& disturbance);

}  // namespace spslam
