// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/alignment/patch_aligner.h"

#include <Eigen/LU>

#include "spslam/base/simd.h"

namespace spslam {
namespace {

constexpr int kMaxRows = 15;
constexpr int kStride =
    16;  // floats a row; columns beyond the patch have zero weight, so that loops have a fixed length
constexpr int kWide = 24;                  // floats a row of the template with a frame of one pixel around it
constexpr float kLeastCorrelation = 0.5F;  // whatever the noise

// The template on one level and what of it does not depend on the target: deviations t from its mean, and
// gradients with the mean and the part along t taken out, so that offset and gain of brightness drop out of
// the normal equations.
struct Template {
  alignas(64) float ones[kMaxRows * kStride];  // 1 inside the patch, 0 in the padding
  alignas(64) float t[kMaxRows * kStride];
  alignas(64) float gx[kMaxRows * kStride];
  alignas(64) float gy[kMaxRows * kStride];
  int rows = 0;
  float energy = 0;  // sum of t^2
  Eigen::Matrix2f hessian, inverse_hessian;
};

struct Sums {
  float value = 0, square = 0, along_t = 0, along_x = 0, along_y = 0;
};

// True if a patch of this radius around (x, y), plus a frame of one pixel, is inside the level and its
// border.
bool readable(const cv::Mat& level, float x, float y) {
  return x >= 0 && y >= 0 && x <= static_cast<float>(level.cols - 1) &&
         y <= static_cast<float>(level.rows - 1);
}

SPSLAM_SIMD void sample_upright(const unsigned char* data, std::size_t step, float x, float y, int radius,
                                int rows, float* out, int stride, int columns) {
  const int ix = static_cast<int>(std::floor(x)), iy = static_cast<int>(std::floor(y));
  const float ax = x - static_cast<float>(ix), ay = y - static_cast<float>(iy);
  const float w00 = (1 - ax) * (1 - ay), w01 = ax * (1 - ay), w10 = (1 - ax) * ay, w11 = ax * ay;
  for (int r = 0; r < rows; ++r) {
    const unsigned char* a = data + static_cast<std::ptrdiff_t>(step) * (iy - radius + r) + (ix - radius);
    const unsigned char* b = a + step;
    float* o = out + r * stride;
    for (int c = 0; c < columns; ++c)
      o[c] = w00 * static_cast<float>(a[c]) + w01 * static_cast<float>(a[c + 1]) +
             w10 * static_cast<float>(b[c]) + w11 * static_cast<float>(b[c + 1]);
  }
}

// As above, but the grid is turned and stretched by `warp` (from-offsets of target offsets).
bool sample_warped(const cv::Mat& level, float x, float y, const Eigen::Matrix2f& warp, int radius,
                   float* out, int stride) {
  constexpr float kMargin = AlignmentPyramid::kBorder - 2;
  const float reach_x = static_cast<float>(radius) * (std::abs(warp(0, 0)) + std::abs(warp(0, 1)));
  const float reach_y = static_cast<float>(radius) * (std::abs(warp(1, 0)) + std::abs(warp(1, 1)));
  if (reach_x > kMargin || reach_y > kMargin) return false;
  for (int r = -radius; r <= radius; ++r) {
    for (int c = -radius; c <= radius; ++c) {
      const float sx = x + warp(0, 0) * static_cast<float>(c) + warp(0, 1) * static_cast<float>(r);
      const float sy = y + warp(1, 0) * static_cast<float>(c) + warp(1, 1) * static_cast<float>(r);
      const int ix = static_cast<int>(std::floor(sx)), iy = static_cast<int>(std::floor(sy));
      const float ax = sx - static_cast<float>(ix), ay = sy - static_cast<float>(iy);
      const unsigned char* a = level.data + static_cast<std::ptrdiff_t>(level.step) * iy + ix;
      const unsigned char* b = a + level.step;
      out[(r + radius) * stride + c + radius] =
          (1 - ay) * ((1 - ax) * static_cast<float>(a[0]) + ax * static_cast<float>(a[1])) +
          ay * ((1 - ax) * static_cast<float>(b[0]) + ax * static_cast<float>(b[1]));
    }
  }
  return true;
}

SPSLAM_SIMD float dot(const float* a, const float* b, int n) {
  float lanes[kStride] = {};
  for (int i = 0; i < n; i += kStride)
    for (int k = 0; k < kStride; ++k) lanes[k] += a[i + k] * b[i + k];
  float sum = 0;
  for (const float lane : lanes) sum += lane;
  return sum;
}

SPSLAM_SIMD void subtract(float* a, const float* b, float factor, int n) {
  for (int i = 0; i < n; ++i) a[i] -= factor * b[i];
}

// Central differences of the framed samples, and the samples themselves, into the padded arrays.
void fill_template(const float* wide, int size, Template& out) {
  out.rows = size;
  for (int r = 0; r < size; ++r) {
    const float* row = wide + (r + 1) * kWide + 1;
    for (int c = 0; c < kStride; ++c) {
      const bool inside = c < size;
      const int i = r * kStride + c;
      out.ones[i] = inside ? 1.0F : 0.0F;
      out.t[i] = inside ? row[c] : 0.0F;
      out.gx[i] = inside ? 0.5F * (row[c + 1] - row[c - 1]) : 0.0F;
      out.gy[i] = inside ? 0.5F * (row[c + kWide] - row[c - kWide]) : 0.0F;
    }
  }
}

// Removes mean and gain directions and prepares the 2 x 2 system. False for a patch without structure in both
// directions.
bool finish_template(Template& p, float min_contrast) {
  const int n = p.rows * kStride;
  const auto count = static_cast<float>(p.rows * p.rows);
  subtract(p.t, p.ones, dot(p.t, p.ones, n) / count, n);
  p.energy = dot(p.t, p.t, n);
  if (p.energy < min_contrast * min_contrast * count) return false;
  for (float* g : {p.gx, p.gy}) {
    subtract(g, p.ones, dot(g, p.ones, n) / count, n);
    subtract(g, p.t, dot(g, p.t, n) / p.energy, n);
  }
  p.hessian(0, 0) = dot(p.gx, p.gx, n);
  p.hessian(0, 1) = p.hessian(1, 0) = dot(p.gx, p.gy, n);
  p.hessian(1, 1) = dot(p.gy, p.gy, n);
  const float determinant = p.hessian.determinant();
  const float trace = p.hessian.trace();
  if (!(determinant > 1e-3F * trace * trace)) return false;
  p.inverse_hessian = p.hessian.inverse();
  return true;
}

bool make_template(const cv::Mat& level, const Eigen::Vector2f& at, const Eigen::Matrix2f& from_to_warp,
                   int radius, float min_contrast, Template& out) {
  alignas(64) float wide[(kMaxRows + 2) * kWide];
  const int framed = radius + 1;
  if ((from_to_warp - Eigen::Matrix2f::Identity()).cwiseAbs().maxCoeff() < 1e-3F)
    sample_upright(level.data, level.step, at.x(), at.y(), framed, 2 * framed + 1, wide, kWide,
                   2 * framed + 1);
  else if (!sample_warped(level, at.x(), at.y(), from_to_warp, framed, wide, kWide))
    return false;
  fill_template(wide, 2 * radius + 1, out);
  return finish_template(out, min_contrast);
}

SPSLAM_SIMD Sums project_onto(const Template& p, const float* image) {
  float value[kStride] = {}, square[kStride] = {}, t[kStride] = {}, x[kStride] = {}, y[kStride] = {};
  for (int i = 0; i < p.rows * kStride; i += kStride) {
    for (int k = 0; k < kStride; ++k) {
      const float v = image[i + k];
      value[k] += v * p.ones[i + k];
      square[k] += v * v * p.ones[i + k];
      t[k] += v * p.t[i + k];
      x[k] += v * p.gx[i + k];
      y[k] += v * p.gy[i + k];
    }
  }
  Sums sums;
  for (int k = 0; k < kStride; ++k) {
    sums.value += value[k], sums.square += square[k], sums.along_t += t[k];
    sums.along_x += x[k], sums.along_y += y[k];
  }
  return sums;
}

// Gauss-Newton on one level. position: px of that level, in and out.
AlignmentStatus align_on_level(const Template& p, const cv::Mat& target, Eigen::Vector2f& position,
                               Sums& sums, const AlignmentOptions& options) {
  alignas(64) float patch[kMaxRows * kStride];
  const auto limit = static_cast<float>(options.convergence * options.convergence);
  for (int i = 0; i < options.iterations; ++i) {
    if (!readable(target, position.x(), position.y())) return AlignmentStatus::kOutside;
    sample_upright(target.data, target.step, position.x(), position.y(), options.patch_radius, p.rows, patch,
                   kStride, kStride);
    sums = project_onto(p, patch);
    const float gain = sums.along_t / p.energy;
    if (!(gain > 0.1F)) return AlignmentStatus::kDifferent;
    Eigen::Vector2f step = p.inverse_hessian * Eigen::Vector2f(sums.along_x, sums.along_y) / gain;
    if (const float length = step.norm(); length > 2) step *= 2 / length;
    position -= step;
    if (step.squaredNorm() < limit) return AlignmentStatus::kOk;
  }
  return AlignmentStatus::kUnconverged;
}

// The correlation to ask for. Two views of one patch of variance s^2 with noise n^2 each correlate by s^2 /
// (s^2 + n^2), be they ever so well aligned; in fog that is far below what textured patches reach. Variances
// are those measured, noise included.
float least_correlation(float template_variance, float target_variance, float noise_variance,
                        const AlignmentOptions& options) {
  const auto asked = static_cast<float>(options.min_correlation);
  const auto own = [&](float variance) { return std::max(0.0F, 1 - noise_variance / variance); };
  return std::max(std::min(asked, kLeastCorrelation),
                  asked * std::sqrt(own(template_variance) * own(target_variance)));
}

// The quality of the match from the last sums: correlation, and the covariance that the residual noise gives
// the position.
void judge(const Template& p, const Sums& sums, float noise_variance, const AlignmentOptions& options,
           Alignment& result) {
  const auto count = static_cast<float>(p.rows * p.rows);
  const float energy = std::max(sums.square - sums.value * sums.value / count, 1e-6F);
  const float gain = sums.along_t / p.energy;
  result.correlation = sums.along_t / std::sqrt(p.energy * energy);
  const float residual = std::max(energy - gain * sums.along_t, 0.0F) / std::max(count - 4, 1.0F);
  const auto floor = static_cast<float>(options.noise * options.noise);
  result.covariance = std::max(residual, floor) / (gain * gain) * p.inverse_hessian;
  if (result.status == AlignmentStatus::kOk &&
      result.correlation < least_correlation(p.energy / count, energy / count, noise_variance, options))
    result.status = AlignmentStatus::kDifferent;
}

}  // namespace

Alignment align_patch(const AlignmentPyramid& from, const Eigen::Vector2f& point, const AlignmentPyramid& to,
                      const Eigen::Vector2f& start, const Eigen::Matrix2f& to_from_warp,
                      const AlignmentOptions& options, int first_level) {
  Alignment result;
  result.position = start;
  const int levels = std::min({from.size(), to.size(), options.levels});
  int level = first_level < 0 ? levels - 1 : std::min(first_level, levels - 1);
  const Eigen::Matrix2f from_to_warp = to_from_warp.inverse();
  if (!from_to_warp.allFinite() || !start.allFinite()) return result;
  const auto noise_factor = static_cast<float>(options.noise_factor);
  const float noise_variance = noise_factor * noise_factor * from.noise() * to.noise();
  Template patch;
  for (; level >= 0; --level) {
    const float scale = 1.0F / static_cast<float>(1 << level);
    const Eigen::Vector2f at = point * scale;
    if (!readable(from.level(level), at.x(), at.y())) return result;
    Eigen::Vector2f position = result.position * scale;
    result.status = AlignmentStatus::kFlat;
    Sums sums;
    if (make_template(from.level(level), at, from_to_warp, options.patch_radius,
                      static_cast<float>(options.min_contrast), patch))
      result.status = align_on_level(patch, to.level(level), position, sums, options);
    if (level == 0) {
      result.position = position;
      if (result.status != AlignmentStatus::kFlat && result.status != AlignmentStatus::kOutside)
        judge(patch, sums, noise_variance, options, result);
    } else if (result.status == AlignmentStatus::kOk || result.status == AlignmentStatus::kUnconverged) {
      result.position = position / scale;  // a coarse level that fails leaves the start to the finer ones
    }
  }
  return result;
}

}  // namespace spslam
