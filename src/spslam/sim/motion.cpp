// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/sim/motion.h"

#include <cmath>
#include <functional>

#include "spslam/base/random.h"

namespace spslam::sim {
namespace {

constexpr double kRadian = M_PI / 180;

// Components at random frequencies within equal bands, so that the sum does not repeat.
WaveProcess make_process(double low, double high, const std::function<double(double)>& power, Random random) {
  constexpr int kCount = 28;
  std::vector<WaveProcess::Component> parts;
  double variance = 0;
  for (int i = 0; i < kCount; ++i) {
    const double frequency = low + (high - low) * (i + random.uniform()) / kCount;
    const double amplitude = std::sqrt(2 * power(frequency) * (high - low) / kCount);
    parts.push_back({amplitude, 2 * M_PI * frequency, random.uniform(0, 2 * M_PI)});
    variance += 0.5 * amplitude * amplitude;
  }
  for (auto& part : parts) part.amplitude /= std::sqrt(variance);
  return WaveProcess(std::move(parts));
}

// Power gain of a damped second-order system.
double response(double frequency, double natural, double damping) {
  const double ratio = frequency / natural;
  const double real = 1 - ratio * ratio, imaginary = 2 * damping * ratio;
  return 1 / (real * real + imaginary * imaginary);
}

SE3 mount(const RigOptions& rig) {
  Eigen::Matrix3d level;  // columns: camera right, down, forward in the body's axes
  level << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  const Eigen::Matrix3d pan = so3_exp({0, 0, rig.pan * kRadian});
  const Eigen::Matrix3d tilt = so3_exp({-rig.tilt * kRadian, 0, 0});  // about camera x: the axis turns down
  return {pan * level * tilt, Eigen::Vector3d(rig.forward, 0.5 * rig.baseline, rig.above_water)};
}

}  // namespace

double jonswap(double frequency, double peak_frequency) {
  const double ratio = peak_frequency / frequency;
  const double width = frequency <= peak_frequency ? 0.07 : 0.09;
  const double bump = (frequency / peak_frequency - 1) / width;
  return std::pow(frequency, -5) * std::exp(-1.25 * std::pow(ratio, 4)) *
         std::pow(3.3, std::exp(-0.5 * bump * bump));
}

double WaveProcess::operator()(double time) const {
  double sum = 0;
  for (const Component& part : components_) sum += part.amplitude * std::sin(part.omega * time + part.phase);
  return sum;
}

BoatMotion::BoatMotion(const SceneDescription& scene, std::uint32_t seed)
    : scene_(scene),
      way_(scene.path, seed),
      body_from_left_(mount(scene.rig)),
      roll_({}),
      pitch_({}),
      yaw_({}),
      heave_({}),
      sway_({}),
      shake_x_({}),
      shake_y_({}),
      shake_z_({}) {
  const MotionOptions& m = scene.motion;
  const std::uint32_t own = scene.passage_seed(seed);
  const double peak = 1 / m.wave_period;
  const auto hull = [&](double natural, double damping, std::uint32_t stream) {
    const auto power = [&](double f) { return jonswap(f, peak) * response(f, natural, damping); };
    return make_process(0.45 * peak, 3.5 * peak, power, Random(own * 977U + stream));
  };
  roll_ = hull(m.roll_frequency, 0.15, 1);
  pitch_ = hull(m.pitch_frequency, 0.3, 2);
  heave_ = hull(m.pitch_frequency, 0.3, 3);
  // Yaw and sway follow slowly: the hull is steered, and has no spring in either.
  const auto steered = [&](std::uint32_t stream) {
    return make_process(
        0.03, 0.6, [](double f) { return 1 / (1 + std::pow(f / 0.12, 2)); }, Random(own * 977U + stream));
  };
  yaw_ = steered(4);
  sway_ = steered(5);
  const auto engine = [&](std::uint32_t stream) {
    return make_process(
        8, 25, [](double) { return 1.0; }, Random(own * 977U + stream));
  };
  shake_x_ = engine(6), shake_y_ = engine(7), shake_z_ = engine(8);
  Random random(own + 23);
  for (double& phase : phase_) phase = random.uniform(0, 2 * M_PI);
  const double limit = 20 * scene.path.length / scene.path.speed + 1000;
  for (double s = 0, t = 0; t < limit; t += kStep) {
    travelled_.push_back(s);
    if (s >= scene.path.length && duration_ == 0) duration_ = t;
    if (s >= scene.path.length + 5 * scene.path.speed + 1) break;
    s += kStep / 6 * (speed(t) + 4 * speed(t + kStep / 2) + speed(t + kStep));
  }
}

double BoatMotion::stop_factor(double time) const {
  const PathOptions& path = scene_.path;
  constexpr double kRamp = 3;  // s to come to a halt
  double factor = 1;
  for (int i = 0; i < path.stops; ++i) {
    const double begin =
        (i + 1.0) / (path.stops + 1) * path.length / path.speed + i * (path.stop_duration + kRamp);
    const double down = smooth_step((time - begin) / kRamp);
    const double up = smooth_step((time - begin - kRamp - path.stop_duration) / kRamp);
    factor *= 1 - down + up;
  }
  return factor;
}

double BoatMotion::speed(double time) const {
  const PathOptions& path = scene_.path;
  const double change =
      0.7 * std::sin(2 * M_PI * time / 23 + phase_[0]) + 0.3 * std::sin(2 * M_PI * time / 7.3 + phase_[1]);
  return path.speed * (1 + path.speed_variation * change) * stop_factor(time);
}

double BoatMotion::travelled(double time) const {
  const double cell = std::max(0.0, time) / kStep;
  const auto i = static_cast<std::size_t>(std::min(cell, static_cast<double>(travelled_.size()) - 2));
  const double x = cell - static_cast<double>(i), at = static_cast<double>(i) * kStep;
  const double x2 = x * x, x3 = x2 * x;
  return (2 * x3 - 3 * x2 + 1) * travelled_[i] + (x3 - 2 * x2 + x) * kStep * speed(at) +
         (3 * x2 - 2 * x3) * travelled_[i + 1] + (x3 - x2) * kStep * speed(at + kStep) +
         std::min(0.0, time) * speed(0);
}

SE3 BoatMotion::world_from_body(double time) const {
  const MotionOptions& m = scene_.motion;
  const double size = m.wave_height / 0.12 * kRadian;
  const double s = travelled(time);
  const double heading = way_.heading(s);
  const Eigen::Vector2d at = way_.position(s);
  const double sway = 2 * m.heave * m.wave_height / 0.12 * sway_(time);
  const Eigen::Matrix3d rotation = so3_exp({0, 0, heading + size * m.yaw * yaw_(time)}) *
                                   so3_exp({0, size * m.pitch * pitch_(time), 0}) *
                                   so3_exp({size * m.roll * roll_(time), 0, 0});
  const double shake = m.jitter * kRadian;
  const Eigen::Vector3d shaken(shake * shake_x_(time), shake * shake_y_(time), shake * shake_z_(time));
  const double heave = m.heave * m.wave_height / 0.12 * heave_(time);
  return {rotation * so3_exp(shaken),
          {at.x() - sway * std::sin(heading), at.y() + sway * std::cos(heading), heave}};
}

}  // namespace spslam::sim
