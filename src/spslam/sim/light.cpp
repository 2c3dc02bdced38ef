// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/sim/light.h"

#include <oneapi/tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <cmath>

#include "spslam/sim/hash.h"

namespace spslam::sim {
namespace {

using Eigen::Vector3f;

bool blocked(RTCScene scene, const Vector3f& from, const Vector3f& direction, float reach) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray{};
  ray.org_x = from.x(), ray.org_y = from.y(), ray.org_z = from.z();
  ray.dir_x = direction.x(), ray.dir_y = direction.y(), ray.dir_z = direction.z();
  ray.tnear = 0.01F, ray.tfar = reach, ray.mask = ~0U;
  rtcOccluded1(scene, &context, &ray);
  return ray.tfar < 0;
}

Vector3f cosine_direction(const Vector3f& normal, float a, float b) {
  const float r = std::sqrt(a), angle = 2 * static_cast<float>(M_PI) * b;
  const Vector3f x = normal.unitOrthogonal(), y = normal.cross(x);
  return x * (r * std::cos(angle)) + y * (r * std::sin(angle)) + normal * std::sqrt(std::max(0.0F, 1 - a));
}

struct Spot {
  Vector3f at, normal;
  bool thin;
  std::uint32_t key;
};

float light_at(RTCScene scene, const Sky& sky, const Spot& spot) {
  constexpr int kRays = 6;
  constexpr float kReach = 25;  // m; what is farther counts as open
  float open = 0;
  for (int i = 0; i < kRays; ++i) {
    const std::uint32_t key = mix(spot.key, static_cast<std::uint32_t>(i));
    const Vector3f up = spot.thin ? Vector3f(0, 0, 1) : spot.normal;
    const Vector3f d = cosine_direction(up, (static_cast<float>(i) + unit(key)) / kRays, unit(mix(key, 5)));
    // From below comes what water and ground send back; from a thing in the way, a little.
    const float full = d.z() > 0 ? 1.0F : 0.35F;
    open += blocked(scene, spot.at, d, kReach) ? 0.16F : full;
  }
  float result = sky.ambient() * open / kRays;
  if (sky.sun() > 0) {
    const float facing = spot.normal.dot(sky.sun_direction());
    const float strength = spot.thin ? 0.35F + 0.5F * std::abs(facing) : std::max(0.0F, facing);
    const Vector3f blur =
        0.012F * Vector3f(unit(mix(spot.key, 71)) - 0.5F, unit(mix(spot.key, 73)) - 0.5F, 0);
    if (strength > 0 && !blocked(scene, spot.at, sky.sun_direction() + blur, 400))
      result += sky.sun() * strength;
  }
  return result;
}

const Vector3f& nearest(const std::vector<Vector3f>& viewers, const Vector3f& point) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < viewers.size(); ++i)
    if ((viewers[i] - point).squaredNorm() < (viewers[best] - point).squaredNorm()) best = i;
  return viewers[best];
}

}  // namespace

void bake_light(RayScene& lit, const RayScene& casters, const Sky& sky, const std::vector<Vector3f>& viewers,
                std::uint32_t seed) {
  Mesh& mesh = lit.mesh();
  tbb::parallel_for(std::size_t{0}, mesh.quads.size(), [&](std::size_t q) {
    const Vector3f* p = &mesh.points[4 * q];
    const Vector3f middle = 0.25F * (p[0] + p[1] + p[2] + p[3]);
    Vector3f normal = (p[2] - p[0]).cross(p[3] - p[1]);
    if (normal.squaredNorm() < 1e-14F) return;
    normal.normalize();
    if (normal.dot(nearest(viewers, middle) - middle) < 0) normal = -normal;
    const auto key = mix(static_cast<std::uint32_t>(q), seed);
    const bool thin = mesh.quads[q].thin;
    const bool far = (middle - nearest(viewers, middle)).squaredNorm() > 150.0F * 150.0F;
    if (thin || far) {
      const float light = light_at(casters.handle(), sky, {middle + 0.01F * normal, normal, thin, key});
      for (std::size_t c = 0; c < 4; ++c) mesh.corners[4 * q + c].light = light;
      return;
    }
    for (std::size_t c = 0; c < 4; ++c) {
      const Vector3f at = p[c] + 0.06F * (middle - p[c]) + 0.02F * normal;
      mesh.corners[4 * q + c].light = light_at(casters.handle(), sky, {at, normal, thin, key});
    }
  });
}

}  // namespace spslam::sim
