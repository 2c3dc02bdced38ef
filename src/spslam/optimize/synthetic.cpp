// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/optimize/synthetic.h"

#include "spslam/base/random.h"

namespace spslam {
namespace {

constexpr double kMargin = 8;  // px; points are born and seen this far inside of the image

StereoRig small_rig() {
  StereoRig rig;
  rig.fx = rig.fy = 380;
  rig.cx = 319.5, rig.cy = 179.5;
  rig.baseline = 0.12;
  rig.width = 640, rig.height = 360;
  return rig;
}

SE3 pose_of(int camera, const SyntheticOptions& options) {
  const double s = camera * options.step, a = camera * options.turn;
  const Eigen::Vector3d centre(0.3 * s, 0.05 * std::sin(s), s);
  const SE3 world_from_camera{so3_exp({0.3 * a, a, 0.5 * std::sin(a)}), centre};
  return world_from_camera.inverse();
}

LandmarkVariable draw_landmark(const SyntheticOptions& options, const StereoRig& rig, int host,
                               Random& random) {
  LandmarkVariable landmark;
  landmark.host = host;
  const double u = random.uniform(kMargin, rig.width - kMargin),
               v = random.uniform(kMargin, rig.height - kMargin);
  landmark.bearing = rig.bearing(u, v);
  const double near = random.uniform(1 / options.farthest, 1 / options.nearest);
  landmark.inverse_depth = random.uniform() < options.far_share ? 0 : near;
  return landmark;
}

bool is_seen(const StereoRig& rig, const Eigen::Vector3d& x) {
  if (x.z() < 1e-3) return false;
  const Eigen::Vector2d p = rig.project(x);
  return p.x() >= kMargin && p.y() >= kMargin && p.x() <= rig.width - kMargin &&
         p.y() <= rig.height - kMargin;
}

Eigen::Vector3d true_measurement(const Problem& problem, const LandmarkVariable& landmark,
                                 const Eigen::Vector3d& x) {
  const StereoRig& rig = problem.rig;
  const Eigen::Vector2d p = rig.project(x);
  const double disparity = rig.disparity_per_inverse_depth() * landmark.inverse_depth / x.z();
  return {p.x(), p.y(), disparity + problem.disparity_offset.at(rig, p.x(), p.y())};
}

// What camera `pose` sees of landmark `l`, if it does.
void observe(int l, int pose, const SyntheticOptions& options, SyntheticWorld& world, Random& random) {
  Problem& problem = world.truth;
  const LandmarkVariable& landmark = problem.landmarks[l];
  const SE3 motion =
      problem.poses[pose].camera_from_world * problem.poses[landmark.host].camera_from_world.inverse();
  const Eigen::Vector3d x = motion.rotation * landmark.bearing + landmark.inverse_depth * motion.translation;
  if (!is_seen(problem.rig, x)) return;
  const bool own = landmark.host == pose, outlier = !own && random.uniform() < options.outlier_share;
  Observation z{l, pose, true_measurement(problem, landmark, x), Eigen::Vector3d::Zero(), 1};
  const Eigen::Vector3d noise(random.normal(), random.normal(), random.normal());
  const Eigen::Vector3d sigma(options.position_sigma, options.position_sigma, options.disparity_sigma);
  z.inverse_sigma = sigma.cwiseInverse();
  if (own) z.inverse_sigma.head<2>().setZero();
  const Eigen::Vector3d used(own ? 0 : sigma.x(), own ? 0 : sigma.y(), sigma.z());
  if (options.noise) z.measured += used.cwiseProduct(noise);
  if (outlier) {
    const double length = random.uniform(20, 60), direction = random.uniform(0, 2 * M_PI);
    z.measured += Eigen::Vector3d(length * std::cos(direction), length * std::sin(direction), 0.5 * length);
  }
  problem.observations.push_back(z);
  world.is_outlier.push_back(outlier);
}

}  // namespace

SyntheticWorld make_synthetic_world(const SyntheticOptions& options) {
  Random random(options.seed);
  SyntheticWorld world;
  Problem& problem = world.truth;
  problem.rig = small_rig();
  problem.disparity_offset.coefficients = options.offset;
  for (int camera = 0; camera < options.cameras; ++camera)
    problem.poses.push_back({pose_of(camera, options), camera == 0});
  for (int l = 0; l < options.points; ++l)
    problem.landmarks.push_back(draw_landmark(options, problem.rig, l % options.hosts, random));
  for (int l = 0; l < options.points; ++l)
    for (int camera = 0; camera < options.cameras; ++camera) observe(l, camera, options, world, random);
  return world;
}

void disturb(Problem& problem, const Disturbance& disturbance) {
  Random random(disturbance.seed);
  for (PoseVariable& pose : problem.poses) {
    Vector6d xi;
    for (int i = 0; i < 6; ++i)
      xi[i] = (i < 3 ? disturbance.translation : disturbance.rotation) * random.normal();
    if (!pose.fixed) pose.camera_from_world = SE3::exp(xi) * pose.camera_from_world;
  }
  for (LandmarkVariable& landmark : problem.landmarks) {
    const double by = disturbance.inverse_depth * random.normal();
    if (!landmark.fixed) landmark.inverse_depth += by;
  }
}

}  // namespace spslam
