// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/sim/scene_builder.h"

namespace spslam::sim {

World build_world(const SceneDescription& scene, const BoatMotion& motion, std::uint32_t seed) {
  World world;
  const std::vector<Shoreline> shores = make_shorelines(scene, motion.way(), seed);
  for (const Shoreline& shore : shores) {
    build_bank(world.fixed, shore, scene);
    build_bank_furniture(world.fixed, shore, scene);
    build_bank_plants(world.fixed, shore, scene);
    build_houses(world.fixed, shore, scene);
  }
  build_bridges(world.fixed, channel_middle(scene, motion.way(), 0.5), scene);
  build_backdrop(world.fixed, shores, motion.way(), scene, seed);
  world.boats = build_traffic(scene, motion, scene.passage_seed(seed));
  return world;
}

}  // namespace spslam::sim
