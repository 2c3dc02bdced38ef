// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Cameras around a ring: noisy motions from one to the next, and exact ones that close it.
#pragma once

#include "spslam/base/random.h"
#include "spslam/optimize/pose_graph.h"

namespace spslam::test {

inline Vector6d random_twist(Random& random, double translation, double rotation) {
  Vector6d xi;
  for (int i = 0; i < 6; ++i) xi[i] = (i < 3 ? translation : rotation) * random.normal();
  return xi;
}

struct Ring {
  std::vector<SE3> truth;  // camera_from_world
  PoseGraph graph;         // poses chained from the noisy motions, the first fixed; the loop edge comes last
};

inline Ring make_ring(int cameras, double translation_sigma, double rotation_sigma, std::uint64_t seed) {
  Random random(seed);
  Ring ring;
  for (int i = 0; i < cameras; ++i) {
    const double a = 2 * M_PI * i / cameras;
    const SE3 world_from_camera{so3_exp({0.1 * std::sin(3 * a), a, 0}),
                                {10 * std::sin(a), 0.2 * std::cos(5 * a), 10 * std::cos(a)}};
    ring.truth.push_back(world_from_camera.inverse());
  }
  Vector6d information;
  information << Eigen::Vector3d::Constant(std::pow(translation_sigma, -2)),
      Eigen::Vector3d::Constant(std::pow(rotation_sigma, -2));
  ring.graph.poses.push_back({ring.truth[0], true});
  for (int i = 1; i <= cameras; ++i) {
    const int j = i % cameras;
    const bool closes = j == 0;
    const SE3 motion = ring.truth[j] * ring.truth[i - 1].inverse();
    const SE3 noise =
        SE3::exp(closes ? Vector6d::Zero().eval() : random_twist(random, translation_sigma, rotation_sigma));
    ring.graph.edges.push_back({i - 1, j, noise * motion, information.asDiagonal(), false});
    if (closes) break;
    ring.graph.poses.push_back(
        {(noise * motion * ring.graph.poses.back().camera_from_world).normalized(), false});
  }
  return ring;
}

// The greatest distance of a camera from its true place, in m.
inline double worst_place(const Ring& ring) {
  double worst = 0;
  for (std::size_t i = 0; i < ring.truth.size(); ++i)
    worst = std::max(worst, (ring.graph.poses[i].camera_from_world.inverse().translation -
                             ring.truth[i].inverse().translation)
                                .norm());
  return worst;
}

}  // namespace spslam::test
