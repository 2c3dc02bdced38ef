// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Light along rays: fixed world, boats, water with one reflection, sky, fog.
#pragma once

#include <cstdint>
#include <vector>

#include "spslam/sim/ray_scene.h"
#include "spslam/sim/scene_builder.h"
#include "spslam/sim/sky.h"
#include "spslam/sim/texture.h"
#include "spslam/sim/water.h"

namespace spslam::sim {

// The moving things of one instant.
struct Instant {
  Water::Surface water;
  std::vector<Eigen::Vector3f> boats;  // positions, m
};

class Tracer {
 public:
  Tracer(const SceneDescription& scene, World world, const Way& way, std::uint32_t seed);

  Instant instant(double time) const;
  // Nearest hits of the group's active rays with all but the water.
  void intersect(const Instant& instant, RayGroup& rays,
                 RTCIntersectContextFlags kind = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT) const;
  // Radiance along the active rays. `pixel_angle` is the angle a pixel covers in rad; `key` a random number a
  // lane.
  void radiance(const Instant& instant, RayGroup& rays, float pixel_angle,
                const std::array<std::uint32_t, kLanes>& key, Lanes& result) const;
  std::size_t quad_count() const { return fixed_->mesh().quads.size(); }

 private:
  // Which of the active rays pass a ball: whether any does.
  static bool pass_near(const RayGroup& rays, const Eigen::Vector3f& centre, float radius,
                        std::array<bool, kLanes>& near);
  void intersect_boat(std::size_t boat, const Eigen::Vector3f& position, RayGroup& rays) const;
  void send_for_hits(const RayGroup& rays) const;
  float surface(const RayGroup& rays, int lane, float pixel_angle, std::uint32_t key) const;
  float fogged(float radiance, float distance) const;
  void reflect(const Instant& instant, RayGroup& rays, const Lanes& water_at, float pixel_angle,
               const std::array<std::uint32_t, kLanes>& key, Lanes& result) const;

  EmbreeDevice device_;
  std::unique_ptr<RayScene> fixed_;
  std::vector<RayScene> boats_;
  std::vector<TrafficBoat> courses_;
  Sky sky_;
  Water water_;
  Materials materials_;
  float extinction_ = 0;   // 1/m
  float depth_light_ = 0;  // radiance that comes up out of the water
};

}  // namespace spslam::sim
