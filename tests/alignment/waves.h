// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// A texture that is a formula, so that it can be rendered under any motion without interpolation.
#pragma once

#include <array>
#include <cmath>
#include <functional>

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "spslam/base/random.h"

namespace spslam {

inline constexpr int kWidth = 160, kHeight = 120;

// A sum of sinusoids, so that it can be sampled anywhere exactly; shortest wavelength about 7 px.
class Texture {
 public:
  explicit Texture(std::uint64_t seed) {
    Random random(seed);
    for (Wave& wave : waves_) {
      const double length = random.uniform(7, 40), angle = random.uniform(0, 2 * M_PI);
      wave = {2 * M_PI / length * std::cos(angle), 2 * M_PI / length * std::sin(angle),
              random.uniform(0, 2 * M_PI)};
    }
  }
  double operator()(double x, double y) const {
    double sum = 0;
    for (const Wave& wave : waves_) sum += std::sin(wave.kx * x + wave.ky * y + wave.phase);
    return sum;
  }

 private:
  struct Wave {
    double kx, ky, phase;
  };
  std::array<Wave, 24> waves_;
};

// texture(map(pixel)), with gain, offset and noise.
inline cv::Mat render(const Texture& texture, const std::function<Eigen::Vector2d(double, double)>& map,
                      double gain = 8, double offset = 128, double noise = 0, std::uint64_t seed = 99) {
  cv::Mat image(kHeight, kWidth, CV_8UC1);
  Random random(seed);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const Eigen::Vector2d p = map(x, y);
      image.at<uchar>(y, x) =
          cv::saturate_cast<uchar>(offset + gain * texture(p.x(), p.y()) + noise * random.normal());
    }
  return image;
}

inline const auto kUnmoved = [](double x, double y) { return Eigen::Vector2d(x, y); };

}  // namespace spslam
