// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/sim/way.h"

#include <algorithm>
#include <cmath>

#include "spslam/base/random.h"

namespace spslam::sim {

double smooth_step(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * x * (10 + x * (6 * x - 15));
}

Way::Way(const PathOptions& options, std::uint32_t seed) : options_(options) {
  Random random(seed + 11);
  for (double& phase : phase_) phase = random.uniform(0, 2 * M_PI);
  const auto direction = [&](double s) {
    return Eigen::Vector2d(std::cos(heading(s)), std::sin(heading(s)));
  };
  // Simpson's rule a step: its error is far below a float's resolution of the scene.
  Eigen::Vector2d point(0, 0);
  const int before = static_cast<int>(std::lround(kPrologue / kStep));
  const int count = before + static_cast<int>(std::ceil((options.length + kEpilogue) / kStep)) + 2;
  for (int i = 0; i < count; ++i) {
    points_.push_back(point);
    const double s = (i - before) * kStep;
    point += kStep / 6 * (direction(s) + 4 * direction(s + kStep / 2) + direction(s + kStep));
  }
  const Eigen::Vector2d origin = points_[static_cast<std::size_t>(before)];
  for (Eigen::Vector2d& p : points_) p -= origin;
}

double Way::round_length() const {
  return options_.length / 1.06;
}

double Way::turn_length() const {
  return 1.875 * M_PI * options_.turn_radius;
}  // 1.875: steepest slope of smooth_step

double Way::turn_start() const {
  return 0.5 * (options_.length - turn_length());
}

double Way::heading(double s) const {
  const double turns = 2 * M_PI / options_.bend_length;
  switch (options_.shape) {
    case PathShape::kTurn:
      return M_PI * smooth_step((s - turn_start()) / turn_length());
    case PathShape::kLoop: {
      // Even harmonics keep heading(s + half) = heading(s) + pi, so the curve closes exactly.
      const double angle = 2 * M_PI * s / round_length();
      return angle + 0.55 * options_.bend * (std::sin(2 * angle) + 0.4 * std::sin(4 * angle + 1));
    }
    case PathShape::kFollow:
      break;
  }
  const auto swing = [&](double at) {
    return 0.75 * std::sin(turns * at + phase_[0]) + 0.25 * std::sin(2.3 * turns * at + phase_[1]);
  };
  return options_.bend * (swing(s) - swing(0));
}

Eigen::Vector2d Way::position(double s) const {
  const double cell = (s + kPrologue) / kStep;
  const auto i = static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(points_.size()) - 2));
  const double x = cell - static_cast<double>(i);
  const double at = static_cast<double>(i) * kStep - kPrologue;
  const auto tangent = [&](double where) {
    return Eigen::Vector2d(kStep * Eigen::Vector2d(std::cos(heading(where)), std::sin(heading(where))));
  };
  // Cubic Hermite interpolation.
  const double x2 = x * x, x3 = x2 * x;
  return (2 * x3 - 3 * x2 + 1) * points_[i] + (x3 - 2 * x2 + x) * tangent(at) +
         (3 * x2 - 2 * x3) * points_[i + 1] + (x3 - x2) * tangent(at + kStep);
}

}  // namespace spslam::sim
