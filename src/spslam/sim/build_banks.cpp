// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Revetments, walls and the land behind them.

#include <algorithm>
#include <cmath>

#include "spslam/base/random.h"
#include "spslam/sim/hash.h"
#include "spslam/sim/scene_builder.h"
#include "spslam/sim/texture.h"

namespace spslam::sim {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

struct ProfilePoint {
  double out, up;  // m from the water's edge to the land, m above the water
};

struct Strip {
  std::vector<ProfilePoint> profile;
  QuadInfo info;
  double relief = 0;  // m, unevenness of the surface
};

Vector3f point_of(const ShorePoint& at, const ProfilePoint& p) {
  const Eigen::Vector2d flat = at.edge + at.outward * p.out;
  return {static_cast<float>(flat.x()), static_cast<float>(flat.y()), static_cast<float>(p.up)};
}

// Moves a vertex by noise that depends on its place only, so that neighbouring quads stay joined.
Vector3f uneven(const Vector3f& p, double relief, std::uint32_t seed) {
  if (relief == 0) return p;
  const auto size = static_cast<float>(relief);
  const float x = (p.x() + 500) / 64, y = (p.y() + 0.7F * p.z() + 500) / 64;
  return p + size * Vector3f(tile_noise(x, y, 64, 2, seed), tile_noise(x, y, 64, 2, seed + 1),
                             1.3F * tile_noise(x, y, 96, 2, seed + 2));
}

void sweep(Mesh& mesh, const Shoreline& shore, std::size_t first, std::size_t last, const Strip& strip) {
  for (std::size_t i = first; i < last; ++i) {
    const ShorePoint &a = shore.points[i], &b = shore.points[i + 1];
    float up_along = 0;
    for (std::size_t k = 0; k + 1 < strip.profile.size(); ++k) {
      const ProfilePoint &p = strip.profile[k], &q = strip.profile[k + 1];
      const auto rise = static_cast<float>(std::hypot(q.out - p.out, q.up - p.up));
      mesh.add(uneven(point_of(a, p), strip.relief, shore.seed),
               uneven(point_of(b, p), strip.relief, shore.seed),
               uneven(point_of(b, q), strip.relief, shore.seed),
               uneven(point_of(a, q), strip.relief, shore.seed), strip.info,
               Vector2f(static_cast<float>(a.s), up_along), Vector2f(static_cast<float>(b.s - a.s), rise));
      up_along += rise;
    }
  }
}

std::vector<ProfilePoint> line(ProfilePoint from, ProfilePoint to, int pieces) {
  std::vector<ProfilePoint> points;
  for (int i = 0; i <= pieces; ++i) {
    const double x = static_cast<double>(i) / pieces;
    points.push_back({from.out + x * (to.out - from.out), from.up + x * (to.up - from.up)});
  }
  return points;
}

// Returns how far the bank's top lies behind the water's edge.
double build_face(Mesh& mesh, const Shoreline& shore, BankKind kind, std::size_t first, std::size_t last) {
  const double h = shore.bank.height;
  const double run = h / std::tan(shore.bank.slope * M_PI / 180);
  const auto wall = [&](Material material, float albedo) {
    sweep(mesh, shore, first, last, {line({0, -0.6}, {0.06 * h, h}, 5), {material, false, albedo}, 0});
    sweep(mesh, shore, first, last,
          {{{0.06 * h - 0.08, h},
            {0.06 * h - 0.08, h + 0.18},
            {0.06 * h + 0.45, h + 0.18},
            {0.06 * h + 0.45, h}},
           {Material::kConcrete, false, 0.42F},
           0});
    return 0.06 * h + 0.45;
  };
  switch (kind) {
    case BankKind::kMasonry:
      return wall(Material::kMasonry, 0.30F);
    case BankKind::kBrick:
      return wall(Material::kBrick, 0.24F);
    case BankKind::kConcrete:
      return wall(Material::kConcrete, 0.34F);
    case BankKind::kTimber:
      sweep(mesh, shore, first, last,
            {line({0.12, -0.6}, {0.12, h - 0.1}, 4), {Material::kWood, false, 0.15F}, 0});
      for (std::size_t i = first; i < last; ++i) {
        const auto top = static_cast<float>(h + 0.15 * unit(mix(shore.seed, static_cast<std::uint32_t>(i))));
        const Vector3f foot = point_of(shore.points[i], {0, -0.6});
        add_bar(mesh, foot, {foot.x(), foot.y(), top}, 0.11F, 0.10F, 7, {Material::kWood, false, 0.20F});
      }
      return 0.12;
    case BankKind::kEarth:
      sweep(mesh, shore, first, last,
            {line({-1.5, -0.5}, {0.4, 0.12}, 3), {Material::kGround, false, 0.14F}, 0.1});
      sweep(mesh, shore, first, last,
            {line({0.4, 0.12}, {run + 0.4, h}, 5), {Material::kGround, false, 0.20F}, 0.25});
      return run + 0.4;
    default:
      sweep(mesh, shore, first, last,
            {line({-0.6 * run / h, -0.6}, {run, h}, 7), {Material::kRubble, false, 0.33F}, 0.12});
      return run;
  }
}

// A pier hides the seam where a mixed bank changes its kind.
void build_seam(Mesh& mesh, const Shoreline& shore, double s) {
  const ShorePoint at = shore.at(s);
  const auto yaw = static_cast<float>(std::atan2(at.outward.y(), at.outward.x()));
  const auto depth = static_cast<float>(shore.bank.height / std::tan(shore.bank.slope * M_PI / 180) + 1.2);
  const Vector3f middle = point_of(at, {0.5 * static_cast<double>(depth) - 0.5, -0.6});
  add_box(mesh, {middle, {depth, 0.7F, static_cast<float>(shore.bank.height) + 1.0F}, yaw},
          {Material::kMasonry, false, 0.34F});
}

}  // namespace

