// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// From a description to things: the fixed world and the boats that move through it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "spslam/sim/mesh.h"
#include "spslam/sim/motion.h"
#include "spslam/sim/scene_description.h"
#include "spslam/sim/shore.h"

namespace spslam::sim {

// A boat on a straight course; its mesh is built facing along it.
struct TrafficBoat {
  Mesh mesh;
  Eigen::Vector2d start, velocity;  // m, m/s
  double heave = 0.03, phase = 0;   // m, rad
  Eigen::Vector3f position(double time) const;
};

struct World {
  Mesh fixed;
  std::vector<TrafficBoat> boats;
};

World build_world(const SceneDescription& scene, const BoatMotion& motion, std::uint32_t seed);

// The parts of it; each adds to `mesh`.
void build_bank(Mesh& mesh, const Shoreline& shore, const SceneDescription& scene);
void build_bank_furniture(Mesh& mesh, const Shoreline& shore, const SceneDescription& scene);
void build_bank_plants(Mesh& mesh, const Shoreline& shore, const SceneDescription& scene);
void build_houses(Mesh& mesh, const Shoreline& shore, const SceneDescription& scene);
void build_bridges(Mesh& mesh, const std::vector<ChannelPoint>& middle, const SceneDescription& scene);
void build_backdrop(Mesh& mesh, const std::vector<Shoreline>& shores, const Way& way,
                    const SceneDescription& scene, std::uint32_t seed);
std::vector<TrafficBoat> build_traffic(const SceneDescription& scene, const BoatMotion& motion,
                                       std::uint32_t seed);

}  // namespace spslam::sim
