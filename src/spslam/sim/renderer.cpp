// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/sim/renderer.h"

#include <oneapi/tbb/blocked_range2d.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "spslam/sim/hash.h"

namespace spslam::sim {
namespace {

using Eigen::Vector3f;

constexpr int kTile = 16;  // px; tiles are rendered independently of each other

struct Camera {
  Eigen::Matrix3f rotation;
  Vector3f origin;
  float inverse_focal, cx, cy;
  explicit Camera(const EyeView& view)
      : rotation(view.world_from_eye.rotation.cast<float>()),
        origin(view.world_from_eye.translation.cast<float>()),
        inverse_focal(static_cast<float>(1 / view.focal)),
        cx(static_cast<float>(view.cx)),
        cy(static_cast<float>(view.cy)) {}
  // Of unit depth, so that a ray's parameter is the depth along the optical axis.
  Vector3f direction(float u, float v) const {
    return rotation * Vector3f((u - cx) * inverse_focal, (v - cy) * inverse_focal, 1);
  }
};

struct PixelSum {
  float sum = 0, low = 1e30F, high = -1e30F;
  int count = 0;
  void add(float value) {
    sum += value, ++count;
    low = std::min(low, value), high = std::max(high, value);
  }
  float mean() const { return sum / static_cast<float>(std::max(1, count)); }
};

struct Shot {
  int x, y;    // px within the tile
  int sample;  // its number within the pixel
};

class TileRenderer {
 public:
  TileRenderer(const Tracer& tracer, const Instant& instant, const EyeView& view,
               const RenderOptions& options, std::uint32_t key)
      : tracer_(tracer),
        instant_(instant),
        camera_(view),
        options_(options),
        key_(key),
        width_(view.width),
        height_(view.height) {}

  void render(int left, int top, cv::Mat& image) const {
    std::array<PixelSum, static_cast<std::size_t>(kTile) * kTile> sums{};
    const int columns = std::min(kTile, width_ - left), rows = std::min(kTile, height_ - top);
    std::vector<Shot> shots;
    shots.reserve(sums.size() * static_cast<std::size_t>(std::max(options_.samples, options_.edge_samples)));
    // Blocks of 4 x 4 pixels: neighbouring rays run through the same branches of the tree.
    for (int sample = 0; sample < options_.samples; ++sample)
      for (int block = 0; block < kTile * kTile; ++block) {
        const int x = block % 4 + 4 * (block / 16 % 4), y = block / 4 % 4 + 4 * (block / 64);
        if (x < columns && y < rows) shots.push_back({x, y, sample});
      }
    trace(left, top, shots, sums);
    shots.clear();
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x)
        if (uneven(sums, x, y, columns, rows))
          for (int i = 0; i < options_.edge_samples; ++i) shots.push_back({x, y, options_.samples + i});
    trace(left, top, shots, sums);
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x) image.at<float>(top + y, left + x) = sums[index(x, y)].mean();
  }

 private:
  static std::size_t index(int x, int y) { return static_cast<std::size_t>(y * kTile + x); }

