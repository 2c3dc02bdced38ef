// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The same pose graphs solved by Ceres, with numeric derivatives, must end at the same cost.

#include <ceres/ceres.h>
#include <gtest/gtest.h>

#include "optimize/ring.h"

namespace spslam {
namespace {

using PoseBlock = std::array<double, 6>;  // log of camera_from_world

struct EdgeCost {
  const PoseEdge& edge;
  Matrix6d root;  // information = root' root

  bool operator()(const double* i, const double* j, double* residual) const {
    const SE3 motion =
        SE3::exp(Eigen::Map<const Vector6d>(j)) * SE3::exp(Eigen::Map<const Vector6d>(i)).inverse();
    Eigen::Map<Vector6d>{residual} = root * (motion * edge.j_from_i.inverse()).log();
    return true;
  }
};

double solve_with_ceres(const PoseGraph& graph) {
  std::vector<PoseBlock> poses(graph.poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i)
    Eigen::Map<Vector6d>(poses[i].data()) = graph.poses[i].camera_from_world.log();
  ceres::Problem out;
  for (const PoseEdge& edge : graph.edges) {
    const Matrix6d root = Eigen::LLT<Matrix6d>(edge.information).matrixU();
    out.AddResidualBlock(
        new ceres::NumericDiffCostFunction<EdgeCost, ceres::CENTRAL, 6, 6, 6>(new EdgeCost{edge, root}),
        nullptr, poses[edge.i].data(), poses[edge.j].data());
  }
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (graph.poses[i].fixed) out.SetParameterBlockConstant(poses[i].data());
  ceres::Solver::Options options;
  options.max_num_iterations = 200;
  options.function_tolerance = 1e-14;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &out, &summary);
  return 2 * summary.final_cost;
}

TEST(PoseGraphAgainstCeres, SameCostAtTheSolution) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    test::Ring ring = test::make_ring(24, 0.03, 0.01, seed);
    ring.graph.edges.push_back(
        {3, 9, ring.truth[9] * ring.truth[3].inverse(), ring.graph.edges[0].information * 0.1, false});
    const double theirs = solve_with_ceres(ring.graph);
    SolverOptions options;
    options.iterations = 100, options.relative_decrease = 1e-13;
    EXPECT_NEAR(solve(ring.graph, options).final_cost / theirs, 1, 1e-6);
  }
}

}  // namespace
}  // namespace spslam
