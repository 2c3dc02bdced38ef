// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/sim/water.h"

#include <gtest/gtest.h>

#include <cmath>

namespace spslam::sim {
namespace {

TEST(Water, SlopesAreTheSumOfTheWaves) {
  const Water water({}, {}, 5);
  const double time = 12.3;
  const Water::Surface surface = water.at(time);
  Lanes x, y, footprint{}, slope_x, slope_y;
  for (std::size_t i = 0; i < kLanes; ++i)
    x[i] = 0.37F * static_cast<float>(i) - 2, y[i] = 0.9F - 0.2F * static_cast<float>(i);
  surface.slopes(x, y, footprint, slope_x, slope_y);
  for (std::size_t i = 0; i < kLanes; ++i) {
    double sum_x = 0, sum_y = 0;
    for (const Water::Wave& wave : water.waves()) {
      const double turns = wave.k_x * static_cast<double>(x[i]) + wave.k_y * static_cast<double>(y[i]) +
                           wave.phase - wave.frequency * time;
      sum_x += wave.slope_x * std::cos(2 * M_PI * turns);
      sum_y += wave.slope_y * std::cos(2 * M_PI * turns);
    }
    EXPECT_NEAR(slope_x[i], sum_x, 1e-3);
    EXPECT_NEAR(slope_y[i], sum_y, 1e-3);
  }
}

TEST(Water, ShortWavesObeyGravityAndSurfaceTension) {
  const Water water({}, {}, 5);
  for (const Water::Wave& wave : water.waves()) {
    const double k = 2 * M_PI * std::hypot(wave.k_x, wave.k_y), omega = 2 * M_PI * wave.frequency;
    EXPECT_NEAR(omega * omega, 9.81 * k + 7.3e-5 * k * k * k, 1e-6 * omega * omega);
  }
}

TEST(Water, WindMakesItRougher) {
  const auto steepness = [](double wind) {
    WaterOptions options;
    options.wind = wind;
    const Water water(options, {}, 5);
    double sum = 0;
    for (const Water::Wave& wave : water.waves())
      sum += 0.5 * (wave.slope_x * wave.slope_x + wave.slope_y * wave.slope_y);
    return std::sqrt(sum);
  };
  EXPECT_LT(steepness(1), steepness(3));
  EXPECT_LT(steepness(3), steepness(8));
  EXPECT_LT(steepness(3), 0.35);
}

TEST(Water, FarWavesAreAveraged) {
  const Water::Surface surface = Water({}, {}, 5).at(0);
  Lanes x{}, y{}, near{}, far, a, b, c, d;
  far.fill(2);
  double sharp = 0, smooth = 0;
  for (int k = 0; k < 50; ++k) {
    for (std::size_t i = 0; i < kLanes; ++i)
      x[i] = 0.31F * static_cast<float>(i + 16U * static_cast<unsigned>(k));
    surface.slopes(x, y, near, a, b);
    surface.slopes(x, y, far, c, d);
    for (std::size_t i = 0; i < kLanes; ++i)
      sharp += static_cast<double>(a[i] * a[i]), smooth += static_cast<double>(c[i] * c[i]);
  }
  EXPECT_LT(smooth, 0.2 * sharp);
}

TEST(Water, RainMakesRings) {
  RainOptions rain;
  rain.intensity = 1;
  const Water::Surface dry = Water({}, {}, 5).at(1), wet = Water({}, rain, 5).at(1);
  Lanes x{}, y{}, footprint{}, a, b, c, d;
  int changed = 0;
  for (int k = 0; k < 50; ++k) {
    for (std::size_t i = 0; i < kLanes; ++i)
      x[i] = 0.05F * static_cast<float>(i + 16U * static_cast<unsigned>(k));
    dry.slopes(x, y, footprint, a, b);
    wet.slopes(x, y, footprint, c, d);
    for (std::size_t i = 0; i < kLanes; ++i) changed += a[i] != c[i];
  }
  EXPECT_GT(changed, 20);
}

}  // namespace
}  // namespace spslam::sim
