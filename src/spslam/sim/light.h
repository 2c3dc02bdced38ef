// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Light that does not change: sun, shadow and sky at every corner of a mesh, worked out once.
#pragma once

#include <cstdint>
#include <vector>

#include "spslam/sim/ray_scene.h"
#include "spslam/sim/sky.h"

namespace spslam::sim {

// `casters` is what throws shadows on `lit` (usually itself). Faces are lit on the side towards the nearest
// of `viewers`.
void bake_light(RayScene& lit, const RayScene& casters, const Sky& sky,
                const std::vector<Eigen::Vector3f>& viewers, std::uint32_t seed);

}  // namespace spslam::sim
