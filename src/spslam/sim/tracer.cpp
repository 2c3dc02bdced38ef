// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/sim/tracer.h"

#include <algorithm>
#include <cmath>

#include "spslam/base/simd.h"
#include "spslam/sim/hash.h"
#include "spslam/sim/light.h"

namespace spslam::sim {
namespace {

using Eigen::Vector3f;

constexpr float kFar = 5000;  // m

std::vector<Vector3f> viewers_on(const Way& way, float height) {
  std::vector<Vector3f> viewers;
  for (double s = 0; s <= way.length(); s += std::max(2.0, way.length() / 48)) {
    const Eigen::Vector2f at = way.position(s).cast<float>();
    viewers.emplace_back(at.x(), at.y(), height);
  }
  return viewers;
}

MaterialSet used_materials(const Mesh& fixed, const std::vector<TrafficBoat>& boats) {
  MaterialSet used{};
  const auto note = [&](const Mesh& mesh) {
    for (const QuadInfo& quad : mesh.quads) used[static_cast<std::size_t>(quad.material)] = true;
  };
  note(fixed);
  for (const TrafficBoat& boat : boats) note(boat.mesh);
  return used;
}

}  // namespace

Tracer::Tracer(const SceneDescription& scene, World world, const Way& way, std::uint32_t seed)
    : device_(make_embree_device()),
      fixed_(std::make_unique<RayScene>(device_.get(), std::move(world.fixed))),
      courses_(std::move(world.boats)),
      sky_(scene.sky, seed),
      water_(scene.water, scene.rain, scene.passage_seed(seed)),
      materials_(seed, used_materials(fixed_->mesh(), courses_)) {
  const std::vector<Vector3f> viewers = viewers_on(way, static_cast<float>(scene.rig.above_water));
  bake_light(*fixed_, *fixed_, sky_, viewers, seed);
  for (TrafficBoat& course : courses_) {
    boats_.emplace_back(device_.get(), std::move(course.mesh));
    // Seen from anywhere around, lit as in the open.
    std::vector<Vector3f> around;
    for (int i = 0; i < 8; ++i)
      around.emplace_back(30 * std::cos(0.785F * static_cast<float>(i)),
                          30 * std::sin(0.785F * static_cast<float>(i)), 2.0F);
    RayScene& boat = boats_.back();
    bake_light(boat, boat, sky_, around, seed + 1);
  }
  extinction_ =
      3.912F / static_cast<float>(scene.air.visibility);  // Koschmieder: 2 % contrast at the visibility
  depth_light_ = static_cast<float>(scene.water.turbidity) *
                 (sky_.ambient() + 0.5F * sky_.sun() * sky_.sun_direction().z());
}

Instant Tracer::instant(double time) const {
  Instant result{water_.at(time), {}};
  for (const TrafficBoat& boat : courses_) result.boats.push_back(boat.position(time));
  return result;
}

void Tracer::intersect(const Instant& instant, RayGroup& rays, RTCIntersectContextFlags kind) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = kind;
  rtcIntersect16(rays.active.data(), fixed_->handle(), &context, &rays.data);
  for (std::size_t i = 0; i < boats_.size(); ++i) intersect_boat(i, instant.boats[i], rays);
}

// Most rays pass most boats far away. Written so that the compiler makes vectors of it.
SPSLAM_SIMD bool Tracer::pass_near(const RayGroup& rays, const Vector3f& centre, float radius,
                                   std::array<bool, kLanes>& near) {
  const RTCRay16& ray = rays.data.ray;
  const float cx = centre.x(), cy = centre.y(), cz = centre.z(), limit = radius * radius;
  int count = 0;
  for (int lane = 0; lane < kLanes; ++lane) {
    const float dx = ray.dir_x[lane], dy = ray.dir_y[lane], dz = ray.dir_z[lane];
    const float x = cx - ray.org_x[lane], y = cy - ray.org_y[lane], z = cz - ray.org_z[lane];
    const float ahead = (x * dx + y * dy + z * dz) / (dx * dx + dy * dy + dz * dz);
    const float along = ahead > 0 ? ahead : 0;
    const float px = x - along * dx, py = y - along * dy, pz = z - along * dz;
    const bool passes =
        (px * px + py * py + pz * pz <= limit) & (rays.active[static_cast<std::size_t>(lane)] != 0);
    near[static_cast<std::size_t>(lane)] = passes;
    count += passes;
  }
  return count > 0;
}

