// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/sim/mesh.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

namespace spslam::sim {

using Eigen::Vector2f;
using Eigen::Vector3f;

void Mesh::add(const Vector3f& a, const Vector3f& b, const Vector3f& c, const Vector3f& d,
               const QuadInfo& info, const Vector2f& origin, const Vector2f& size) {
  points.insert(points.end(), {a, b, c, d});
  corners.push_back({origin.x(), origin.y(), 1});
  corners.push_back({origin.x() + size.x(), origin.y(), 1});
  corners.push_back({origin.x() + size.x(), origin.y() + size.y(), 1});
  corners.push_back({origin.x(), origin.y() + size.y(), 1});
  quads.push_back(info);
}

void Mesh::append(const Mesh& other, const Vector3f& offset) {
  for (const Vector3f& point : other.points) points.push_back(point + offset);
  corners.insert(corners.end(), other.corners.begin(), other.corners.end());
  quads.insert(quads.end(), other.quads.begin(), other.quads.end());
}

void add_box(Mesh& mesh, const Box& box, const QuadInfo& info) {
  const Vector3f x(std::cos(box.yaw), std::sin(box.yaw), 0), y(-x.y(), x.x(), 0), z(0, 0, 1);
  const auto corner = [&](float i, float j, float k) -> Vector3f {
    return box.base + x * (i * box.size.x()) + y * (j * box.size.y()) + z * (k * box.size.z());
  };
  const float h = 0.5F;
  const std::array<Vector2f, 4> round{Vector2f{-h, -h}, Vector2f{h, -h}, Vector2f{h, h}, Vector2f{-h, h}};
  float along = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2f &p = round[i], &q = round[(i + 1) % 4];
    const float side = i % 2 == 0 ? box.size.x() : box.size.y();
    mesh.add(corner(p.x(), p.y(), 0), corner(q.x(), q.y(), 0), corner(q.x(), q.y(), 1),
             corner(p.x(), p.y(), 1), info, {along, box.base.z()}, {side, box.size.z()});
    along += side;
  }
  for (const float k : {0.0F, 1.0F})
    mesh.add(corner(-h, -h, k), corner(h, -h, k), corner(h, h, k), corner(-h, h, k), info, {0, 0},
             {box.size.x(), box.size.y()});
}

void add_bar(Mesh& mesh, const Vector3f& a, const Vector3f& b, float radius_a, float radius_b, int sides,
             const QuadInfo& info) {
  const Vector3f axis = (b - a).normalized();
  const Vector3f x = axis.unitOrthogonal(), y = axis.cross(x);
  const float length = (b - a).norm();
  const float around = 2 * static_cast<float>(M_PI) * radius_a / static_cast<float>(sides);
  for (int i = 0; i < sides; ++i) {
    const auto spoke = [&](int k) -> Vector3f {
      const float angle = 2 * static_cast<float>(M_PI) * static_cast<float>(k) / static_cast<float>(sides);
      return x * std::cos(angle) + y * std::sin(angle);
    };
    const Vector3f p = spoke(i), q = spoke(i + 1);
    const float u = around * static_cast<float>(i) + a.x() + a.y();
    mesh.add(a + p * radius_a, a + q * radius_a, b + q * radius_b, b + p * radius_b, info, {u, a.z()},
             {around, length});
  }
}

}  // namespace spslam::sim
