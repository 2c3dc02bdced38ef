// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Meshes made ready for tracing with Embree.
#pragma once

#include <embree3/rtcore.h>

#include <memory>

#include "spslam/sim/mesh.h"
#include "spslam/sim/water.h"

namespace spslam::sim {

struct EmbreeRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using EmbreeDevice = std::unique_ptr<RTCDeviceTy, EmbreeRelease>;
using EmbreeScene = std::unique_ptr<RTCSceneTy, EmbreeRelease>;

EmbreeDevice make_embree_device();

// Keeps the mesh: Embree reads its points in place.
class RayScene {
 public:
  RayScene(RTCDevice device, Mesh mesh);

  const Mesh& mesh() const { return mesh_; }
  Mesh& mesh() { return mesh_; }  // for its light; points must stay as they are
  RTCScene handle() const { return scene_.get(); }
  const Eigen::Vector3f& centre() const { return centre_; }
  float radius() const { return radius_; }

 private:
  Mesh mesh_;
  EmbreeScene scene_;
  Eigen::Vector3f centre_ = Eigen::Vector3f::Zero();
  float radius_ = 0;  // m, of the ball about centre that holds all points
};

// Where a ray went.
enum class Target : std::uint8_t { kNone, kFixed, kBoat };

// kLanes rays side by side. Directions need not be of unit length; `t` counts in their length.
struct RayGroup {
  alignas(64) RTCRayHit16 data;
  alignas(64) std::array<int, kLanes> active;  // -1 = yes, 0 = no (Embree's convention)
  std::array<std::int16_t, kLanes> boat;       // index of the boat hit, -1 if none

  void set(int lane, const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float near, float far) {
    RTCRay16& ray = data.ray;
    active[static_cast<std::size_t>(lane)] = -1;
    boat[static_cast<std::size_t>(lane)] = -1;
    ray.org_x[lane] = origin.x(), ray.org_y[lane] = origin.y(), ray.org_z[lane] = origin.z();
    ray.dir_x[lane] = direction.x(), ray.dir_y[lane] = direction.y(), ray.dir_z[lane] = direction.z();
    ray.tnear[lane] = near, ray.tfar[lane] = far;
    ray.time[lane] = 0, ray.mask[lane] = ~0U, ray.id[lane] = 0, ray.flags[lane] = 0;
    data.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    data.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
  }
  void skip(int lane) {
    set(lane, Eigen::Vector3f::Zero(), Eigen::Vector3f::UnitZ(), 0, 0);
    active[static_cast<std::size_t>(lane)] = 0;
  }
  Eigen::Vector3f origin(int lane) const {
    return {data.ray.org_x[lane], data.ray.org_y[lane], data.ray.org_z[lane]};
  }
  Eigen::Vector3f direction(int lane) const {
    return {data.ray.dir_x[lane], data.ray.dir_y[lane], data.ray.dir_z[lane]};
  }
  Target target(int lane) const {
    if (boat[static_cast<std::size_t>(lane)] >= 0) return Target::kBoat;
    return data.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID ? Target::kNone : Target::kFixed;
  }
};

}  // namespace spslam::sim
