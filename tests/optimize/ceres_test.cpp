// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The same problems solved by Ceres with automatic derivatives must end at the same cost.

#include <ceres/ceres.h>
#include <ceres/rotation.h>
#include <gtest/gtest.h>

#include "spslam/optimize/synthetic.h"

namespace spslam {
namespace {

// A pose is six numbers: rotation vector, then translation, of camera_from_world.
using PoseBlock = std::array<double, 6>;

PoseBlock block_of(const SE3& pose) {
  PoseBlock block;
  Eigen::Map<Eigen::Vector3d>(block.data()) = so3_log(pose.rotation);
  Eigen::Map<Eigen::Vector3d>(block.data() + 3) = pose.translation;
  return block;
}

// The scaled point R b + w t in the observing camera, by way of the world.
template <class T>
Eigen::Matrix<T, 3, 1> scaled_point(const Eigen::Vector3d& bearing, const T* host, const T* camera, T w) {
  const T back[3] = {-host[0], -host[1], -host[2]};
  const T in_host[3] = {bearing.x() - w * host[3], bearing.y() - w * host[4], bearing.z() - w * host[5]};
  T in_world[3], turned[3];
  ceres::AngleAxisRotatePoint(back, in_host, in_world);
  ceres::AngleAxisRotatePoint(camera, in_world, turned);
  return {turned[0] + w * camera[3], turned[1] + w * camera[4], turned[2] + w * camera[5]};
}

struct PositionCost {
  const StereoRig& rig;
  const LandmarkVariable& landmark;
  const Observation& z;
  template <class T>
  bool operator()(const T* host, const T* camera, const T* w, T* residual) const {
    const Eigen::Matrix<T, 3, 1> x = scaled_point(landmark.bearing, host, camera, *w);
    residual[0] = (rig.fx * x[0] / x[2] + rig.cx - z.measured.x()) * z.inverse_sigma.x();
    residual[1] = (rig.fy * x[1] / x[2] + rig.cy - z.measured.y()) * z.inverse_sigma.y();
    return true;
  }
};

struct DisparityCost {
  const StereoRig& rig;
  const LandmarkVariable& landmark;
  const Observation& z;
  template <class T>
  bool operator()(const T* host, const T* camera, const T* w, T* residual) const {
    const Eigen::Matrix<T, 3, 1> x = scaled_point(landmark.bearing, host, camera, *w);
    residual[0] = (rig.disparity_per_inverse_depth() * *w / x[2] - z.measured.z()) * z.inverse_sigma.z();
    return true;
  }
};

// A host's own disparity depends on the inverse depth alone.
struct OwnDisparityCost {
  const StereoRig& rig;
  const Observation& z;
  template <class T>
  bool operator()(const T* w, T* residual) const {
    residual[0] = (rig.disparity_per_inverse_depth() * *w - z.measured.z()) * z.inverse_sigma.z();
    return true;
  }
};

void add_observation(const Problem& problem, const Observation& z, bool cauchy, std::vector<PoseBlock>& poses,
                     std::vector<double>& depths, ceres::Problem& out) {
  const LandmarkVariable& landmark = problem.landmarks[z.landmark];
  double* w = &depths[z.landmark];
  const auto loss = [&]() -> ceres::LossFunction* { return cauchy ? new ceres::CauchyLoss(3) : nullptr; };
  if (landmark.host == z.pose) {
    out.AddResidualBlock(
        new ceres::AutoDiffCostFunction<OwnDisparityCost, 1, 1>(new OwnDisparityCost{problem.rig, z}), loss(),
        w);
    return;
  }
  double *host = poses[landmark.host].data(), *camera = poses[z.pose].data();
  out.AddResidualBlock(
      new ceres::AutoDiffCostFunction<PositionCost, 2, 6, 6, 1>(new PositionCost{problem.rig, landmark, z}),
      loss(), host, camera, w);
  out.AddResidualBlock(
      new ceres::AutoDiffCostFunction<DisparityCost, 1, 6, 6, 1>(new DisparityCost{problem.rig, landmark, z}),
      loss(), host, camera, w);
}

// Ceres minimizes half of what we call the cost.
double solve_with_ceres(const Problem& problem, bool cauchy) {
  std::vector<PoseBlock> poses;
  std::vector<double> depths;
  for (const PoseVariable& pose : problem.poses) poses.push_back(block_of(pose.camera_from_world));
  for (const LandmarkVariable& landmark : problem.landmarks) depths.push_back(landmark.inverse_depth);
  ceres::Problem out;
  for (const Observation& z : problem.observations) add_observation(problem, z, cauchy, poses, depths, out);
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (problem.poses[i].fixed && out.HasParameterBlock(poses[i].data()))
      out.SetParameterBlockConstant(poses[i].data());
  ceres::Solver::Options options;
  options.max_num_iterations = 200;
  options.function_tolerance = 1e-14;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &out, &summary);
  return 2 * summary.final_cost;
}

class AgainstCeres : public testing::TestWithParam<std::tuple<bool, std::uint64_t>> {};

TEST_P(AgainstCeres, SameCostAtTheSolution) {
  const auto [cauchy, seed] = GetParam();
  SyntheticOptions world;
  world.cameras = 5, world.hosts = 3, world.points = 80, world.seed = seed;
  world.outlier_share = cauchy ? 0.05 : 0;
  Problem problem = make_synthetic_world(world).truth;
  disturb(problem, {0.02, 0.005, 0.005, seed});
  const double theirs = solve_with_ceres(problem, cauchy);
  SolverOptions options;
  options.iterations = 200, options.relative_decrease = 1e-13;
  options.loss = cauchy ? Loss::kCauchy : Loss::kNone, options.loss_scale = 3;
  const SolveSummary ours = solve(problem, options);
  EXPECT_GT(ours.initial_cost, 1.5 * ours.final_cost);
  EXPECT_NEAR(ours.final_cost / theirs, 1, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Worlds, AgainstCeres,
                         testing::Combine(testing::Bool(), testing::Values(1U, 2U, 3U, 4U)));

}  // namespace
}  // namespace spslam
