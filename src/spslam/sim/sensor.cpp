// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/sim/sensor.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "spslam/sim/hash.h"

namespace spslam::sim {
namespace {

// A sunny day's exposure; brighter settings are gain, and gain is noise.
constexpr double kDaylight = -1.2;

// Fast standard normal: the sum of four uniforms of 16 bits has kurtosis 2.7 instead of 3, good enough for
// noise.
float quick_normal(std::uint32_t key) {
  const std::uint32_t a = mix(key), b = mix(a ^ 0x9e3779b9U);
  const auto sum = static_cast<float>((a & 0xffffU) + (a >> 16U) + (b & 0xffffU) + (b >> 16U));
  return (sum * (1.0F / 65536) - 2) * 1.7320508F;
}

}  // namespace

double AutoExposure::wanted(const cv::Mat& radiance) const {
  double low = -8, high = kDaylight + options_.max_gain;
  for (int step = 0; step < 16; ++step) {
    const double middle = 0.5 * (low + high);
    const auto scale = static_cast<float>(std::exp2(middle));
    double sum = 0;
    int count = 0;
    for (int y = 4; y < radiance.rows; y += 8)
      for (int x = 4; x < radiance.cols; x += 8, ++count)
        sum += std::pow(std::clamp(radiance.at<float>(y, x) * scale, 0.0F, 1.0F),
                        1 / static_cast<float>(options_.gamma));
    (sum < options_.target * std::max(1, count) ? low : high) = middle;
  }
  return std::min(high + options_.exposure_bias, kDaylight + options_.max_gain);
}

void AutoExposure::observe(const cv::Mat& radiance, double elapsed) {
  const double target = wanted(radiance);
  if (!settled_) {
    exact_ = applied_ = target;
    settled_ = true;
    return;
  }
  const double follow = options_.exposure_delay > 0 ? 1 - std::exp(-elapsed / options_.exposure_delay) : 1;
  exact_ += follow * (target - exact_);
  if (std::abs(exact_ - applied_) >= options_.exposure_step) applied_ = exact_;
}

cv::Mat expose(const cv::Mat& radiance, double exposure_log2, double gain, const SensorOptions& options,
               std::uint32_t key) {
  cv::Mat image(radiance.size(), CV_8UC1);
  const auto scale = static_cast<float>(std::exp2(exposure_log2) * gain);
  const auto amplification = static_cast<float>(std::exp2(std::max(0.0, exposure_log2 - kDaylight)));
  const float shot = amplification / static_cast<float>(options.full_well);
  const float read = amplification * static_cast<float>(options.read_noise) / 255;
  const float cx = 0.5F * static_cast<float>(radiance.cols - 1),
              cy = 0.5F * static_cast<float>(radiance.rows - 1);
  const float fall = static_cast<float>(options.vignetting) / (cx * cx + cy * cy);
  std::array<std::uint8_t, 4097> curve{};
  for (std::size_t i = 0; i < curve.size(); ++i)
    curve[i] = static_cast<std::uint8_t>(
        std::lround(255 * std::pow(static_cast<double>(i) / 4096, 1 / options.gamma)));
  tbb::parallel_for(0, radiance.rows, [&](int y) {
    const auto* from = radiance.ptr<float>(y);
    auto* to = image.ptr<std::uint8_t>(y);
    const float dy = static_cast<float>(y) - cy;
    const std::uint32_t row_key = mix(static_cast<std::uint32_t>(y), key);
    for (int x = 0; x < radiance.cols; ++x) {
      const float dx = static_cast<float>(x) - cx;
      const float signal = from[x] * scale * (1 - fall * (dx * dx + dy * dy));
      const float noise = std::sqrt(std::max(0.0F, signal) * shot + read * read) *
                          quick_normal(row_key + 0x9e3779b9U * static_cast<std::uint32_t>(x));
      const float value = std::clamp(signal + noise, 0.0F, 1.0F);
      to[x] = curve[static_cast<std::size_t>(value * 4096)];
    }
  });
  return image;
}

}  // namespace spslam::sim
