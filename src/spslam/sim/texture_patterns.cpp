// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/sim/texture_patterns.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "spslam/sim/hash.h"

namespace spslam::sim {
namespace {

constexpr int kSize = Texture::kSize;

// f(x, y) with x, y in tiles.
template <class F>
std::vector<float> fill(F f) {
  std::vector<float> values(static_cast<std::size_t>(kSize) * kSize);
  tbb::parallel_for(0, kSize, [&](int j) {
    for (int i = 0; i < kSize; ++i)
      values[static_cast<std::size_t>(j) * kSize + static_cast<std::size_t>(i)] =
          f((static_cast<float>(i) + 0.5F) / kSize, (static_cast<float>(j) + 0.5F) / kSize);
  });
  return values;
}

struct Cell {
  float edge;  // distance to the second nearest point minus that to the nearest, in cells
  std::uint32_t id;
};

// Worley's cellular basis (SIGGRAPH 1996), periodic.
Cell worley(float x, float y, int cells, std::uint32_t seed) {
  const float px = x * static_cast<float>(cells), py = y * static_cast<float>(cells);
  const int ci = static_cast<int>(std::floor(px)), cj = static_cast<int>(std::floor(py));
  float first = 1e9F, second = 1e9F;
  std::uint32_t id = 0;
  for (int j = cj - 1; j <= cj + 1; ++j)
    for (int i = ci - 1; i <= ci + 1; ++i) {
      const std::uint32_t key = mix(static_cast<std::uint32_t>((i + cells) % cells),
                                    static_cast<std::uint32_t>((j + cells) % cells), seed);
      const float dx = static_cast<float>(i) + 0.1F + 0.8F * unit(key) - px;
      const float dy = static_cast<float>(j) + 0.1F + 0.8F * unit(mix(key, 1)) - py;
      const float distance = std::sqrt(dx * dx + dy * dy);
      if (distance < first)
        second = first, first = distance, id = key;
      else
        second = std::min(second, distance);
    }
  return {second - first, id};
}

float rubble(float x, float y, std::uint32_t seed) {
  const float wx = x + 0.02F * tile_noise(x, y, 8, 3, seed + 1),
              wy = y + 0.02F * tile_noise(x, y, 8, 3, seed + 2);
  const Cell stone = worley(wx - std::floor(wx), wy - std::floor(wy), 8, seed);
  const float joint = std::clamp((stone.edge - 0.05F) / 0.10F, 0.0F, 1.0F);
  const float shade = 0.6F + 0.95F * unit(mix(stone.id, 7)) + 0.5F * tile_noise(x, y, 16, 5, seed + 3);
  return 0.15F + joint * (shade - 0.15F) + 0.1F * std::min(stone.edge, 0.5F);
}

// Courses of blocks, every other one shifted by half a block.
float blocks(float x, float y, int rows, int columns, float joint_width, std::uint32_t seed) {
  const float row_at = y * static_cast<float>(rows);
  const int row = static_cast<int>(row_at);
  const float shift = row % 2 == 0 ? 0.0F : 0.5F;
  const float column_at = x * static_cast<float>(columns) + shift;
  const int column = static_cast<int>(std::floor(column_at)) % columns;
  const float ry = row_at - std::floor(row_at), rx = column_at - std::floor(column_at);
  const float ragged = 0.35F * tile_noise(x, y, 32, 2, seed + 5);
  const float height = joint_width,
              width = joint_width * static_cast<float>(columns) / static_cast<float>(rows);
  const float inside = std::min(std::min(rx, 1 - rx) / width, std::min(ry, 1 - ry) / height) + ragged;
  const float shade =
      0.6F + 0.8F * unit(mix(static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(column), seed));
  const float stone = shade + 0.45F * tile_noise(x, y, 16, 5, seed + 6);
  const float mortar = 0.28F + 0.2F * tile_noise(x, y, 64, 2, seed + 7);
  return mortar + std::clamp(inside - 0.5F, 0.0F, 1.0F) * (stone - mortar);
}

float concrete(float x, float y, std::uint32_t seed) {
  const float streak =
      0.25F * tile_noise(x, 0.1F * y, 32, 3, seed + 1) * (0.5F + tile_noise(x, y, 4, 2, seed + 2));
  const Cell pock = worley(x, y, 24, seed + 3);
  const bool hole = unit(mix(pock.id, 3)) < 0.25F && pock.edge > 0.55F;
  const float line = std::min(std::abs(x - 0.5F), std::abs(y - 0.5F)) < 0.004F ? -0.4F : 0.0F;
  return 1 + 0.5F * tile_noise(x, y, 4, 7, seed) + streak + (hole ? -0.6F : 0.0F) + line;
}

float facade(float x, float y, std::uint32_t seed) {
  const float fx = 4 * x, fy = 4 * y;
  const std::uint32_t window = mix(static_cast<std::uint32_t>(fx), static_cast<std::uint32_t>(fy), seed);
  const float rx = fx - std::floor(fx), ry = fy - std::floor(fy);
  const bool pane = std::abs(rx - 0.5F) < 0.24F && std::abs(ry - 0.55F) < 0.27F;
  const bool bar = std::abs(rx - 0.5F) < 0.02F || std::abs(ry - 0.62F) < 0.02F;
  const bool frame = !pane && std::abs(rx - 0.5F) < 0.28F && std::abs(ry - 0.55F) < 0.31F;
  if (pane) return bar ? 1.2F : 0.2F + 0.5F * unit(window);
  return (frame ? 1.5F : 1.15F) + 0.2F * tile_noise(x, y, 8, 5, seed);
}

float wood(float x, float y, std::uint32_t seed) {
  const float wobble = 0.04F * tile_noise(x, y, 4, 2, seed + 1);
  return 1 + 0.6F * tile_noise(x + wobble, 0.15F * y, 32, 4, seed) +
         0.25F * tile_noise(x, y, 16, 4, seed + 2);
}

float leaf(float x, float y, std::uint32_t seed) {
  const Cell cell = worley(x, y, 10, seed);
  return 0.55F + 0.7F * unit(mix(cell.id, 9)) + 0.3F * tile_noise(x, y, 16, 3, seed) -
         (cell.edge < 0.08F ? 0.3F : 0.0F);
}

float forest(float x, float y, std::uint32_t seed) {
  const Cell crown = worley(x, y, 14, seed);
  return 0.55F + 0.5F * unit(mix(crown.id, 9)) + 0.7F * std::min(crown.edge, 0.6F) +
         0.5F * tile_noise(x, y, 6, 7, seed);
}

float roof(float x, float y, std::uint32_t seed) {
  const float row = y * 10 - std::floor(y * 10);
  return blocks(x, y, 10, 12, 0.04F, seed) * (0.65F + 0.5F * row);
}

}  // namespace

std::vector<float> noise_pattern(std::uint32_t seed) {
  return fill([=](float x, float y) { return 1 + 0.75F * tile_noise(x, y, 4, 7, seed + 90); });
}

std::vector<Texture> patterns(std::uint32_t seed, const MaterialSet& used) {
  std::vector<Texture> textures(kMaterialCount);
  const auto make = [&](Material material, auto pattern) {
    const auto index = static_cast<std::size_t>(material);
    if (used[index]) textures[index] = Texture(fill(pattern));
  };
  const auto noisy = [&](Material material, float strength, int cells, std::uint32_t stream) {
    make(material,
         [=](float x, float y) { return 1 + strength * tile_noise(x, y, cells, 6, seed + stream); });
  };
  make(Material::kRubble, [=](float x, float y) { return rubble(x, y, seed + 1); });
  make(Material::kMasonry, [=](float x, float y) { return blocks(x, y, 8, 4, 0.045F, seed + 2); });
  make(Material::kBrick, [=](float x, float y) { return blocks(x, y, 24, 8, 0.09F, seed + 3); });
  make(Material::kConcrete, [=](float x, float y) { return concrete(x, y, seed + 4); });
  noisy(Material::kGround, 0.8F, 16, 5);
  make(Material::kWood, [=](float x, float y) { return wood(x, y, seed + 6); });
  make(Material::kLeaf, [=](float x, float y) { return leaf(x, y, seed + 7); });
  noisy(Material::kPlaster, 0.25F, 4, 8);
  make(Material::kFacade, [=](float x, float y) { return facade(x, y, seed + 9); });
  make(Material::kRoof, [=](float x, float y) { return roof(x, y, seed + 10); });
  make(Material::kForest, [=](float x, float y) { return forest(x, y, seed + 11); });
  noisy(Material::kPaint, 0.3F, 8, 12);
  make(Material::kReed,
       [=](float x, float y) { return 1 + 0.6F * tile_noise(x, 0.1F * y, 32, 3, seed + 13); });
  noisy(Material::kGlass, 0.5F, 2, 14);
  return textures;
}

}  // namespace spslam::sim
