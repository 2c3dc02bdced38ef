// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/sim/water.h"

#include <algorithm>
#include <cmath>

#include "spslam/base/random.h"
#include "spslam/base/simd.h"
#include "spslam/sim/hash.h"

namespace spslam::sim {
namespace {

constexpr double kGravity = 9.81;

double dispersion(double k) {
  return std::sqrt(kGravity * k + 7.3e-5 * k * k * k);
}  // rad/s

struct WindSea {
  double alpha, peak;  // Phillips' constant and the peak in rad/s
  double power(double omega) const {
    const double width = omega <= peak ? 0.07 : 0.09, bump = (omega / peak - 1) / width;
    return alpha * kGravity * kGravity * std::pow(omega, -5) * std::exp(-1.25 * std::pow(peak / omega, 4)) *
           std::pow(3.3, std::exp(-0.5 * bump * bump));
  }
};

Water::Wave make_wave(double k, double direction, double amplitude, Random& random) {
  const double c = std::cos(direction), s = std::sin(direction);
  return {k * c / (2 * M_PI), k * s / (2 * M_PI), dispersion(k) / (2 * M_PI),
          random.uniform(),   amplitude * k * c,  amplitude * k * s};
}

// cos(2 pi t) for any t, to 2e-5: without calls, so that the compiler makes vectors of it.
inline float cosine_of_turns(float t) {
  const float whole = static_cast<float>(static_cast<int>(t + (t >= 0 ? 0.5F : -0.5F)));
  const float x = t - whole, x2 = x * x;  // x in [-0.5, 0.5]
  return 1 + x2 * (-19.7392061F + x2 * (64.9393005F + x2 * (-85.4543076F + x2 * (60.1767426F - 22.8F * x2))));
}

SPSLAM_SIMD void add_waves(const std::array<float, 6>* waves, std::size_t count, const float* x,
                           const float* y, const float* blur, float* slope_x, float* slope_y) {
  float sum_x[kLanes] = {}, sum_y[kLanes] = {};
  for (std::size_t w = 0; w < count; ++w) {
    const std::array<float, 6>& wave = waves[w];
    for (int i = 0; i < kLanes; ++i) {
      const float c = cosine_of_turns(wave[0] * x[i] + wave[1] * y[i] + wave[2]) / (1 + wave[5] * blur[i]);
      sum_x[i] += wave[3] * c;
      sum_y[i] += wave[4] * c;
    }
  }
  for (int i = 0; i < kLanes; ++i) slope_x[i] = sum_x[i], slope_y[i] = sum_y[i];
}

}  // namespace

Water::Water(const WaterOptions& options, const RainOptions& rain, std::uint32_t seed)
    : rain_(rain.intensity), seed_(seed) {
  Random random(seed + 61);
  const double wind = options.wind, fetch = options.fetch;
  const WindSea sea{0.076 * std::pow(wind * wind / (fetch * kGravity), 0.22),
                    22 * std::cbrt(kGravity * kGravity / (wind * fetch))};
  const double shortest = 0.05, longest = std::max(0.3, 2.5 * 2 * M_PI * kGravity / (sea.peak * sea.peak));
  const double towards = options.wind_direction * M_PI / 180;
  for (int i = 0; i < kWind; ++i) {
    // Equal bands of log wavelength.
    const auto length = [&](double at) { return longest * std::pow(shortest / longest, at / kWind); };
    const double k = 2 * M_PI / length(i + random.uniform());
    const double band = dispersion(2 * M_PI / length(i + 1)) - dispersion(2 * M_PI / length(i));
    const double amplitude = std::sqrt(2 * sea.power(dispersion(k)) * band);
    double spread = 0;  // cosine squared, by rejection
    do spread = random.uniform(-M_PI / 2, M_PI / 2);
    while (random.uniform() > std::cos(spread) * std::cos(spread));
    waves_.push_back(make_wave(k, towards + 1.15 * spread, options.chop * amplitude, random));
  }
  for (int i = 0; i < kSwell; ++i) {
    const double k = 2 * M_PI / (0.8 * std::pow(6.0 / 0.8, (i + random.uniform()) / kSwell));
    waves_.push_back(make_wave(k, random.uniform(0, 2 * M_PI),
                               options.chop * 0.012 * std::sqrt(2.0 / kSwell) / k, random));
  }
}

Water::Surface Water::at(double time) const {
  Surface surface;
  for (const Wave& wave : waves_) {
    const double turns = wave.phase - wave.frequency * time;
    surface.waves_.push_back({static_cast<float>(wave.k_x), static_cast<float>(wave.k_y),
                              static_cast<float>(turns - std::floor(turns)), static_cast<float>(wave.slope_x),
                              static_cast<float>(wave.slope_y),
                              static_cast<float>(wave.k_x * wave.k_x + wave.k_y * wave.k_y)});
  }
  surface.time_ = time, surface.rain_ = rain_, surface.seed_ = seed_;
  return surface;
}

void Water::Surface::slopes(const Lanes& x, const Lanes& y, const Lanes& footprint, Lanes& slope_x,
                            Lanes& slope_y) const {
  Lanes blur;
  for (std::size_t i = 0; i < kLanes; ++i) blur[i] = 1.5F * footprint[i] * footprint[i];
  add_waves(waves_.data(), waves_.size(), x.data(), y.data(), blur.data(), slope_x.data(), slope_y.data());
  if (rain_ > 0) add_rings(x, y, footprint, slope_x, slope_y);
}

// A drop falls into each cell of a grid about once in kPeriod; its ring runs outwards and dies.
void Water::Surface::add_rings(const Lanes& x, const Lanes& y, const Lanes& footprint, Lanes& slope_x,
                               Lanes& slope_y) const {
  constexpr float kCell = 0.22F, kSpeed = 0.25F, kLife = 0.7F;
  const double period = kLife / std::min(1.0, 0.5 * rain_), drops_before = time_ / period;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    if (footprint[lane] < 0) continue;
    const int ci = static_cast<int>(std::floor(x[lane] / kCell)),
              cj = static_cast<int>(std::floor(y[lane] / kCell));
    for (int j = cj - 1; j <= cj + 1; ++j)
      for (int i = ci - 1; i <= ci + 1; ++i) {
        const std::uint32_t key = mix(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), seed_);
        const double clock = drops_before + static_cast<double>(unit(key));
        const auto drops = static_cast<std::int64_t>(clock);  // time begins at 0
        const auto age = static_cast<float>((clock - static_cast<double>(drops)) * period);
        if (age > kLife) continue;
        // The drop is somewhere in its cell: how far at least?
        const float gap_x = std::max(
            {kCell * static_cast<float>(i) - x[lane], x[lane] - kCell * static_cast<float>(i + 1), 0.0F});
        const float gap_y = std::max(
            {kCell * static_cast<float>(j) - y[lane], y[lane] - kCell * static_cast<float>(j + 1), 0.0F});
        const float reach = kSpeed * age + 0.051F;
        if (gap_x * gap_x + gap_y * gap_y > reach * reach) continue;
        const std::uint32_t drop = mix(key, static_cast<std::uint32_t>(drops));
        const float dx = x[lane] - kCell * (static_cast<float>(i) + unit(drop));
        const float dy = y[lane] - kCell * (static_cast<float>(j) + unit(mix(drop, 3)));
        const float r = std::sqrt(dx * dx + dy * dy) + 1e-4F, off = r - kSpeed * age;
        if (std::abs(off) > 0.05F) continue;
        const float height = 0.5F * (1 - age / kLife) * std::exp(-off * off / 5e-4F) * std::sin(off * 180);
        slope_x[lane] += height * dx / r;
        slope_y[lane] += height * dy / r;
      }
  }
}

}  // namespace spslam::sim
