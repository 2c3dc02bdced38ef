// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Tileable grey textures with mip levels, made by procedures, and the materials that use them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "spslam/sim/mesh.h"

namespace spslam::sim {

// A square tile of factors about 1 (stored as 128), wrapping round at its edges.
class Texture {
 public:
  static constexpr int kSize = 512;
  Texture() = default;  // must not be sampled
  // `values` has kSize x kSize factors, row-major; what lies outside 0 .. 1.99 is cut off.
  explicit Texture(const std::vector<float>& values);

  // u, v in tiles; `level` 0 is the full resolution, each further one halves it. Bilinear within a level.
  float sample(float u, float v, int level) const {
    level = level < 0 ? 0 : level >= kLevels ? kLevels - 1 : level;
    const Level& data = levels_[static_cast<std::size_t>(level)];
    const int size = kSize >> level, mask = size - 1;
    const float x = (u - floor_of(u)) * static_cast<float>(size),
                y = (v - floor_of(v)) * static_cast<float>(size);
    const int i = static_cast<int>(x), j = static_cast<int>(y);
    const float a = x - static_cast<float>(i), b = y - static_cast<float>(j);
    const auto at = [&](int p, int q) {
      return static_cast<float>(data[static_cast<std::size_t>((q & mask) * size + (p & mask))]);
    };
    const float top = at(i, j) + a * (at(i + 1, j) - at(i, j));
    const float bottom = at(i, j + 1) + a * (at(i + 1, j + 1) - at(i, j + 1));
    return (top + b * (bottom - top)) * (1.0F / 128);
  }

 private:
  static float floor_of(float x) {
    const float whole = static_cast<float>(static_cast<int>(x));
    return whole - (whole > x ? 1.0F : 0.0F);
  }
  static constexpr int kLevels = 10;
  using Level = std::vector<std::uint8_t>;
  std::array<Level, kLevels> levels_;
};

// Periodic fractal noise about 0 with RMS near 0.3; x, y in tiles, `cells` lattice cells a tile in the first
// octave.
float tile_noise(float x, float y, int cells, int octaves, std::uint32_t seed);

struct MaterialLook {
  float tile = 2;       // m that one tile of the texture covers
  float detail = 0.3F;  // strength of the fine grain
  float macro = 0.3F;   // strength of the stains, tens of metres wide
};

// Which materials a scene has, in the enum's order.
using MaterialSet = std::array<bool, kMaterialCount>;

// Textures and looks of the materials used, no others; made once for a scene.
class Materials {
 public:
  Materials(std::uint32_t seed, const MaterialSet& used);

  // Albedo factor at (u, v) in m where one pixel covers `footprint` m; `dither` in [0, 1) picks between two
  // mip levels.
  float factor(Material material, float u, float v, float footprint, float dither) const;

 private:
  std::array<MaterialLook, kMaterialCount> looks_;
  std::vector<Texture> textures_;
  Texture noise_;
};

}  // namespace spslam::sim
