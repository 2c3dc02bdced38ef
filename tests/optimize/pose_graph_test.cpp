// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/optimize/pose_graph.h"

#include <gtest/gtest.h>

#include "optimize/ring.h"

namespace spslam {
namespace {

using test::make_ring;
using test::random_twist;
using test::Ring;

constexpr double kTinyStep = 1e-6;

SolverOptions exact() {
  SolverOptions options;
  options.iterations = 50, options.relative_decrease = 1e-12, options.loss = Loss::kNone;
  return options;
}

TEST(InverseLeftJacobian, IsTheDerivativeOfTheLogarithm) {
  Random random(3);
  for (const double size : {0.0, 1e-6, 5e-3, 0.0099, 0.0101, 0.3, 1.2}) {
    const Vector6d xi = size * random_twist(random, 1, 1).normalized();
    const SE3 at = SE3::exp(xi);
    const Matrix6d analytic = inverse_left_jacobian(xi);
    for (int c = 0; c < 6; ++c) {
      const Vector6d delta = kTinyStep * Vector6d::Unit(c);
      const Vector6d numeric =
          ((SE3::exp(delta) * at).log() - (SE3::exp(-delta) * at).log()) / (2 * kTinyStep);
      EXPECT_LT((numeric - analytic.col(c)).norm(), 1e-7) << "size " << size << " column " << c;
    }
  }
}

TEST(PoseGraphEdge, JacobiansAreNumericDerivatives) {
  Random random(4);
  for (int trial = 0; trial < 10; ++trial) {
    const SE3 i = SE3::exp(random_twist(random, 3, 0.8)), j = SE3::exp(random_twist(random, 3, 0.8));
    const PoseEdge edge{0, 1, SE3::exp(random_twist(random, 0.5, 0.3)) * j * i.inverse(), {}, false};
    const LinearizedEdge at = linearize(edge, i, j);
    for (int c = 0; c < 6; ++c) {
      const SE3 plus = SE3::exp(kTinyStep * Vector6d::Unit(c)),
                minus = SE3::exp(-kTinyStep * Vector6d::Unit(c));
      const Vector6d by_i =
          (linearize(edge, plus * i, j).residual - linearize(edge, minus * i, j).residual) / (2 * kTinyStep);
      const Vector6d by_j =
          (linearize(edge, i, plus * j).residual - linearize(edge, i, minus * j).residual) / (2 * kTinyStep);
      EXPECT_LT((by_i - at.by_i.col(c)).norm(), 1e-6);
      EXPECT_LT((by_j - at.by_j.col(c)).norm(), 1e-6);
    }
  }
}

TEST(PoseGraph, ExactMotionsAreSolvedExactly) {
  Ring ring = make_ring(30, 1, 1, 5);
  Random random(6);
  for (PoseEdge& edge : ring.graph.edges) edge.j_from_i = ring.truth[edge.j] * ring.truth[edge.i].inverse();
  for (std::size_t i = 0; i < ring.truth.size(); ++i)
    ring.graph.poses[i].camera_from_world =
        i == 0 ? ring.truth[0] : SE3::exp(random_twist(random, 0.5, 0.1)) * ring.truth[i];
  const SolveSummary summary = solve(ring.graph, exact());
  EXPECT_EQ(summary.status, SolveStatus::kConverged);
  EXPECT_LT(summary.final_cost, 1e-15);
  EXPECT_LT(test::worst_place(ring), 1e-6);
}

TEST(PoseGraph, ALoopEdgeBringsANoisyRingBack) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
    Ring ring = make_ring(60, 0.02, 0.01, seed);
    const double before = test::worst_place(ring);
    const SolveSummary summary = solve(ring.graph, exact());
    EXPECT_LT(summary.final_cost, 0.1 * summary.initial_cost);
    EXPECT_LT(test::worst_place(ring), 0.75 * before) << "seed " << seed << ", was " << before;
    const SE3 gap = ring.graph.edges.back().j_from_i.inverse() * ring.graph.poses[0].camera_from_world *
                    ring.graph.poses[59].camera_from_world.inverse();
    EXPECT_LT(gap.log().norm(), 0.1);
  }
}

