// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// What grows on the banks: trees, bushes, reeds and grass.

#include <algorithm>
#include <cmath>

#include "spslam/base/random.h"
#include "spslam/sim/plants.h"
#include "spslam/sim/scene_builder.h"

namespace spslam::sim {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

Vector3f land_point(const ShorePoint& at, double out, double up) {
  const Eigen::Vector2d flat = at.edge + at.outward * out;
  return {static_cast<float>(flat.x()), static_cast<float>(flat.y()), static_cast<float>(up)};
}

// Behind the top of the bank, whatever its kind.
double top_of(const Shoreline& shore, double s) {
  const double run = shore.bank.height / std::tan(shore.bank.slope * M_PI / 180);
  const BankKind kind = shore.kind(s);
  return kind == BankKind::kRubble || kind == BankKind::kEarth ? run + 0.4 : 0.6;
}

// A leaf is never much smaller than a pixel: cards grow with the distance and their number falls.
struct LeafDetail {
  float length;  // m
  int count;
};
LeafDetail leaf_detail(double distance, double area, double detail) {
  const double length = std::clamp(0.0085 * distance + 0.04, 0.09, 1.0);
  return {static_cast<float>(length / std::sqrt(detail)),
          std::max(12, static_cast<int>(detail * 4.2 * area / (length * length)))};
}

void plant_trees(Mesh& mesh, const Shoreline& shore, const SceneDescription& scene, Random& random) {
  const int count = static_cast<int>(std::lround(shore.bank.trees * shore.length() / 100));
  for (int i = 0; i < count; ++i) {
    const double s = (i + random.uniform()) / count * shore.length();
    const ShorePoint at = shore.at(s);
    const bool hanging = random.uniform() < shore.bank.overhang;
    const double out = top_of(shore, s) + (hanging ? 0.3 : random.uniform(0.6, 7));
    TreeShape tree;
    tree.foot = land_point(at, out, shore.bank.height - 0.05);
    tree.height = static_cast<float>(shore.bank.tree_height * random.uniform(0.6, 1.35));
    tree.crown = tree.height * static_cast<float>(random.uniform(0.28, 0.42));
    tree.weeping = hanging && random.uniform() < 0.6;
    if (hanging)
      tree.lean = -(at.outward * random.uniform(0.15, 0.35) * static_cast<double>(tree.height)).cast<float>();
    const LeafDetail leaves =
        leaf_detail(at.clearance + out, tree.crown * tree.crown * 4.0, scene.render.detail);
    tree.leaf = leaves.length;
    tree.leaves = leaves.count;
    add_tree(mesh, tree, random);
  }
}

void plant_bushes(Mesh& mesh, const Shoreline& shore, const SceneDescription& scene, Random& random) {
  const int count = static_cast<int>(std::lround(shore.bank.bushes * shore.length() / 100));
  for (int i = 0; i < count; ++i) {
    const double s = random.uniform(0, shore.length());
    const ShorePoint at = shore.at(s);
    const double out = top_of(shore, s) + random.uniform(0, 4.5);
    const double radius = random.uniform(0.35, 1.1);
    const LeafDetail leaves = leaf_detail(at.clearance + out, 3 * radius * radius, scene.render.detail);
    add_bush(mesh, land_point(at, out, shore.bank.height), static_cast<float>(radius), leaves.length,
             leaves.count, random);
  }
}

void plant_reeds(Mesh& mesh, const Shoreline& shore, const SceneDescription& scene, Random& random) {
  const int count = static_cast<int>(std::lround(shore.bank.reeds * shore.length() / 100));
  for (int i = 0; i < count; ++i) {
    const double s = random.uniform(0, shore.length());
    const ShorePoint at = shore.at(s);
    const bool soft = shore.kind(s) == BankKind::kEarth || shore.kind(s) == BankKind::kRubble;
    const double out = random.uniform(soft ? -1.6 : -0.9, soft ? 0.3 : -0.3);
    if (at.clearance + out < 2) continue;
    const int blades =
        static_cast<int>(random.uniform(20, 60) * std::min(1.0, 15 / at.clearance) * scene.render.detail);
    const auto radius = static_cast<float>(random.uniform(0.25, 0.7));
    add_reeds(mesh, land_point(at, out, -0.1), radius, static_cast<float>(random.uniform(1.0, 2.0)),
              std::max(5, blades), random);
  }
}

// Tufts along the top edge, where grass is near enough to be seen as blades.
void plant_grass(Mesh& mesh, const Shoreline& shore, const SceneDescription& scene, Random& random) {
  for (const ShorePoint& at : shore.points) {
    if (at.clearance > 18) continue;
    const int tufts = static_cast<int>(std::lround(5 * scene.render.detail));
    for (int k = 0; k < tufts; ++k) {
      const double out = top_of(shore, at.s) + random.uniform(0.05, 3);
      const Vector3f foot = land_point(at, out, shore.bank.height) +
                            Vector3f(0, 0, 0.1F * static_cast<float>(random.uniform()));
      add_reeds(mesh, foot, 0.15F, static_cast<float>(random.uniform(0.15, 0.45)), 4, random);
    }
  }
}

}  // namespace

void build_bank_plants(Mesh& mesh, const Shoreline& shore, const SceneDescription& scene) {
  Random random(shore.seed + 7);
  plant_trees(mesh, shore, scene, random);
  plant_bushes(mesh, shore, scene, random);
  plant_reeds(mesh, shore, scene, random);
  plant_grass(mesh, shore, scene, random);
}

}  // namespace spslam::sim