void build_bank(Mesh& mesh, const Shoreline& shore, const SceneDescription& scene) {
  std::size_t first = 0;
  while (first + 1 < shore.points.size()) {
    const BankKind kind = shore.kind(shore.points[first].s);
    std::size_t last = first + 1;
    while (last + 1 < shore.points.size() && shore.kind(shore.points[last].s) == kind) ++last;
    const double top = build_face(mesh, shore, kind, first, last);
    const double h = shore.bank.height;
    sweep(mesh, shore, first, last,
          {{{top, h},
            {top + 1, h + 0.05},
            {top + 2.5, h + 0.12},
            {top + 6, h + 0.25},
            {top + 12, h + 0.5},
            {top + 30, h + 1.5}},
           {Material::kGround, false, 0.22F},
           0.06});
    if (last + 1 < shore.points.size()) build_seam(mesh, shore, shore.points[last].s);
    first = last;
  }
  // The land beyond, as wide as the far tree line stands away.
  const double far = std::max(40.0, scene.backdrop.tree_line + 20);
  Shoreline wide = shore;
  wide.points.clear();
  for (std::size_t i = 0; i < shore.points.size(); i += 8) wide.points.push_back(shore.points[i]);
  wide.points.push_back(shore.points.back());
  const double h = shore.bank.height;
  sweep(mesh, wide, 0, wide.points.size() - 1,
        {{{20, h + 0.6}, {60, h + 2}, {far, h + 2.2}}, {Material::kGround, false, 0.2F}, 0});
}

void build_bank_furniture(Mesh& mesh, const Shoreline& shore, const SceneDescription&) {
  Random random(shore.seed + 3);
  const double h = shore.bank.height, run = h / std::tan(shore.bank.slope * M_PI / 180);
  if (shore.bank.railing) {
    const QuadInfo paint{Material::kPaint, false, 0.55F};
    for (double s = 0; s + 2 < shore.length(); s += 2) {
      const BankKind kind = shore.kind(s);
      if (kind == BankKind::kEarth) continue;
      const double top = kind == BankKind::kRubble ? run + 0.2 : 0.3;
      const double base = h + (kind == BankKind::kRubble || kind == BankKind::kTimber ? 0.0 : 0.18);
      const Vector3f a = point_of(shore.at(s), {top, base}), b = point_of(shore.at(s + 2), {top, base});
      add_box(mesh, {a, {0.10F, 0.10F, 1.05F}, 0}, paint);
      for (const float up : {0.45F, 0.95F}) {
        const Vector3f lift(0, 0, up);
        add_bar(mesh, a + lift, b + lift, 0.03F, 0.03F, 5, paint);
      }
    }
  }
  const int groups = static_cast<int>(std::lround(shore.bank.piles * shore.length() / 100));
  for (int i = 0; i < groups; ++i) {
    const double s = random.uniform(0, shore.length());
    const int count = 1 + static_cast<int>(random.below(4));
    const double out = random.uniform(0.6, 2.2), up = random.uniform(0.6, 1.6);
    for (int k = 0; k < count; ++k) {
      const Vector3f foot = point_of(shore.at(std::min(s + 0.9 * k, shore.length())), {-out, -0.6});
      const Vector3f top(foot.x() + 0.05F, foot.y(), static_cast<float>(up * random.uniform(0.8, 1.2)));
      if (shore.at(s).clearance - out > 1.5)
        add_bar(mesh, foot, top, 0.13F, 0.12F, 9, {Material::kWood, false, 0.24F});
    }
  }
}

}  // namespace spslam::sim
