// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// What the scene is made of: quads with texture coordinates, a material and light that is worked out once.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace spslam::sim {

enum class Material : std::uint8_t {
  kRubble,
  kMasonry,
  kBrick,
  kConcrete,
  kGround,
  kWood,
  kLeaf,
  kPlaster,
  kFacade,
  kRoof,
  kForest,
  kPaint,
  kReed,
  kGlass
};
inline constexpr int kMaterialCount = 14;

struct QuadInfo {
  Material material = Material::kConcrete;
  bool thin = false;    // a leaf: lit from both sides, one light for all corners
  float albedo = 0.3F;  // of the material's mean
};

struct Corner {
  float u = 0, v = 0;  // texture coordinates, m
  float light = 1;     // irradiance over that of the open sky
};

// Quad q has the corners 4 q .. 4 q + 3, in order round it; a triangle repeats its last corner.
struct Mesh {
  std::vector<Eigen::Vector3f> points;
  std::vector<Corner> corners;
  std::vector<QuadInfo> quads;

  void add(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c,
           const Eigen::Vector3f& d, const QuadInfo& info, const Eigen::Vector2f& origin,
           const Eigen::Vector2f& size);
  void append(const Mesh& other, const Eigen::Vector3f& offset);
};

// A box with its base centre at `base`, its x axis turned by yaw (rad).
struct Box {
  Eigen::Vector3f base = Eigen::Vector3f::Zero();
  Eigen::Vector3f size = Eigen::Vector3f::Ones();  // m: along its x, y and up
  float yaw = 0;
};
void add_box(Mesh& mesh, const Box& box, const QuadInfo& info);

// A tapered round bar from a to b.
void add_bar(Mesh& mesh, const Eigen::Vector3f& a, const Eigen::Vector3f& b, float radius_a, float radius_b,
             int sides, const QuadInfo& info);

}  // namespace spslam::sim
