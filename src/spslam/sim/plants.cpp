// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/sim/plants.h"

#include <Eigen/Geometry>
#include <cmath>

namespace spslam::sim {
namespace {

using Eigen::Vector3f;

float uniform(Random& random, double low, double high) {
  return static_cast<float>(random.uniform(low, high));
}

Vector3f direction(Random& random) {
  const float z = uniform(random, -1, 1), angle = uniform(random, 0, 2 * M_PI);
  const float r = std::sqrt(std::max(0.0F, 1 - z * z));
  return {r * std::cos(angle), r * std::sin(angle), z};
}

// A leaf card: a pointed diamond of length `leaf`, in direction `along` from `stem`.
void add_leaf(Mesh& mesh, const Vector3f& stem, const Vector3f& along, float leaf, float albedo,
              Random& random) {
  Vector3f across = along.cross(direction(random));
  const float norm = across.norm();
  across = norm > 1e-3F ? Vector3f(across / norm) : along.unitOrthogonal();
  const Vector3f middle = stem + along * (0.55F * leaf);
  const float width = 0.28F * leaf;
  const float u = uniform(random, 0, 1), v = uniform(random, 0, 1);
  mesh.add(stem, middle + across * width, stem + along * leaf, middle - across * width,
           {Material::kLeaf, true, albedo}, {u, v}, {leaf, leaf});
}

void add_clump(Mesh& mesh, const Vector3f& centre, float radius, float leaf, int leaves, Random& random) {
  const float shade = uniform(random, 0.11, 0.24);
  for (int i = 0; i < leaves; ++i) {
    const Vector3f out = direction(random);
    // Most leaves sit in the outer shell, where the light is.
    const float r = radius * std::cbrt(uniform(random, 0.15, 1));
    const Vector3f at = centre + Vector3f(out.x(), out.y(), 0.75F * out.z()) * r;
    const Vector3f along = (out + 0.9F * direction(random) + Vector3f(0, 0, -0.3F)).normalized();
    add_leaf(mesh, at, along, leaf * uniform(random, 0.7, 1.2), shade * uniform(random, 0.75, 1.3), random);
  }
}

void add_strand(Mesh& mesh, const Vector3f& top, float length, float leaf, int leaves, Random& random) {
  const float shade = uniform(random, 0.14, 0.26);
  const Vector3f sway = 0.12F * direction(random);
  for (int i = 0; i < leaves; ++i) {
    const float x = uniform(random, 0, 1);
    const Vector3f at = top + Vector3f(sway.x() * x, sway.y() * x, -length * x);
    const Vector3f along = (0.6F * direction(random) + Vector3f(0, 0, -1)).normalized();
    add_leaf(mesh, at, along, leaf * uniform(random, 0.7, 1.2), shade * uniform(random, 0.75, 1.3), random);
  }
}

}  // namespace

void add_tree(Mesh& mesh, const TreeShape& tree, Random& random) {
  const QuadInfo bark{Material::kWood, false, 0.16F};
  const float girth = 0.02F * tree.height;
  const Vector3f lean(tree.lean.x(), tree.lean.y(), 0);
  const Vector3f fork = tree.foot + 0.5F * lean + Vector3f(0, 0, tree.height * uniform(random, 0.34, 0.46));
  const Vector3f top = tree.foot + lean + Vector3f(0, 0, 0.82F * tree.height);
  add_bar(mesh, tree.foot - Vector3f(0, 0, 0.3F), fork, girth, 0.75F * girth, 7, bark);
  add_bar(mesh, fork, top, 0.75F * girth, 0.15F * girth, 6, bark);
  const Vector3f heart = tree.foot + lean + Vector3f(0, 0, 0.66F * tree.height);
  const int clumps = tree.leaves > 2500 ? 34 : tree.leaves > 600 ? 24 : tree.leaves > 150 ? 12 : 6;
  const int per_clump = std::max(4, tree.leaves / clumps);
  for (int i = 0; i < clumps; ++i) {
    const Vector3f out = direction(random) * std::cbrt(uniform(random, 0.1, 1));
    const Vector3f at =
        heart + Vector3f(out.x() * tree.crown, out.y() * tree.crown, out.z() * 0.3F * tree.height);
    if (i % 3 == 0) {
      const Vector3f branching = fork + (top - fork) * uniform(random, 0.0, 0.6);
      add_bar(mesh, branching, at, 0.32F * girth, 0.08F * girth, 5, bark);
    }
    const float radius = tree.crown * uniform(random, 0.26, 0.44);
    if (!tree.weeping || i % 2 == 0) {
      add_clump(mesh, at, radius, tree.leaf, per_clump, random);
      continue;
    }
    for (int strand = 0; strand < 6; ++strand)
      add_strand(mesh, at + radius * direction(random), tree.height * uniform(random, 0.25, 0.5), tree.leaf,
                 std::max(4, per_clump / 6), random);
  }
}

void add_bush(Mesh& mesh, const Vector3f& foot, float radius, float leaf, int leaves, Random& random) {
  for (int k = 0; k < 3; ++k) {
    const Vector3f side = direction(random);
    const Vector3f at = foot + Vector3f(0.6F * radius * side.x(), 0.6F * radius * side.y(), 0.5F * radius);
    add_clump(mesh, at, radius * uniform(random, 0.6, 0.9), leaf, leaves / 3, random);
  }
}

void add_reeds(Mesh& mesh, const Vector3f& foot, float radius, float height, int blades, Random& random) {
  for (int i = 0; i < blades; ++i) {
    const Vector3f out = direction(random);
    const Vector3f root = foot + Vector3f(radius * out.x(), radius * out.y(), 0);
    const float h = height * uniform(random, 0.6, 1.15);
    const Vector3f lean = 0.25F * h * direction(random).cwiseProduct(Vector3f(1, 1, 0));
    const Vector3f knee = root + 0.35F * lean + Vector3f(0, 0, 0.6F * h),
                   tip = root + lean + Vector3f(0, 0, h);
    const Vector3f across = Vector3f(0, 0, 1).cross(direction(random)).normalized() * 0.014F;
    const QuadInfo blade{Material::kReed, true, uniform(random, 0.18, 0.42)};
    const float u = uniform(random, 0, 1);
    mesh.add(root - across, root + across, knee + across, knee - across, blade, {u, 0}, {0.03F, 0.6F * h});
    mesh.add(knee - across, knee + across, tip, tip, blade, {u, 0.6F * h}, {0.03F, 0.4F * h});
  }
}

}  // namespace spslam::sim
