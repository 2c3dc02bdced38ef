// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// A world of points with descriptors, and what a small boat's rig makes of them: positions to a pixel or so,
// poor depths, descriptors with flipped bits, and things that nobody saw before.
#pragma once

#include "features/made_up_descriptors.h"
#include "spslam/base/random.h"
#include "spslam/camera/stereo_rig.h"
#include "spslam/map/map.h"

namespace spslam::test {

inline StereoRig boat_rig() {
  return {.fx = 360, .fy = 360, .cx = 319.5, .cy = 179.5, .baseline = 0.08, .width = 640, .height = 360};
}

struct WorldPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // m, or a direction if it is at infinity
  bool at_infinity = false;
  Descriptor descriptor = {};
  double angle = 0;
  std::uint8_t octave = 0;
};

struct WorldOptions {
  int points = 600;
  double nearest = 3, farthest = 40;  // m from the middle of the world, in a ring
  double far_share = 0.2;             // of points at infinity
  std::uint64_t seed = 1;
};

// Points all around the origin, y down, a little above and below the horizon.
inline std::vector<WorldPoint> make_world(const WorldOptions& options) {
  Random random(options.seed);
  std::vector<WorldPoint> out;
  for (int i = 0; i < options.points; ++i) {
    WorldPoint point;
    const double azimuth = random.uniform(-M_PI, M_PI), elevation = random.uniform(-0.4, 0.4);
    const double depth = 1 / random.uniform(1 / options.farthest, 1 / options.nearest);
    point.position = Eigen::Vector3d(std::sin(azimuth), elevation, std::cos(azimuth));
    point.at_infinity = random.uniform() < options.far_share;
    if (!point.at_infinity) point.position *= depth;
    point.descriptor = random_descriptor(random);
    point.angle = random.uniform(-M_PI, M_PI);
    point.octave = static_cast<std::uint8_t>(random.below(4));
    out.push_back(point);
  }
  return out;
}

struct ViewOptions {
  double position_sigma = 0.7;    // px, times 1.2^octave
  double disparity_sigma = 0.15;  // px
  double unknown_share = 0.2;     // features without a depth
  double missed_share = 0.3;      // points in sight without a feature
  double wrong_share = 0;         // features that look like another point
  int flipped_bits = 16;
  int clutter = 100;  // features of nothing that is ever seen again
  double scale = 1;   // by which depths are too great
  double roll = 0;    // rad, added to the angles
  std::uint64_t seed = 1;
};

struct View {
  std::shared_ptr<KeyframeFeatures> features = std::make_shared<KeyframeFeatures>();
  std::vector<int> point;  // of each feature; -1 for clutter
};

inline void add_feature(View& view, int point, const Keypoint& keypoint, const Descriptor& descriptor,
                        double inverse_depth, double information) {
  view.point.push_back(point);
  view.features->keypoints.push_back(keypoint);
  view.features->descriptors.push_back(descriptor);
  view.features->inverse_depths.push_back(static_cast<float>(inverse_depth));
  view.features->information.push_back(static_cast<float>(information));
}

inline float wrapped(double angle) {
  return static_cast<float>(std::remainder(angle, 2 * M_PI));
}

inline View see(const std::vector<WorldPoint>& world, const SE3& camera_from_world,
                const ViewOptions& options) {
  const StereoRig rig = boat_rig();
  Random random(options.seed);
  View view;
  const double fb = rig.disparity_per_inverse_depth(), sigma_w = options.disparity_sigma / fb;
  for (std::size_t i = 0; i < world.size(); ++i) {
    const WorldPoint& point = world[i];
    const Eigen::Vector3d x = point.at_infinity ? Eigen::Vector3d(camera_from_world.rotation * point.position)
                                                : camera_from_world * point.position;
    if (x.z() < 0.3 || random.uniform() < options.missed_share) continue;
    const double sigma = options.position_sigma * std::pow(1.2, point.octave);
    const Eigen::Vector2d at = rig.project(x) + sigma * Eigen::Vector2d(random.normal(), random.normal());
    if (at.x() < 0 || at.y() < 0 || at.x() > rig.width - 1 || at.y() > rig.height - 1) continue;
    const double w = (point.at_infinity ? 0 : 1 / (x.z() * options.scale)) + sigma_w * random.normal();
    const bool known = random.uniform() >= options.unknown_share;
    const bool wrong = random.uniform() < options.wrong_share;
    const Descriptor& looks =
        wrong ? world[random.below(static_cast<std::uint32_t>(world.size()))].descriptor : point.descriptor;
    const Keypoint keypoint{static_cast<float>(at.x()), static_cast<float>(at.y()),
                            wrapped(point.angle + options.roll + 0.05 * random.normal()), 50, point.octave};
    add_feature(view, static_cast<int>(i), keypoint, flip_bits(looks, options.flipped_bits, random),
                known ? w : 0, known ? 1 / (sigma_w * sigma_w) : 0);
  }
  for (int i = 0; i < options.clutter; ++i)
    add_feature(
        view, -1,
        {static_cast<float>(random.uniform(0, rig.width)), static_cast<float>(random.uniform(0, rig.height)),
         wrapped(random.uniform(-M_PI, M_PI)), 50, 0},
        random_descriptor(random), random.uniform(0, 0.2), 1 / (sigma_w * sigma_w));
  return view;
}

// camera_from_world of a camera at a place, turned about the vertical and rolled.
inline SE3 camera_at(double x, double z, double turn, double roll = 0, double y = 0) {
  const SE3 world_from_camera{so3_exp({0, turn, 0}) * so3_exp({0, 0, roll}), {x, y, z}};
  return world_from_camera.inverse();
}

}  // namespace spslam::test
