// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// A scene that is built and rendered in a moment.
#pragma once

#include "spslam/sim/simulator.h"

namespace spslam::sim {

inline SceneDescription small_scene() {
  SceneDescription scene = parse_scene(R"(
path: {length: 14, speed: 1.5, bend: 0.1}
shore:
  left: {kind: masonry, distance: 5, height: 1.8, trees: 4, tree_height: 4, bushes: 4, reeds: 0, piles: 0}
  right: {kind: concrete, distance: 4, height: 1.6, trees: 0, bushes: 0, reeds: 0, piles: 4}
backdrop: {tree_density: 0.1, towers: 4}
sky: {cloud_cover: 0.3}
water: {wind: 1, chop: 0.3}
rig: {focal: 120, width: 208, height: 112, baseline: 0.12}
render: {detail: 0.1}
)",
                                       "small scene");
  scene.check();
  return scene;
}

}  // namespace spslam::sim
