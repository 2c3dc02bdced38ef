// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The water's surface: a sum of waves whose slopes tilt the mirror. Its height (centimetres) is left out of
// the geometry.
//
// Spectrum: JONSWAP for the wind and the fetch (Hasselmann et al., 1973), split over kWind waves of 0.05 m up
// to 2.5 times the peak's length, each in a direction spread about the wind's by a cosine-squared law;
// besides, kSwell long low waves (0.8 to 6 m, slopes of 0.012 RMS together) of boats that have passed.
// Deep-water dispersion with surface tension: omega^2 = g k + (sigma / rho) k^3.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "spslam/sim/scene_options.h"
#include "spslam/sim/sensor_options.h"

namespace spslam::sim {

inline constexpr int kLanes = 16;  // points and rays are treated in groups of so many
using Lanes = std::array<float, kLanes>;

class Water {
 public:
  Water(const WaterOptions& options, const RainOptions& rain, std::uint32_t seed);

  struct Wave {
    double k_x, k_y;          // turns per m
    double frequency;         // turns per s
    double phase;             // turns
    double slope_x, slope_y;  // amplitudes of the surface's slope
  };
  const std::vector<Wave>& waves() const { return waves_; }

  // The surface at one instant.
  class Surface {
   public:
    // Slopes dz/dx, dz/dy at the points (x, y), m, where a pixel covers `footprint` m. Waves shorter than
    // that are damped, as a sensor averages over them. A lane of negative footprint is not worked out.
    void slopes(const Lanes& x, const Lanes& y, const Lanes& footprint, Lanes& slope_x, Lanes& slope_y) const;

   private:
    friend class Water;
    void add_rings(const Lanes& x, const Lanes& y, const Lanes& footprint, Lanes& slope_x,
                   Lanes& slope_y) const;
    std::vector<std::array<float, 6>> waves_;  // k_x, k_y, phase, slope_x, slope_y, k squared (turns/m)
    double time_ = 0, rain_ = 0;
    std::uint32_t seed_ = 0;
  };
  Surface at(double time) const;

  static constexpr int kWind = 40, kSwell = 8;

 private:
  std::vector<Wave> waves_;
  double rain_ = 0;
  std::uint32_t seed_ = 0;
};

}  // namespace spslam::sim
