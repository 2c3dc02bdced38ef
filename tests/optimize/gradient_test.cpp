// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The whole gradient of the normal equations against central differences of the cost, and the Hessian against
// central differences of the gradient. The equations hold half of the cost's derivatives (r'r, not r'r / 2).

#include <gtest/gtest.h>

#include "spslam/base/random.h"
#include "spslam/optimize/normal_equations.h"
#include "spslam/optimize/synthetic.h"

namespace spslam {
namespace {

struct Gradient {
  Eigen::VectorXd poses, landmarks;
};

SolverOptions with_loss(Loss loss, double scale = 3) {
  SolverOptions options;
  options.loss = loss;
  options.loss_scale = scale;
  return options;
}

// Several hosts, the second and later ones free; outliers, so that every loss leaves its parabola; landmarks
// with priors; a free disparity offset with a prior.
Problem rich_problem() {
  SyntheticOptions world;
  world.cameras = 5, world.hosts = 3, world.points = 40, world.outlier_share = 0.1;
  Problem problem = make_synthetic_world(world).truth;
  disturb(problem, {0.02, 0.003, 0.01, 7});
  Random random(8);
  for (std::size_t l = 0; l < problem.landmarks.size(); l += 2) {
    problem.landmarks[l].prior_inverse_depth = random.uniform(0, 0.3);
    problem.landmarks[l].prior_information = random.uniform(1, 1e4);
  }
  for (Observation& z : problem.observations) z.weight = random.uniform(0.1, 1);
  DisparityOffset& offset = problem.disparity_offset;
  offset.fixed = false;
  offset.coefficients << 0.1, -0.2, 0.05, 0.3;
  offset.prior_information = Vector4d(100, 50, 20, 10).asDiagonal();
  offset.prior_information(0, 1) = offset.prior_information(1, 0) = 5;
  return problem;
}

void move_pose(Problem& problem, std::size_t pose, int axis, double by) {
  const Vector6d xi = by * Vector6d::Unit(axis);
  problem.poses[pose].camera_from_world = SE3::exp(xi) * problem.poses[pose].camera_from_world;
}

// One entry a column of the pose part: how to move the problem along it.
std::vector<std::function<void(Problem&, double)>> moves(const Problem& problem) {
  std::vector<std::function<void(Problem&, double)>> all;
  for (std::size_t pose = 0; pose < problem.poses.size(); ++pose)
    for (int axis = 0; axis < 6 && !problem.poses[pose].fixed; ++axis)
      all.emplace_back([=](Problem& p, double by) { move_pose(p, pose, axis, by); });
  for (int i = 0; i < 4 && !problem.disparity_offset.fixed; ++i)
    all.emplace_back([=](Problem& p, double by) { p.disparity_offset.coefficients[i] += by; });
  return all;
}

double half_slope(const Problem& problem, const SolverOptions& options, double step,
                  const std::function<void(Problem&, double)>& move) {
  Problem plus = problem, minus = problem;
  move(plus, step), move(minus, -step);
  return (total_cost(plus, options) - total_cost(minus, options)) / (4 * step);
}

Gradient numeric_gradient(const Problem& problem, const SolverOptions& options, double step) {
  const auto all = moves(problem);
  Gradient out;
  out.poses.resize(static_cast<Eigen::Index>(all.size()));
  for (std::size_t c = 0; c < all.size(); ++c)
    out.poses[static_cast<Eigen::Index>(c)] = half_slope(problem, options, step, all[c]);
  out.landmarks.setZero(static_cast<Eigen::Index>(problem.landmarks.size()));
  for (std::size_t l = 0; l < problem.landmarks.size(); ++l)
    if (!problem.landmarks[l].fixed)
      out.landmarks[static_cast<Eigen::Index>(l)] = half_slope(
          problem, options, step, [l](Problem& p, double by) { p.landmarks[l].inverse_depth += by; });
  return out;
}

NormalEquations equations_of(const Problem& problem, const SolverOptions& options) {
  NormalEquations out;
  build_normal_equations(problem, ProblemStructure(problem), options, out);
  return out;
}

// landmarks x columns of the pose part.
Eigen::MatrixXd dense_mixed(const Problem& problem, const NormalEquations& equations) {
  const ProblemStructure structure(problem);
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(problem.landmarks.size()),
                                              6 * structure.columns.blocks());
  for (std::size_t l = 0; l < problem.landmarks.size(); ++l)
    for (std::size_t e = structure.first_entry[l]; e < structure.first_entry[l + 1]; ++e)
      out.block<1, 6>(static_cast<Eigen::Index>(l), 6 * structure.block_of_entry[e]) =
          equations.mixed[e].transpose();
  return out;
}

void expect_gradient(const Problem& problem, const SolverOptions& options, double tolerance) {
  const NormalEquations equations = equations_of(problem, options);
  const Gradient numeric = numeric_gradient(problem, options, 1e-6);
  ASSERT_EQ(equations.pose_gradient.size(), numeric.poses.size());
  for (Eigen::Index c = 0; c < numeric.poses.size(); ++c)
    EXPECT_NEAR(equations.pose_gradient[c], numeric.poses[c], tolerance * (1 + std::abs(numeric.poses[c])))
        << "column " << c;
  for (Eigen::Index l = 0; l < numeric.landmarks.size(); ++l)
    EXPECT_NEAR(equations.landmark_gradient[l], numeric.landmarks[l],
                tolerance * (1 + std::abs(numeric.landmarks[l])))
        << "landmark " << l;
}

class EveryLoss : public testing::TestWithParam<Loss> {};

TEST_P(EveryLoss, GradientIsThatOfTheCost) {
  expect_gradient(rich_problem(), with_loss(GetParam()), 2e-4);
}

TEST_P(EveryLoss, GradientWithFixedParts) {
  Problem problem = rich_problem();
  problem.poses[2].fixed = true;
  problem.disparity_offset.fixed = true;
  for (std::size_t l = 0; l < problem.landmarks.size(); l += 3) problem.landmarks[l].fixed = true;
  expect_gradient(problem, with_loss(GetParam()), 2e-4);
}

INSTANTIATE_TEST_SUITE_P(Gradient, EveryLoss,
                         testing::Values(Loss::kNone, Loss::kHuber, Loss::kPseudoHuber, Loss::kCauchy),
                         [](const auto& tested) {
                           std::string name =
                               option_names(tested.param)[static_cast<std::size_t>(tested.param)];
                           std::erase(name, '-');
                           return name;
                         });

// Where the residuals vanish, Gauss and Newton's Hessian is the true one: differences of the gradient.
TEST(Hessian, IsTheDerivativeOfTheGradientWithoutResiduals) {
  SyntheticOptions world;
  world.cameras = 4, world.hosts = 2, world.points = 30, world.noise = false;
  Problem problem = make_synthetic_world(world).truth;
  problem.disparity_offset.fixed = false;
  const SolverOptions options = with_loss(Loss::kCauchy);
  const NormalEquations at = equations_of(problem, options);
  const auto count = static_cast<int>(at.pose_gradient.size());
  const Eigen::MatrixXd pose_hessian = at.pose_hessian.dense(count), mixed = dense_mixed(problem, at);
  const auto all = moves(problem);
  const double step = 1e-6;
  for (std::size_t c = 0; c < all.size(); ++c) {
    Problem plus = problem, minus = problem;
    all[c](plus, step), all[c](minus, -step);
    const NormalEquations up = equations_of(plus, options), down = equations_of(minus, options);
    const Eigen::VectorXd poses = (up.pose_gradient - down.pose_gradient) / (2 * step),
                          landmarks = (up.landmark_gradient - down.landmark_gradient) / (2 * step);
    const auto column = static_cast<Eigen::Index>(c);
    EXPECT_LT((pose_hessian.col(column) - poses).norm(), 1e-4 * (1 + poses.norm())) << "column " << c;
    EXPECT_LT((mixed.col(column) - landmarks).norm(), 1e-4 * (1 + landmarks.norm())) << "column " << c;
  }
}

}  // namespace
}  // namespace spslam
