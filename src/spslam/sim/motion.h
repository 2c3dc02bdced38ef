// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// How the boat moves: along its way at a changing speed, shaken by waves. All of it a smooth function of
// time, so that the inertial sensors can be differentiated from it.
//
// Roll, pitch, yaw, heave and sway are sums of sinusoids. Their spectrum is JONSWAP (Hasselmann et al., 1973;
// peak enhancement 3.3) with the period of MotionOptions, times the response of a damped second-order hull in
// roll, pitch and heave (natural frequencies of MotionOptions, damping 0.15 to 0.3); their size is given as
// an RMS. The frequencies are those met at rest: the change by the boat's own speed (0.5 to 2 m/s) is left
// out.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "spslam/base/se3.h"
#include "spslam/sim/scene_description.h"
#include "spslam/sim/way.h"

namespace spslam::sim {

// A stationary Gaussian process of RMS 1 as a sum of sinusoids.
class WaveProcess {
 public:
  struct Component {
    double amplitude, omega, phase;  // omega in rad/s
  };
  explicit WaveProcess(std::vector<Component> components) : components_(std::move(components)) {}
  double operator()(double time) const;
  const std::vector<Component>& components() const { return components_; }

 private:
  std::vector<Component> components_;
};

// JONSWAP power at a frequency in Hz, up to a factor.
double jonswap(double frequency, double peak_frequency);

class BoatMotion {
 public:
  BoatMotion(const SceneDescription& scene, std::uint32_t seed);

  const Way& way() const { return way_; }
  double duration() const { return duration_; }  // s, until the end of the way
  double travelled(double time) const;           // m along the way
  double speed(double time) const;               // m/s
  // Body: x to the bow, y to the left, z up, origin amidships on the water line. World: z up, calm water at z
  // = 0.
  SE3 world_from_body(double time) const;
  SE3 world_from_left(double time) const { return world_from_body(time) * body_from_left_; }
  const SE3& body_from_left() const { return body_from_left_; }

 private:
  double stop_factor(double time) const;

  SceneDescription scene_;
  Way way_;
  SE3 body_from_left_;
  WaveProcess roll_, pitch_, yaw_, heave_, sway_, shake_x_, shake_y_, shake_z_;
  double phase_[2];
  std::vector<double> travelled_;  // every kStep s
  double duration_ = 0;
  static constexpr double kStep = 0.02;
};

}  // namespace spslam::sim
