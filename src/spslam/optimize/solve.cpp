// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "spslam/optimize/normal_equations.h"
#include "spslam/optimize/problem.h"
#include "spslam/optimize/reduced_system.h"

namespace spslam {
namespace {

constexpr double kLeastInformation =
    1e-12;  // m^2; below it a landmark is not observed at all and stays where it is
constexpr double kLargestDamping = 1e8;

struct Step {
  Eigen::VectorXd poses, landmarks;
  bool valid = false;
};

Eigen::VectorXd inverse_information(const Eigen::VectorXd& hessian, double damping) {
  return (hessian.array() > kLeastInformation)
      .select(1 / (hessian.array() * (1 + damping)).max(kLeastInformation), 0.0);
}

// A pose that nothing observes has empty rows: with this information it stays where it is, and the others do
// not wait for it. False if there are no others.
bool hold_unseen(const PoseColumns& columns, double information, ReducedSystem& reduced) {
  bool any_seen = false;
  for (int block = 0; block < columns.blocks(); ++block) {
    Eigen::Map<Matrix6d> own = reduced.hessian.block(block, block);
    const Vector6d diagonal = own.diagonal();
    any_seen = any_seen || (diagonal.array() != 0).any();
    own.diagonal() = (diagonal.array() == 0).select(information, diagonal);
  }
  return any_seen;
}

Step solve_step(const NormalEquations& equations, const ProblemStructure& structure, double damping,
                ReducedSystem& reduced) {
  Step step;
  const Eigen::VectorXd inverse = inverse_information(equations.landmark_hessian, damping);
  step.landmarks = equations.landmark_gradient;
  if (structure.columns.count > 0) {
    eliminate_landmarks(equations, structure, inverse, damping, reduced);
    if (!hold_unseen(structure.columns, 1, reduced) || !reduced.hessian.factorize()) return step;
    step.poses = -reduced.gradient;
    reduced.hessian.solve(step.poses);
    for (Eigen::Index l = 0; l < step.landmarks.size(); ++l)
      for (std::size_t e = structure.first_entry[l]; e < structure.first_entry[l + 1]; ++e)
        step.landmarks[l] += equations.mixed[e].dot(step.poses.segment<6>(6 * structure.block_of_entry[e]));
  }
  step.landmarks = -inverse.cwiseProduct(step.landmarks);
  step.valid = step.poses.allFinite() && step.landmarks.allFinite();
  return step;
}

void apply(const Step& step, const PoseColumns& columns, Problem& problem) {
  for (std::size_t i = 0; i < problem.poses.size(); ++i)
    if (const int column = columns.of_pose[i]; column >= 0) {
      SE3& pose = problem.poses[i].camera_from_world;
      pose = (SE3::exp(step.poses.segment<6>(column)) * pose).normalized();
    }
  if (columns.offset >= 0) problem.disparity_offset.coefficients += step.poses.segment<4>(columns.offset);
  for (std::size_t l = 0; l < problem.landmarks.size(); ++l)
    problem.landmarks[l].inverse_depth += step.landmarks[static_cast<Eigen::Index>(l)];
}

// The values that a step changes, to go back to.
struct Values {
  explicit Values(const Problem& problem) : poses(problem.poses), offset(problem.disparity_offset) {
    for (const LandmarkVariable& landmark : problem.landmarks)
      inverse_depths.push_back(landmark.inverse_depth);
  }
  void restore(Problem& problem) const {
    problem.poses = poses;
    problem.disparity_offset = offset;
    for (std::size_t l = 0; l < inverse_depths.size(); ++l)
      problem.landmarks[l].inverse_depth = inverse_depths[l];
  }
  std::vector<PoseVariable> poses;
  DisparityOffset offset;
  std::vector<double> inverse_depths;
};

void find_uncertainty(const NormalEquations& equations, const ProblemStructure& structure,
                      const Problem& problem, SolveSummary& summary) {
  const PoseColumns& columns = structure.columns;
  if (columns.count == 0) return;
  ReducedSystem reduced;
  eliminate_landmarks(equations, structure, inverse_information(equations.landmark_hessian, 0), 0, reduced);
  if (!hold_unseen(columns, kLeastInformation, reduced)) return;
  const Eigen::LLT<Eigen::MatrixXd> factor(reduced.hessian.dense(columns.count));
  if (factor.info() != Eigen::Success) return;
  const Eigen::MatrixXd covariance = factor.solve(Eigen::MatrixXd::Identity(columns.count, columns.count));
  const int poses = columns.offset >= 0 ? columns.offset : columns.count;
  summary.covariance = covariance.topLeftCorner(poses, poses);
  if (columns.offset < 0) return;
  summary.offset_information =
      covariance.bottomRightCorner<4, 4>().inverse() - problem.disparity_offset.prior_information;
}

}  // namespace

SolveSummary solve(Problem& problem, const SolverOptions& options, bool want_covariance,
                   const std::function<bool()>& stop) {
  const ProblemStructure structure(problem);
  NormalEquations equations, trial;
  ReducedSystem reduced;
  build_normal_equations(problem, structure, options, equations);
  SolveSummary summary;
  summary.status = SolveStatus::kIterationsUsedUp;
  summary.initial_cost = summary.final_cost = equations.cost;
  double damping = options.initial_damping;
  bool any_valid = options.iterations == 0;
  while (summary.iterations < options.iterations) {
    if (stop && stop()) {
      summary.status = SolveStatus::kStopped;
      break;
    }
    ++summary.iterations;
    const Step step = solve_step(equations, structure, damping, reduced);
    const Values before(problem);
    any_valid = any_valid || step.valid;
    if (step.valid) {
      apply(step, structure.columns, problem);
      build_normal_equations(problem, structure, options, trial);
    }
    if (step.valid && trial.cost <= equations.cost) {
      const double decrease = equations.cost - trial.cost;
      std::swap(equations, trial);
      damping = std::max(damping / 10, 1e-12);
      if (decrease <= options.relative_decrease * trial.cost) {
        summary.status = SolveStatus::kConverged;
        break;
      }
    } else {
      before.restore(problem);
      damping = std::max(damping * 10, 1e-6);
      if (damping > kLargestDamping) {
        summary.status = step.valid ? SolveStatus::kConverged : SolveStatus::kFailed;
        break;
      }
    }
  }
  summary.final_cost = equations.cost;
  const bool has_failed = summary.status == SolveStatus::kIterationsUsedUp && !any_valid;
  if (has_failed || !std::isfinite(summary.final_cost)) summary.status = SolveStatus::kFailed;
  if (want_covariance) find_uncertainty(equations, structure, problem, summary);
  return summary;
}

double total_cost(const Problem& problem, const SolverOptions& options) {
  NormalEquations equations;
  build_normal_equations(problem, ProblemStructure(problem), options, equations);
  return equations.cost;
}

}  // namespace spslam
