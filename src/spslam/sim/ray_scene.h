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

  void set(int lane, const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float near, float far);
  void skip(int lane);
  Eigen::Vector3f origin(int lane) const;
  Eigen::Vector3f direction(int lane) const;
  Target target(int lane) const;
};

}  // namespace spslam::sim
