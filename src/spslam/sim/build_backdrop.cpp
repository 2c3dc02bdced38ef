// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// What is far: the closing shore, lines of trees, towers on the skyline, hills.

#include <algorithm>
#include <cmath>

#include "spslam/base/random.h"
#include "spslam/sim/plants.h"
#include "spslam/sim/scene_builder.h"
#include "spslam/sim/texture.h"

namespace spslam::sim {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

struct Extent {
  Eigen::Vector2d centre;
  double radius;  // m, of the disc that holds all shores
};

Extent extent_of(const std::vector<Shoreline>& shores, const Way& way) {
  Eigen::Vector2d low(1e9, 1e9), high(-1e9, -1e9);
  const auto grow = [&](const Eigen::Vector2d& p) { low = low.cwiseMin(p), high = high.cwiseMax(p); };
  for (const Shoreline& shore : shores)
    for (const ShorePoint& point : shore.points) grow(point.edge);
  for (double s = 0; s < way.length(); s += 2) grow(way.position(s));
  return {0.5 * (low + high), 0.5 * (high - low).norm()};
}

Vector3f ring_point(const Extent& extent, double radius, double angle, double up) {
  return {static_cast<float>(extent.centre.x() + radius * std::cos(angle)),
          static_cast<float>(extent.centre.y() + radius * std::sin(angle)), static_cast<float>(up)};
}

void add_ground_ring(Mesh& mesh, const Extent& extent, double inner, double outer, double low, double high,
                     int sides) {
  for (int i = 0; i < sides; ++i) {
    const double a = 2 * M_PI * i / sides, b = 2 * M_PI * (i + 1) / sides;
    const auto u = static_cast<float>(inner * a), du = static_cast<float>(inner * (b - a));
    mesh.add(ring_point(extent, inner, a, low), ring_point(extent, inner, b, low),
             ring_point(extent, outer, b, high), ring_point(extent, outer, a, high),
             {Material::kForest, false, 0.13F}, {u, 0}, {du, static_cast<float>(outer - inner)});
  }
}

void add_hills(Mesh& mesh, const Extent& extent, const BackdropOptions& options, std::uint32_t seed) {
  constexpr int kSides = 360, kRings = 7;
  for (int range = 0; range < 3; ++range) {
    const double near =
        std::max(options.hills * (0.6 + 0.4 * range), extent.radius + options.tree_line + 80.0 * (range + 1));
    const auto point = [&](int i, int ring) {
      const double angle = 2 * M_PI * i / kSides, x = static_cast<double>(ring) / kRings;
      const float ridge =
          tile_noise(static_cast<float>(i % kSides) / kSides, 0.1F * static_cast<float>(range), 6, 6,
                     seed + static_cast<std::uint32_t>(range));
      const double top = options.hill_height * (0.28 + 0.36 * range) *
                         std::max(0.08, 0.75 + 1.1 * static_cast<double>(ridge));
      const double rough =
          1 + 0.05 * static_cast<double>(tile_noise(static_cast<float>(i % kSides) / kSides,
                                                    static_cast<float>(ring) / 8, 64, 3, seed + 77));
      return ring_point(extent, near + 260 * x, angle, top * std::sin(0.5 * M_PI * x) * rough);
    };
    for (int i = 0; i < kSides; ++i)
      for (int ring = 0; ring < kRings; ++ring) {
        const auto u = static_cast<float>(near * 2 * M_PI * i / kSides);
        mesh.add(point(i, ring), point(i + 1, ring), point(i + 1, ring + 1), point(i, ring + 1),
                 {Material::kForest, false, 0.11F}, {u, 40.0F * static_cast<float>(ring)},
                 {static_cast<float>(near * 2 * M_PI / kSides), 40.0F});
      }
  }
}

void add_towers(Mesh& mesh, const Extent& extent, const BackdropOptions& options, Random& random) {
  const double middle = random.uniform(0, 2 * M_PI);
  for (int i = 0; i < options.towers; ++i) {
    // Half of them stand together, the others anywhere.
    const double angle = i % 2 == 0 ? middle + 0.35 * random.normal() : random.uniform(0, 2 * M_PI);
    const double distance = extent.radius + options.tree_line + random.uniform(40, 260);
    const auto height = static_cast<float>(random.uniform(18, 62));
    const Vector3f base = ring_point(extent, distance, angle, 0);
    add_box(mesh,
            {base,
             {static_cast<float>(random.uniform(14, 30)), static_cast<float>(random.uniform(12, 20)), height},
             static_cast<float>(random.uniform(0, 3.1))},
            {Material::kFacade, false, static_cast<float>(random.uniform(0.25, 0.5))});
  }
}

void add_tree_line(Mesh& mesh, const Extent& extent, const SceneDescription& scene, Random& random) {
  const BackdropOptions& options = scene.backdrop;
  const double base = extent.radius + options.tree_line;
  for (int row = 0; row < 2; ++row) {
    const double radius = base + 14 * row - 8;
    const int count = static_cast<int>(2 * M_PI * radius / 6.5 * options.tree_density);
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * M_PI * (i + random.uniform()) / count;
      TreeShape tree;
      tree.height = static_cast<float>(random.uniform(5, 13));
      tree.crown = tree.height * 0.36F;
      tree.leaf = static_cast<float>(std::clamp(0.006 * radius, 0.5, 1.8) / std::sqrt(scene.render.detail));
      tree.leaves = std::max(24, static_cast<int>(110 * scene.render.detail));
      tree.foot = ring_point(extent, radius + random.uniform(-5, 5), angle, 1.2);
      add_tree(mesh, tree, random);
    }
  }
}

}  // namespace

void build_backdrop(Mesh& mesh, const std::vector<Shoreline>& shores, const Way& way,
                    const SceneDescription& scene, std::uint32_t seed) {
  Random random(seed + 53);
  const Extent extent = extent_of(shores, way);
  const double base = extent.radius + scene.backdrop.tree_line;
  add_ground_ring(mesh, extent, base - 30, base - 22, -0.3, 1.2, 180);
  add_ground_ring(mesh, extent, base - 22, base + 200, 1.2, 4, 180);
  add_ground_ring(mesh, extent, base + 200, std::max(base + 400, 2.2 * scene.backdrop.hills), 4, 8, 180);
  if (scene.backdrop.tree_density > 0) add_tree_line(mesh, extent, scene, random);
  if (scene.backdrop.hill_height > 0) add_hills(mesh, extent, scene.backdrop, seed);
  add_towers(mesh, extent, scene.backdrop, random);
}

}  // namespace spslam::sim
