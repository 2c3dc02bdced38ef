// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Houses, bridges and the boats of others.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "spslam/base/random.h"
#include "spslam/sim/scene_builder.h"

namespace spslam::sim {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

// A frame on the ground: x along, y away, z up.
struct Place {
  Vector3f origin, x, y;
  Vector3f operator()(float a, float b, float c) const { return origin + x * a + y * b + Vector3f(0, 0, c); }
};

void add_wall(Mesh& mesh, const Place& place, const Vector2f& from, const Vector2f& to, float height,
              const QuadInfo& info) {
  const float length = (to - from).norm();
  const int pieces = std::max(1, static_cast<int>(length / 2));
  for (int i = 0; i < pieces; ++i) {
    const Vector2f p = from + (to - from) * (static_cast<float>(i) / static_cast<float>(pieces));
    const Vector2f q = from + (to - from) * (static_cast<float>(i + 1) / static_cast<float>(pieces));
    mesh.add(place(p.x(), p.y(), 0), place(q.x(), q.y(), 0), place(q.x(), q.y(), height),
             place(p.x(), p.y(), height), info, {(p - from).norm(), 0},
             {length / static_cast<float>(pieces), height});
  }
}

// A window on the wall from `from` towards `along`: a frame and a pane, each a little in front.
void add_window(Mesh& mesh, const Place& place, const Vector2f& from, const Vector2f& along, float at,
                float up, float width, float height) {
  const Vector2f out(along.y(), -along.x());
  const auto panel = [&](float margin, float front, const QuadInfo& info) {
    const Vector2f p = from + along * (at - 0.5F * width - margin) + out * front;
    const Vector2f q = from + along * (at + 0.5F * width + margin) + out * front;
    mesh.add(place(p.x(), p.y(), up - margin), place(q.x(), q.y(), up - margin),
             place(q.x(), q.y(), up + height + margin), place(p.x(), p.y(), up + height + margin), info,
             {at, up}, {width, height});
  };
  panel(0.12F, 0.03F, {Material::kPaint, false, 0.62F});
  panel(0.0F, 0.06F, {Material::kGlass, false, 0.05F});
  panel(-0.5F * width + 0.03F, 0.08F, {Material::kPaint, false, 0.6F});
}

void add_house(Mesh& mesh, const Place& place, Random& random) {
  const auto width = static_cast<float>(random.uniform(7, 13)),
             depth = static_cast<float>(random.uniform(6, 9));
  const int floors = 1 + static_cast<int>(random.below(3));
  const float height = 2.8F * static_cast<float>(floors) + 0.4F;
  const QuadInfo plaster{random.uniform() < 0.6 ? Material::kPlaster : Material::kBrick, false,
                         static_cast<float>(random.uniform(0.25, 0.6))};
  const Vector2f round[5] = {{0, 0}, {width, 0}, {width, depth}, {0, depth}, {0, 0}};
  for (int side = 0; side < 4; ++side) {
    const Vector2f from = round[side], to = round[side + 1], along = (to - from).normalized();
    add_wall(mesh, place, from, to, height, plaster);
    const float length = (to - from).norm();
    const int windows = static_cast<int>(length / 2.3F);
    for (int floor = 0; floor < floors; ++floor)
      for (int i = 0; i < windows; ++i)
        if (random.uniform() < 0.85)
          add_window(mesh, place, from, along,
                     (static_cast<float>(i) + 0.5F) * length / static_cast<float>(windows),
                     0.9F + 2.8F * static_cast<float>(floor), 1.0F, 1.35F);
  }
  // A gable roof along the front.
  const float over = 0.5F, rise = 0.35F * depth;
  const QuadInfo tiles{Material::kRoof, false, static_cast<float>(random.uniform(0.12, 0.24))};
  mesh.add(place(-over, -over, height), place(width + over, -over, height),
           place(width + over, depth / 2, height + rise), place(-over, depth / 2, height + rise), tiles,
           {0, 0}, {width + 1, depth * 0.6F});
  mesh.add(place(width + over, depth + over, height), place(-over, depth + over, height),
           place(-over, depth / 2, height + rise), place(width + over, depth / 2, height + rise), tiles,
           {0, 0}, {width + 1, depth * 0.6F});
  for (const float x : {0.0F, width})
    mesh.add(place(x, 0, height), place(x, depth, height), place(x, depth / 2, height + rise * 0.95F),
             place(x, depth / 2, height + rise * 0.95F), plaster, {0, height}, {depth, rise});
}

Place place_at(const ShorePoint& at, double out, double up) {
  const Eigen::Vector2d flat = at.edge + at.outward * out;
  const Vector3f y(static_cast<float>(at.outward.x()), static_cast<float>(at.outward.y()), 0);
  const Vector3f x(y.y(), -y.x(), 0);
  return {{static_cast<float>(flat.x()), static_cast<float>(flat.y()), static_cast<float>(up)}, x, y};
}

void add_bridge(Mesh& mesh, const ChannelPoint& at, const SceneDescription& scene) {
  const auto yaw = static_cast<float>(at.heading);
  const auto width = static_cast<float>(scene.bridge.width),
             clear = static_cast<float>(scene.bridge.clearance);
  const double reach_left = scene.shore.left.distance + 10, reach_right = scene.shore.right.distance + 10;
  const auto span = static_cast<float>(reach_left + reach_right);
  const auto shift = static_cast<float>(0.5 * (reach_left - reach_right));
  const Vector3f along(std::cos(yaw), std::sin(yaw), 0), across(-along.y(), along.x(), 0);
  const Vector3f middle(static_cast<float>(at.position.x()), static_cast<float>(at.position.y()), 0);
  const auto where = [&](float a, float c, float up) -> Vector3f {
    return middle + along * a + across * (c + shift) + Vector3f(0, 0, up);
  };
  const QuadInfo slab{Material::kConcrete, false, 0.36F};
  const QuadInfo beam{Material::kConcrete, false, 0.28F};
  // Slab and parapet in pieces, so that light and shadow can vary along them.
  const int pieces = std::max(1, static_cast<int>(span / 2));
  const float piece = span / static_cast<float>(pieces);
  for (int i = 0; i < pieces; ++i) {
    const float c = (static_cast<float>(i) + 0.5F) * piece - 0.5F * span;
    for (float a = -0.5F * width + 0.5F; a < 0.5F * width; a += 1.0F)
      add_box(mesh, {where(a, c, clear + 0.45F), {1.0F, piece, 0.35F}, yaw}, slab);
    for (const float side : {-0.5F, 0.5F}) {
      add_box(mesh, {where(side * width, c, clear + 0.2F), {0.25F, piece, 0.75F}, yaw}, slab);
      add_box(mesh, {where(side * width, c, clear + 0.95F), {0.12F, 0.12F, 0.8F}, yaw},
              {Material::kPaint, false, 0.5F});
      for (const float up : {1.35F, 1.7F})
        add_bar(mesh, where(side * width, c - 0.5F * piece, clear + up),
                where(side * width, c + 0.5F * piece, clear + up), 0.035F, 0.035F, 5,
                {Material::kPaint, false, 0.5F});
    }
    for (float a = -0.5F * width + 0.9F; a < 0.5F * width - 0.4F; a += 1.6F)
      add_box(mesh, {where(a, c, clear), {0.4F, piece, 0.45F}, yaw}, beam);
  }
  // Abutments in the banks.
  const float left = static_cast<float>(scene.shore.left.distance) - shift;
  const float right = -static_cast<float>(scene.shore.right.distance) - shift;
  for (const float c : {left + 0.3F, right - 0.3F})
    for (float a = -0.5F * width; a < 0.5F * width; a += 1.0F)
      add_box(mesh, {where(a + 0.5F, c, -0.6F), {1.0F, 1.8F, clear + 0.7F}, yaw},
              {Material::kMasonry, false, 0.3F});
}

Mesh make_boat(float length, float yaw, Random& random) {
  Mesh mesh;
  const float beam = 0.32F * length;
  const Vector3f x(std::cos(yaw), std::sin(yaw), 0), y(-x.y(), x.x(), 0);
  const auto at = [&](float a, float b, float c) -> Vector3f { return x * a + y * b + Vector3f(0, 0, c); };
  const QuadInfo hull{Material::kPaint, false, static_cast<float>(random.uniform(0.25, 0.7))};
  // Outline of the deck from the stern to the bow, a side at a time.
  const float stations[6][2] = {{-0.5F, 0.42F}, {-0.2F, 0.5F},  {0.1F, 0.48F},
                                {0.3F, 0.36F},  {0.43F, 0.18F}, {0.5F, 0.0F}};
  for (int i = 0; i + 1 < 6; ++i)
    for (const float side : {-1.0F, 1.0F}) {
      const float a = stations[i][0] * length, b = stations[i + 1][0] * length;
      const float p = side * stations[i][1] * beam, q = side * stations[i + 1][1] * beam;
      mesh.add(at(a, 0.8F * p, -0.2F), at(b, 0.8F * q, -0.2F), at(b, q, 0.62F), at(a, p, 0.6F), hull, {a, 0},
               {b - a, 0.8F});
      mesh.add(at(a, 1.02F * p, 0.5F), at(b, 1.02F * q, 0.52F), at(b, 1.02F * q, 0.6F),
               at(a, 1.02F * p, 0.58F), {Material::kWood, false, 0.1F}, {a, 0}, {b - a, 0.1F});
      mesh.add(at(a, 0, 0.6F), at(b, 0, 0.6F), at(b, q, 0.6F), at(a, p, 0.6F), {Material::kWood, false, 0.3F},
               {a, 0}, {b - a, p});
    }
  mesh.add(at(-0.5F * length, -0.42F * beam, -0.2F), at(-0.5F * length, 0.42F * beam, -0.2F),
           at(-0.5F * length, 0.42F * beam, 0.6F), at(-0.5F * length, -0.42F * beam, 0.6F), hull, {0, 0},
           {beam, 0.8F});
  const Vector3f cabin = at(-0.1F * length, 0, 0.6F);
  add_box(mesh, {cabin, {0.34F * length, 0.62F * beam, 0.95F}, yaw}, {Material::kPaint, false, 0.6F});
  add_box(mesh, {cabin + Vector3f(0, 0, 0.4F), {0.345F * length, 0.63F * beam, 0.38F}, yaw},
          {Material::kGlass, false, 0.06F});
  add_box(mesh, {cabin + Vector3f(0, 0, 0.95F), {0.4F * length, 0.7F * beam, 0.07F}, yaw},
          {Material::kWood, false, 0.25F});
  add_bar(mesh, cabin + Vector3f(0, 0, 0.9F), cabin + Vector3f(0, 0, 2.2F), 0.03F, 0.02F, 5,
          {Material::kPaint, false, 0.5F});
  return mesh;
}

}  // namespace