void Tracer::intersect_boat(std::size_t index, const Vector3f& position, RayGroup& rays) const {
  const RayScene& boat = boats_[index];
  std::array<bool, kLanes> near;
  if (!pass_near(rays, boat.centre() + position, boat.radius(), near)) return;
  RayGroup local;
  for (int lane = 0; lane < kLanes; ++lane) {
    local.skip(lane);
    if (near[static_cast<std::size_t>(lane)])
      local.set(lane, rays.origin(lane) - position, rays.direction(lane), rays.data.ray.tnear[lane],
                rays.data.ray.tfar[lane]);
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect16(local.active.data(), boat.handle(), &context, &local.data);
  for (int lane = 0; lane < kLanes; ++lane) {
    if (!local.active[static_cast<std::size_t>(lane)] ||
        local.data.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID)
      continue;
    rays.boat[static_cast<std::size_t>(lane)] = static_cast<std::int16_t>(index);
    rays.data.ray.tfar[lane] = local.data.ray.tfar[lane];
    RTCHit16 &to = rays.data.hit, &from = local.data.hit;
    to.primID[lane] = from.primID[lane], to.u[lane] = from.u[lane], to.v[lane] = from.v[lane];
    to.Ng_x[lane] = from.Ng_x[lane], to.Ng_y[lane] = from.Ng_y[lane], to.Ng_z[lane] = from.Ng_z[lane];
    to.geomID[lane] = 0;
  }
}

// The mesh is larger than the caches: what the hits will read is sent for while the first of them are shaded.
void Tracer::send_for_hits(const RayGroup& rays) const {
  const Mesh& mesh = fixed_->mesh();
  for (int lane = 0; lane < kLanes; ++lane) {
    if (!rays.active[static_cast<std::size_t>(lane)] || rays.target(lane) != Target::kFixed) continue;
    const std::size_t quad = rays.data.hit.primID[lane];
    __builtin_prefetch(&mesh.corners[4 * quad]);
    __builtin_prefetch(&mesh.corners[4 * quad + 3]);
    __builtin_prefetch(&mesh.quads[quad]);
  }
}

float Tracer::surface(const RayGroup& rays, int lane, float pixel_angle, std::uint32_t key) const {
  const std::int16_t boat = rays.boat[static_cast<std::size_t>(lane)];
  const Mesh& mesh = boat >= 0 ? boats_[static_cast<std::size_t>(boat)].mesh() : fixed_->mesh();
  const RTCHit16& hit = rays.data.hit;
  const std::size_t quad = hit.primID[lane];
  const Corner* c = &mesh.corners[4 * quad];
  const float u = hit.u[lane], v = hit.v[lane];
  // Embree's quads are two triangles, the second one counted from the far corner.
  const bool first = u + v <= 1;
  const Corner &o = first ? c[0] : c[2], &p = first ? c[1] : c[3], &q = first ? c[3] : c[1];
  const float a = first ? u : 1 - u, b = first ? v : 1 - v;
  const auto blend = [&](float x, float y, float z) { return x + a * (y - x) + b * (z - x); };
  const Vector3f d = rays.direction(lane), n(hit.Ng_x[lane], hit.Ng_y[lane], hit.Ng_z[lane]);
  const float length = d.norm();
  const float cosine = std::abs(n.dot(d)) / (n.norm() * length + 1e-12F);
  // Between the pixel's width and its length on a slanting face; a little sharp, since several rays share a
  // pixel.
  const float footprint =
      0.6F * pixel_angle * rays.data.ray.tfar[lane] * length / std::sqrt(std::max(cosine, 0.02F));
  const QuadInfo& info = mesh.quads[quad];
  const float factor =
      materials_.factor(info.material, blend(o.u, p.u, q.u), blend(o.v, p.v, q.v), footprint, unit(key));
  return info.albedo * factor * blend(o.light, p.light, q.light);
}

float Tracer::fogged(float radiance, float distance) const {
  const float clear = std::exp(-extinction_ * distance);
  return radiance * clear + sky_.horizon() * (1 - clear);
}

void Tracer::radiance(const Instant& instant, RayGroup& rays, float pixel_angle,
                      const std::array<std::uint32_t, kLanes>& key, Lanes& result) const {
  // The calm plane is exact geometry; rays end there.
  Lanes water_at{};
  for (int lane = 0; lane < kLanes; ++lane) {
    const float dz = rays.data.ray.dir_z[lane];
    const float t = dz < -1e-6F ? -rays.data.ray.org_z[lane] / dz : kFar;
    water_at[static_cast<std::size_t>(lane)] = t;
    if (t < rays.data.ray.tfar[lane]) rays.data.ray.tfar[lane] = t;
  }
  intersect(instant, rays, RTC_INTERSECT_CONTEXT_FLAG_COHERENT);
  send_for_hits(rays);
  bool any_water = false;
  for (int lane = 0; lane < kLanes; ++lane) {
    const auto i = static_cast<std::size_t>(lane);
    if (!rays.active[i]) continue;
    if (rays.target(lane) != Target::kNone) {
      const float distance = rays.data.ray.tfar[lane] * rays.direction(lane).norm();
      result[i] = fogged(surface(rays, lane, pixel_angle, key[i]), distance);
      rays.active[i] = 0;
    } else if (water_at[i] >= kFar) {
      const Vector3f d = rays.direction(lane);
      result[i] = fogged(sky_.radiance(d), d.z() > 0.02F * d.norm() ? 60 * d.norm() / d.z() : 3000);
      rays.active[i] = 0;
    } else {
      any_water = true;
    }
  }
  if (any_water) reflect(instant, rays, water_at, pixel_angle, key, result);
}

namespace {

struct Mirror {
  Vector3f direction;  // unit
  float share;         // Fresnel's, of the light that is reflected
};

// A ripple's slope that would turn its back to the viewer is hidden by the one before it, which faces him.
Mirror mirror(const Vector3f& d, float slope_x, float slope_y) {
  const Vector3f view = -d.normalized();
  const float flat = std::sqrt(view.x() * view.x() + view.y() * view.y()) + 1e-9F;
  const float hx = view.x() / flat, hy = view.y() / flat;
  const float towards = -(slope_x * hx + slope_y * hy);  // > 0: faces the viewer
  if (towards < -0.8F * view.z() / flat) {
    slope_x += 2 * towards * hx;
    slope_y += 2 * towards * hy;
  }
  const Vector3f n = Vector3f(-slope_x, -slope_y, 1).normalized();
  const float cosine = std::clamp(n.dot(view), 0.02F, 1.0F);
  Vector3f r = 2 * n.dot(view) * n - view;
  r.z() = std::max(std::abs(r.z()), 1e-3F);
  const float one = 1 - cosine, two = one * one;
  return {r, 0.02F + 0.98F * two * two * one};  // Schlick, 1994
}

}  // namespace

void Tracer::reflect(const Instant& instant, RayGroup& rays, const Lanes& water_at, float pixel_angle,
                     const std::array<std::uint32_t, kLanes>& key, Lanes& result) const {
  Lanes x{}, y{}, footprint, slope_x, slope_y, share{}, first{};
  footprint.fill(-1);  // of lanes that are not asked for
  for (std::size_t i = 0; i < kLanes; ++i)
    if (rays.active[i]) {
      const Vector3f p = rays.origin(static_cast<int>(i)) + water_at[i] * rays.direction(static_cast<int>(i));
      x[i] = p.x(), y[i] = p.y();
      const Vector3f d = rays.direction(static_cast<int>(i));
      first[i] = water_at[i] * d.norm();
      // Between the pixel's width and its much greater length on the slanting plane.
      footprint[i] = pixel_angle * first[i] * std::sqrt(d.norm() / std::max(-d.z(), 0.01F));
    }
  instant.water.slopes(x, y, footprint, slope_x, slope_y);
  RayGroup mirrored;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const int lane = static_cast<int>(i);
    mirrored.skip(lane);
    if (!rays.active[i]) continue;
    const Vector3f d = rays.direction(lane);
    const Mirror bounce = mirror(d, slope_x[i], slope_y[i]);
    share[i] = bounce.share;
    mirrored.set(lane, {x[i], y[i], 0.0F}, bounce.direction, 0.005F, kFar);
  }
  intersect(instant, mirrored);
  send_for_hits(mirrored);
  for (std::size_t i = 0; i < kLanes; ++i) {
    if (!rays.active[i]) continue;
    const int lane = static_cast<int>(i);
    const Vector3f d = mirrored.direction(lane);
    float light = 0;
    if (mirrored.target(lane) != Target::kNone) {
      const float second = mirrored.data.ray.tfar[lane];
      // Ripples blur what they mirror: twice the footprint.
      light = fogged(
          surface(mirrored, lane, 2 * pixel_angle * (1 + first[i] / std::max(second, 0.1F)), key[i]), second);
    } else {
      light = fogged(sky_.radiance(d), d.z() > 0.02F ? 60 / d.z() : 3000) + sky_.glint(d);
    }
    result[i] = fogged(share[i] * light + (1 - share[i]) * depth_light_, first[i]);
  }
}

}  // namespace spslam::sim