  bool uneven(const std::array<PixelSum, static_cast<std::size_t>(kTile) * kTile>& sums, int x, int y,
              int columns, int rows) const {
    const PixelSum& own = sums[index(x, y)];
    const float limit = static_cast<float>(options_.edge_contrast) * (own.mean() + 0.05F);
    if (own.high - own.low > limit) return true;
    for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const int i = std::clamp(x + dx, 0, columns - 1), j = std::clamp(y + dy, 0, rows - 1);
      if (std::abs(sums[index(i, j)].mean() - own.mean()) > 1.5F * limit) return true;
    }
    return false;
  }

  void trace(int left, int top, const std::vector<Shot>& shots,
             std::array<PixelSum, static_cast<std::size_t>(kTile) * kTile>& sums) const {
    for (std::size_t start = 0; start < shots.size(); start += kLanes) {
      RayGroup rays;
      std::array<std::uint32_t, kLanes> key{};
      for (std::size_t i = 0; i < kLanes; ++i) {
        const int lane = static_cast<int>(i);
        if (start + i >= shots.size()) {
          rays.skip(lane);
          continue;
        }
        const Shot& shot = shots[start + i];
        const std::uint32_t pixel =
            mix(static_cast<std::uint32_t>(left + shot.x), static_cast<std::uint32_t>(top + shot.y), key_);
        key[i] = mix(pixel, static_cast<std::uint32_t>(shot.sample));
        // The R2 sequence (Roberts, 2018), shifted at random in every pixel, spreads any number of samples
        // evenly.
        const auto n = static_cast<float>(shot.sample);
        const float x = unit(pixel) + 0.7548777F * n, y = unit(mix(pixel, 77)) + 0.5698403F * n;
        const float whole_x = static_cast<float>(static_cast<int>(x)),
                    whole_y = static_cast<float>(static_cast<int>(y));
        rays.set(lane, camera_.origin,
                 camera_.direction(static_cast<float>(left + shot.x) - 0.5F + (x - whole_x),
                                   static_cast<float>(top + shot.y) - 0.5F + (y - whole_y)),
                 0.02F, 5000);
      }
      Lanes result{};
      tracer_.radiance(instant_, rays, camera_.inverse_focal, key, result);
      for (std::size_t i = 0; i < kLanes && start + i < shots.size(); ++i)
        sums[index(shots[start + i].x, shots[start + i].y)].add(result[i]);
    }
  }

  const Tracer& tracer_;
  const Instant& instant_;
  Camera camera_;
  const RenderOptions& options_;
  std::uint32_t key_;
  int width_, height_;
};

}  // namespace

cv::Mat render_view(const Tracer& tracer, const Instant& instant, const EyeView& view,
                    const RenderOptions& options, std::uint32_t key) {
  cv::Mat image(view.height, view.width, CV_32FC1);
  const TileRenderer renderer(tracer, instant, view, options, key);
  const int columns = (view.width + kTile - 1) / kTile, rows = (view.height + kTile - 1) / kTile;
  tbb::parallel_for(0, columns * rows, [&](int tile) {
    renderer.render(tile % columns * kTile, tile / columns * kTile, image);
  });
  if (options.lens_blur > 0)
    cv::GaussianBlur(image, image, cv::Size(5, 5), options.lens_blur, options.lens_blur,
                     cv::BORDER_REPLICATE);
  return image;
}

TruthImages render_truth(const Tracer& tracer, const Instant& instant, const EyeView& view,
                         double far_depth) {
  TruthImages truth;
  truth.depth.create(view.height, view.width, CV_32FC1);
  for (cv::Mat* mask : {&truth.water, &truth.sky, &truth.far, &truth.moving})
    *mask = cv::Mat::zeros(view.height, view.width, CV_8UC1);
  const Camera camera(view);
  tbb::parallel_for(0, view.height, [&](int y) {
    for (int start = 0; start < view.width; start += kLanes) {
      RayGroup rays;
      for (int lane = 0; lane < kLanes; ++lane) {
        if (start + lane >= view.width)
          rays.skip(lane);
        else
          rays.set(lane, camera.origin,
                   camera.direction(static_cast<float>(start + lane), static_cast<float>(y)), 0.02F, 5000);
      }
      tracer.intersect(instant, rays);
      for (int lane = 0; lane < kLanes && start + lane < view.width; ++lane) {
        const int x = start + lane;
        const float dz = rays.data.ray.dir_z[lane];
        const float water = dz < -1e-6F ? -rays.data.ray.org_z[lane] / dz : 5000;
        const bool hit = rays.target(lane) != Target::kNone && rays.data.ray.tfar[lane] < water;
        const float depth = hit ? rays.data.ray.tfar[lane] : water < 5000 ? water : 0;
        truth.depth.at<float>(y, x) = depth;
        truth.water.at<std::uint8_t>(y, x) = !hit && depth > 0 ? 255 : 0;
        truth.sky.at<std::uint8_t>(y, x) = depth > 0 ? 0 : 255;
        truth.far.at<std::uint8_t>(y, x) = depth > 0 && depth <= static_cast<float>(far_depth) ? 0 : 255;
        truth.moving.at<std::uint8_t>(y, x) = hit && rays.target(lane) == Target::kBoat ? 255 : 0;
      }
    }
  });
  return truth;
}

}  // namespace spslam::sim
