// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/sim/texture.h"

#include <algorithm>
#include <cmath>

#include "spslam/sim/hash.h"
#include "spslam/sim/texture_patterns.h"

namespace spslam::sim {

Texture::Texture(const std::vector<float>& values) {
  std::vector<float> fine = values;
  for (int level = 0, size = kSize; level < kLevels; ++level, size /= 2) {
    const auto n = static_cast<std::size_t>(size);
    Level& out = levels_[static_cast<std::size_t>(level)];
    out.resize(n * n);
    for (std::size_t i = 0; i < n * n; ++i)
      out[i] = static_cast<std::uint8_t>(std::lround(std::clamp(fine[i] * 128, 0.0F, 255.0F)));
    std::vector<float> half(n / 2 * (n / 2));
    for (std::size_t y = 0; y < n / 2; ++y)
      for (std::size_t x = 0; x < n / 2; ++x)
        half[y * (n / 2) + x] = 0.25F * (fine[2 * y * n + 2 * x] + fine[2 * y * n + 2 * x + 1] +
                                         fine[(2 * y + 1) * n + 2 * x] + fine[(2 * y + 1) * n + 2 * x + 1]);
    fine = std::move(half);
  }
}

namespace {

float value_noise(float x, float y, int period, std::uint32_t seed) {
  const auto floor_of = [](float t) {  // std::floor is a call
    const int whole = static_cast<int>(t);
    return whole - (static_cast<float>(whole) > t);
  };
  const int cx = floor_of(x), cy = floor_of(y);
  const auto fx = static_cast<float>(cx), fy = static_cast<float>(cy);
  const auto wrap = [period](int cell) {
    if (cell >= 0 && cell < period) return static_cast<std::uint32_t>(cell);
    const int rest = cell % period;
    return static_cast<std::uint32_t>(rest < 0 ? rest + period : rest);
  };
  const auto next = [period](std::uint32_t i) {
    return i + 1 == static_cast<std::uint32_t>(period) ? 0U : i + 1;
  };
  const std::uint32_t i = wrap(cx), j = wrap(cy), i1 = next(i), j1 = next(j);
  const auto value = [seed](std::uint32_t p, std::uint32_t q) {
    return 2 * unit(mix(p * 0x9e3779b1U ^ q * 0x85ebca77U ^ seed)) - 1;
  };
  const auto ease = [](float t) { return t * t * (3 - 2 * t); };
  const float a = ease(x - fx), b = ease(y - fy);
  const float top = value(i, j) * (1 - a) + value(i1, j) * a;
  const float bottom = value(i, j1) * (1 - a) + value(i1, j1) * a;
  return top * (1 - b) + bottom * b;
}

}  // namespace

float tile_noise(float x, float y, int cells, int octaves, std::uint32_t seed) {
  float sum = 0, weight = 0.6F;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += weight * value_noise(x * static_cast<float>(cells), y * static_cast<float>(cells), cells,
                                mix(seed + static_cast<std::uint32_t>(octave) * 101U));
    weight *= 0.6F;
    cells *= 2;
  }
  return sum;
}

Materials::Materials(std::uint32_t seed, const MaterialSet& used) : noise_(noise_pattern(seed)) {
  textures_ = patterns(seed, used);
  const auto set = [this](Material material, MaterialLook look) {
    looks_[static_cast<std::size_t>(material)] = look;
  };
  set(Material::kRubble, {3.2F, 0.5F, 0.35F});
  set(Material::kMasonry, {2.4F, 0.5F, 0.4F});
  set(Material::kBrick, {2.0F, 0.4F, 0.4F});
  set(Material::kConcrete, {2.4F, 0.4F, 0.5F});
  set(Material::kGround, {4.0F, 0.6F, 0.4F});
  set(Material::kWood, {1.5F, 0.4F, 0.3F});
  set(Material::kLeaf, {0.6F, 0.0F, 0.0F});
  set(Material::kPlaster, {3.0F, 0.15F, 0.3F});
  set(Material::kFacade, {12.0F, 0.1F, 0.1F});
  set(Material::kRoof, {2.4F, 0.3F, 0.4F});
  set(Material::kForest, {70.0F, 0.0F, 0.3F});
  set(Material::kPaint, {1.0F, 0.2F, 0.2F});
  set(Material::kReed, {0.5F, 0.0F, 0.0F});
  set(Material::kGlass, {2.0F, 0.0F, 0.2F});
}

float Materials::factor(Material material, float u, float v, float footprint, float dither) const {
  const auto index = static_cast<std::size_t>(material);
  const MaterialLook& look = looks_[index];
  // Stochastic choice between two mip levels is trilinear filtering on average.
  const auto level = [&](float tile) {
    const float texels = footprint * static_cast<float>(Texture::kSize) / tile;
    return texels <= 1 ? 0 : static_cast<int>(std::log2(texels) + dither);
  };
  float result = textures_[index].sample(u / look.tile, v / look.tile, level(look.tile));
  constexpr float kGrain = 0.83F, kStain = 21.7F;  // m a tile
  if (look.detail > 0 && footprint < 0.2F)
    result *= 1 + look.detail * (noise_.sample(u / kGrain, v / kGrain, level(kGrain)) - 1);
  if (look.macro > 0)
    result *= 1 + look.macro * (noise_.sample(u / kStain, v / (0.4F * kStain), level(0.4F * kStain)) - 1);
  return result;
}

}  // namespace spslam::sim
