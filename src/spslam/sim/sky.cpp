// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/sim/sky.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "spslam/sim/texture.h"

namespace spslam::sim {
namespace {

using Eigen::Vector3f;

float ramp(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0F, 1.0F);
  return t * t * (3 - 2 * t);
}

float sky_colour(const Vector3f& d, const Vector3f& sun, const SkyOptions& options, std::uint32_t seed) {
  const auto cover = static_cast<float>(options.cloud_cover), strength = static_cast<float>(options.sun);
  const float low = 1 - d.z();
  const float clear = 0.62F + 0.6F * low * low * low;
  const float near_sun = std::max(0.0F, d.dot(sun));
  const float glow = strength * (0.25F * std::pow(near_sun, 8.0F) + 0.7F * std::pow(near_sun, 90.0F));
  // Clouds on a plane overhead; they close up towards the horizon.
  const float x = d.x() / (d.z() + 0.14F) / 24 + 0.5F, y = d.y() / (d.z() + 0.14F) / 24 + 0.5F;
  const float shape = tile_noise(x, y, 16, 7, seed + 3);
  const float edge = 0.45F - 0.95F * cover;
  const float cloud = ramp(edge, edge + 0.35F, shape) * ramp(0.0F, 0.06F, d.z() + 0.02F);
  const float lit = 1.1F + 0.6F * tile_noise(x, y, 40, 5, seed + 5) + 0.35F * strength * (0.4F + near_sun);
  return (clear + glow) * (1 - cloud) + cloud * std::max(0.45F, lit);
}

}  // namespace

Sky::Sky(const SkyOptions& options, std::uint32_t seed) : dome_(static_cast<std::size_t>(kSize) * kSize) {
  const auto radian = static_cast<float>(M_PI / 180);
  const float azimuth = static_cast<float>(options.sun_azimuth) * radian;
  const float elevation = static_cast<float>(options.sun_elevation) * radian;
  sun_direction_ = {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                    std::sin(elevation)};
  const auto brightness = static_cast<float>(options.brightness);
  tbb::parallel_for(0, kSize, [&](int j) {
    for (int i = 0; i < kSize; ++i) {
      const float x = 2.0F * (static_cast<float>(i) + 0.5F) / kSize - 1,
                  y = 2.0F * (static_cast<float>(j) + 0.5F) / kSize - 1;
      const float r2 = x * x + y * y;
      if (r2 > 1.02F) continue;  // below the horizon: nobody looks there
      const Vector3f direction(2 * x / (1 + r2), 2 * y / (1 + r2), std::max(0.0F, (1 - r2) / (1 + r2)));
      dome_[static_cast<std::size_t>(j) * kSize + static_cast<std::size_t>(i)] =
          brightness * sky_colour(direction.normalized(), sun_direction_, options, seed);
    }
  });
  sun_ = 1.5F * static_cast<float>(options.sun) * brightness;
  ambient_ = 0.8F * brightness;
  for (int i = 0; i < 64; ++i) {
    const float angle = 2 * static_cast<float>(M_PI) * static_cast<float>(i) / 64;
    horizon_ += radiance({std::cos(angle), std::sin(angle), 0.03F}) / 64;
  }
}

float Sky::radiance(const Vector3f& direction) const {
  const Vector3f d = direction.normalized();
  const float scale = 0.5F / (1 + std::max(0.0F, d.z()));
  const float x = std::clamp((d.x() * scale + 0.5F) * kSize - 0.5F, 0.0F, kSize - 1.001F);
  const float y = std::clamp((d.y() * scale + 0.5F) * kSize - 0.5F, 0.0F, kSize - 1.001F);
  const auto i = static_cast<std::size_t>(x), j = static_cast<std::size_t>(y);
  const float a = x - static_cast<float>(i), b = y - static_cast<float>(j);
  const float* row = &dome_[j * kSize + i];
  const float top = row[0] + a * (row[1] - row[0]);
  const float bottom = row[kSize] + a * (row[kSize + 1] - row[kSize]);
  return top + b * (bottom - top);
}

float Sky::glint(const Vector3f& direction) const {
  const float cosine = direction.dot(sun_direction_);
  if (cosine < 0.995F || sun_ <= 0) return 0;
  constexpr float kWidth = 0.014F;  // rad
  return 35 * sun_ * std::exp((cosine - 1) / (kWidth * kWidth));
}

}  // namespace spslam::sim
