// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Trees, bushes, reeds and grass out of leaf cards.
#pragma once

#include <Eigen/Core>

#include "spslam/base/random.h"
#include "spslam/sim/mesh.h"

namespace spslam::sim {

struct TreeShape {
  Eigen::Vector3f foot = Eigen::Vector3f::Zero();
  float height = 7;                                // m
  float crown = 2.5F;                              // m, radius
  float leaf = 0.2F;                               // m, length of a card
  int leaves = 2500;                               // cards
  bool weeping = false;                            // branches hang down like a willow's
  Eigen::Vector2f lean = Eigen::Vector2f::Zero();  // m, of the crown against the foot
};

void add_tree(Mesh& mesh, const TreeShape& tree, Random& random);
void add_bush(Mesh& mesh, const Eigen::Vector3f& foot, float radius, float leaf, int leaves, Random& random);
void add_reeds(Mesh& mesh, const Eigen::Vector3f& foot, float radius, float height, int blades,
               Random& random);

}  // namespace spslam::sim