void build_houses(Mesh& mesh, const Shoreline& shore, const SceneDescription&) {
  Random random(shore.seed + 13);
  const int count = static_cast<int>(std::lround(shore.bank.houses * shore.length() / 100));
  for (int i = 0; i < count; ++i) {
    const double s = (i + 0.5 + random.uniform(-0.25, 0.25)) / count * shore.length();
    add_house(
        mesh,
        place_at(shore.at(s), shore.bank.house_setback * random.uniform(0.85, 1.3), shore.bank.height - 0.1),
        random);
  }
}

void build_bridges(Mesh& mesh, const std::vector<ChannelPoint>& middle, const SceneDescription& scene) {
  const double reach = scene.path.shape == PathShape::kTurn ? 0.5 * scene.path.length : scene.path.length;
  for (int i = 0; i < scene.bridge.count; ++i) {
    const double s = scene.bridge.position * reach + i * scene.bridge.spacing;
    const auto nearest = std::min_element(
        middle.begin(), middle.end(),
        [&](const ChannelPoint& a, const ChannelPoint& b) { return std::abs(a.s - s) < std::abs(b.s - s); });
    add_bridge(mesh, *nearest, scene);
  }
}

std::vector<TrafficBoat> build_traffic(const SceneDescription& scene, const BoatMotion& motion,
                                       std::uint32_t seed) {
  std::vector<TrafficBoat> boats;
  Random random(seed + 43);
  for (int i = 0; i < scene.traffic.boats; ++i) {
    // Each crosses the view at some moment: it is given a place ahead of the camera then, and a course.
    const double when = motion.duration() * (i + random.uniform()) / scene.traffic.boats;
    const double s = motion.travelled(when);
    const double heading = motion.way().heading(s) + random.uniform(-0.12, 0.12);
    const double side = (random.uniform() < 0.5 ? -1 : 1) * random.uniform(0.35, 0.7);
    const double room = scene.shore.shape == ShoreShape::kLake ? scene.shore.right.distance
                        : side > 0                             ? scene.shore.left.distance
                                                               : scene.shore.right.distance;
    const Eigen::Vector2d ahead(std::cos(heading), std::sin(heading)), left(-ahead.y(), ahead.x());
    const Eigen::Vector2d there = motion.way().position(s) +
                                  ahead * random.uniform(0.15, 1) * scene.traffic.spread +
                                  left * side * std::min(room, 25.0);
    const double speed = scene.traffic.speed * random.uniform(0.5, 1.5) * (random.uniform() < 0.7 ? -1 : 1);
    TrafficBoat boat;
    boat.velocity = ahead * speed;
    boat.start = there - boat.velocity * when;
    boat.phase = random.uniform(0, 6.28);
    const auto course = static_cast<float>(speed < 0 ? heading + M_PI : heading);
    boat.mesh = make_boat(static_cast<float>(random.uniform(3.5, 8)), course, random);
    boats.push_back(std::move(boat));
  }
  return boats;
}

Vector3f TrafficBoat::position(double time) const {
  const Eigen::Vector2d flat = start + velocity * time;
  return {static_cast<float>(flat.x()), static_cast<float>(flat.y()),
          static_cast<float>(heave * std::sin(2.2 * time + phase))};
}

}  // namespace spslam::sim