TEST(PoseGraph, FixedPosesStay) {
  Ring ring = make_ring(20, 0.05, 0.02, 7);
  ring.graph.poses[8].fixed = true;
  const std::vector<PoseVariable> before = ring.graph.poses;
  solve(ring.graph, exact());
  for (const int i : {0, 8})
    EXPECT_EQ(ring.graph.poses[i].camera_from_world.matrix3x4(), before[i].camera_from_world.matrix3x4());
  EXPECT_NE(ring.graph.poses[5].camera_from_world.matrix3x4(), before[5].camera_from_world.matrix3x4());
}

TEST(PoseGraph, AWrongRobustEdgeDoesLittleHarm) {
  Ring ring = make_ring(40, 0.01, 0.003, 8);
  solve(ring.graph, exact());
  const double without = test::worst_place(ring);
  const Matrix6d information = ring.graph.edges[0].information;
  ring.graph.edges.push_back({5, 25, SE3{}, information, true});
  Ring quadratic = ring;
  quadratic.graph.edges.back().robust = false;
  SolverOptions options = exact();
  options.loss = Loss::kCauchy;
  solve(ring.graph, options);
  solve(quadratic.graph, options);
  EXPECT_LT(test::worst_place(ring), without + 0.1);
  EXPECT_GT(test::worst_place(quadratic), without + 1);
}

TEST(PoseGraph, SameBitsEveryTime) {
  Ring first = make_ring(50, 0.05, 0.02, 9), second = make_ring(50, 0.05, 0.02, 9);
  solve(first.graph, exact());
  solve(second.graph, exact());
  for (std::size_t i = 0; i < first.graph.poses.size(); ++i)
    EXPECT_EQ(first.graph.poses[i].camera_from_world.matrix3x4(),
              second.graph.poses[i].camera_from_world.matrix3x4());
}

TEST(PoseGraph, StopsWhenAsked) {
  Ring ring = make_ring(50, 0.05, 0.02, 10);
  int asked = 0;
  const SolveSummary summary = solve(ring.graph, exact(), [&] { return ++asked > 2; });
  EXPECT_EQ(summary.status, SolveStatus::kStopped);
  EXPECT_EQ(summary.iterations, 2);
  EXPECT_LT(summary.final_cost, summary.initial_cost);
  EXPECT_EQ(summary.final_cost, total_cost(ring.graph, exact()));
}

TEST(PoseGraph, PosesThatNothingHoldsStay) {
  Ring ring = make_ring(10, 0.05, 0.02, 11);
  ring.graph.poses.push_back({SE3::exp(Vector6d::Ones()), false});
  const SolveSummary summary = solve(ring.graph, exact());
  EXPECT_NE(summary.status, SolveStatus::kFailed);
  EXPECT_LT(summary.final_cost, summary.initial_cost);
  EXPECT_LT((ring.graph.poses.back().camera_from_world.log() - Vector6d::Ones()).norm(), 1e-9);
}

TEST(PoseGraph, AllFixedOrEmptyIsSolved) {
  PoseGraph empty;
  EXPECT_EQ(solve(empty, exact()).status, SolveStatus::kConverged);
  Ring ring = make_ring(5, 0.05, 0.02, 12);
  for (PoseVariable& pose : ring.graph.poses) pose.fixed = true;
  EXPECT_EQ(solve(ring.graph, exact()).status, SolveStatus::kConverged);
}

TEST(PoseGraph, BadEdgesFailAndChangeNothing) {
  const Ring good = make_ring(5, 0.05, 0.02, 13);
  std::vector<PoseEdge> bad(4, good.graph.edges[0]);
  bad[0].j = 5;
  bad[1].i = -1;
  bad[2].j_from_i.translation.x() = std::nan("");
  bad[3].information(2, 2) = std::numeric_limits<double>::infinity();
  for (const PoseEdge& edge : bad) {
    PoseGraph graph = good.graph;
    graph.edges.push_back(edge);
    EXPECT_EQ(solve(graph, exact()).status, SolveStatus::kFailed);
    EXPECT_EQ(graph.poses[3].camera_from_world.matrix3x4(),
              good.graph.poses[3].camera_from_world.matrix3x4());
  }
}

}  // namespace
}  // namespace spslam
