// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/sim/rain.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "spslam/sim/hash.h"

namespace spslam::sim {
namespace {

using Eigen::Vector3d;

struct Streak {
  Vector3d top, bottom;  // m, in the left camera's position but the world's axes
};

// Blends a segment of given width (px, >= 1 stands for thinner ones too) into the image.
void draw(cv::Mat& image, const Eigen::Vector2d& a, const Eigen::Vector2d& b, double width, float light,
          float strength) {
  const double margin = width + 1;
  const int x0 = std::max(0, static_cast<int>(std::min(a.x(), b.x()) - margin));
  const int x1 = std::min(image.cols - 1, static_cast<int>(std::max(a.x(), b.x()) + margin));
  const int y0 = std::max(0, static_cast<int>(std::min(a.y(), b.y()) - margin));
  const int y1 = std::min(image.rows - 1, static_cast<int>(std::max(a.y(), b.y()) + margin));
  const Eigen::Vector2d axis = b - a;
  const double squared = std::max(1e-9, axis.squaredNorm());
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const Eigen::Vector2d p(x, y);
      const double along = std::clamp((p - a).dot(axis) / squared, 0.0, 1.0);
      const double distance = (p - a - along * axis).norm();
      const auto cover = static_cast<float>(std::clamp(0.5 * width + 0.5 - distance, 0.0, 1.0));
      float& pixel = image.at<float>(y, x);
      pixel += cover * strength * (light - pixel);
    }
}

}  // namespace

void add_streaks(cv::Mat& radiance, const EyeView& left, const EyeView& view, double intensity,
                 float brightness, std::uint32_t key) {
  const int count = static_cast<int>(900 * intensity);
  constexpr double kExposure = 0.012, kFall = 7.0;  // s, m/s
  for (int i = 0; i < count; ++i) {
    const auto random = [&](std::uint32_t n) {
      return static_cast<double>(unit(mix(key, static_cast<std::uint32_t>(i), n)));
    };
    // Evenly in a cone before the camera, out to where a drop is too thin to be seen.
    const double z = 0.4 + 9.6 * std::cbrt(random(1));
    const Vector3d in_left((random(2) - 0.5) * 2.2 * z, (random(3) - 0.5) * 1.4 * z, z);
    const Vector3d start = left.world_from_eye * in_left;
    const Vector3d end = start + kExposure * Vector3d(0.8, 0.3, -kFall);
    const SE3 eye_from_world = view.world_from_eye.inverse();
    const Vector3d a = eye_from_world * start, b = eye_from_world * end;
    if (a.z() < 0.2 || b.z() < 0.2) continue;
    const auto pixel = [&](const Vector3d& p) {
      return Eigen::Vector2d(view.focal * p.x() / p.z() + view.cx, view.focal * p.y() / p.z() + view.cy);
    };
    const double width = view.focal * 0.0018 / z;
    const auto strength = static_cast<float>(0.35 * std::min(1.0, width));
    draw(radiance, pixel(a), pixel(b), std::max(1.0, width), brightness, strength);
  }
}

void add_lens_drops(cv::Mat& radiance, const RainOptions& options, double time, std::uint32_t eye,
                    std::uint32_t seed) {
  constexpr double kStay = 6;  // s
  if (options.lens_drops == 0) return;
  cv::Mat blurred;
  cv::GaussianBlur(radiance, blurred, cv::Size(0, 0), 0.25 * options.drop_size);
  for (int i = 0; i < options.lens_drops; ++i) {
    const std::uint32_t place = mix(seed, eye, static_cast<std::uint32_t>(i));
    const double clock = time / kStay + static_cast<double>(unit(place));
    const std::uint32_t drop =
        mix(place, static_cast<std::uint32_t>(static_cast<std::int64_t>(std::floor(clock))));
    const float cx = unit(drop) * static_cast<float>(radiance.cols),
                cy = unit(mix(drop, 1)) * static_cast<float>(radiance.rows);
    const float radius = static_cast<float>(options.drop_size) * (0.5F + unit(mix(drop, 2)));
    const int reach = static_cast<int>(1.3F * radius) + 1;
    for (int y = std::max(0, static_cast<int>(cy) - reach);
         y < std::min(radiance.rows, static_cast<int>(cy) + reach); ++y)
      for (int x = std::max(0, static_cast<int>(cx) - reach);
           x < std::min(radiance.cols, static_cast<int>(cx) + reach); ++x) {
        const float dx = (static_cast<float>(x) - cx) / radius, dy = (static_cast<float>(y) - cy) / radius;
        const float r = std::sqrt(dx * dx + dy * dy * (dy < 0 ? 0.8F : 1.1F));
        const float cover = std::clamp((1.15F - r) / 0.3F, 0.0F, 1.0F) * 0.85F;
        if (cover <= 0) continue;
        // The drop is a strong lens: a wide, inverted image.
        const int sx = std::clamp(static_cast<int>(cx - 4 * dx * radius), 0, radiance.cols - 1);
        const int sy = std::clamp(static_cast<int>(cy - 4 * dy * radius), 0, radiance.rows - 1);
        float& pixel = radiance.at<float>(y, x);
        pixel += cover * (blurred.at<float>(sy, sx) * (1.05F - 0.25F * r * r) - pixel);
      }
  }
}

}  // namespace spslam::sim
