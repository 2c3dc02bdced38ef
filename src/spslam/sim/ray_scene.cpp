// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/sim/ray_scene.h"

#include "spslam/base/error.h"

namespace spslam::sim {

using Eigen::Vector3f;

EmbreeDevice make_embree_device() {
  // One thread pool: Embree builds with the TBB that renders.
  EmbreeDevice device(rtcNewDevice(nullptr));
  if (!device)
    throw Error("Embree cannot start (error " + std::to_string(rtcGetDeviceError(nullptr)) +
                "); is the processor older than SSE2, or memory exhausted?");
  return device;
}

RayScene::RayScene(RTCDevice device, Mesh mesh) : mesh_(std::move(mesh)), scene_(rtcNewScene(device)) {
  const std::size_t quads = mesh_.quads.size();
  // Embree reads 16 bytes a point, so one more point must follow the last.
  mesh_.points.reserve(4 * quads + 2);
  mesh_.points.push_back(Vector3f::Zero());
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh_.points.data(), 0,
                             sizeof(Vector3f), 4 * quads);
  auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(unsigned), quads));
  for (std::size_t i = 0; i < 4 * quads; ++i) index[i] = static_cast<unsigned>(i);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_.get(), geometry);
  rtcReleaseGeometry(geometry);
  // Leaves overlap in every direction: splitting them costs a second once and saves an eighth of each image.
  rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_HIGH);
  rtcCommitScene(scene_.get());
  if (const RTCError error = rtcGetDeviceError(device); error != RTC_ERROR_NONE)
    throw Error("Embree cannot build the scene of " + std::to_string(quads) + " quads (error " +
                std::to_string(error) + "); if memory is short, lower render.detail");
  for (std::size_t i = 0; i < 4 * quads; ++i) centre_ += mesh_.points[i] / static_cast<float>(4 * quads);
  for (std::size_t i = 0; i < 4 * quads; ++i) radius_ = std::max(radius_, (mesh_.points[i] - centre_).norm());
}

}  // namespace spslam::sim
