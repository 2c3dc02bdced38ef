// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/optimize/pose_graph.h"

#include <Eigen/SparseCholesky>
#include <optional>

namespace spslam {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

constexpr double kSmallAngle = 1e-2;  // rad; below it the closed forms lose digits and the series do not
constexpr double kLargestGraphDamping = 1e8;
constexpr double kLeastPoseInformation = 1e-12;  // a pose without edges stays where it is

Eigen::Matrix3d inverse_left_jacobian_so3(const Eigen::Vector3d& phi) {
  const double angle = phi.norm();
  const Eigen::Matrix3d k = cross_matrix(phi);
  const double second = angle < kSmallAngle
                            ? 1.0 / 12 + angle * angle / 720
                            : 1 / (angle * angle) - (1 + std::cos(angle)) / (2 * angle * std::sin(angle));
  return Eigen::Matrix3d::Identity() - 0.5 * k + second * k * k;
}

// The mixed block of the left Jacobian (Barfoot, equation (7.86)).
Eigen::Matrix3d mixed_block(const Eigen::Vector3d& rho, const Eigen::Vector3d& phi) {
  const double a = phi.norm(), a2 = a * a;
  double c1 = 1.0 / 6 - a2 / 120, c2 = 1.0 / 24 - a2 / 720, c3 = 1.0 / 120 - a2 / 2520;
  if (a >= kSmallAngle) {
    const double sine = std::sin(a), cosine = std::cos(a);
    c1 = (a - sine) / (a2 * a);
    c2 = (a2 + 2 * cosine - 2) / (2 * a2 * a2);
    c3 = (2 * a - 3 * sine + a * cosine) / (2 * a2 * a2 * a);
  }
  const Eigen::Matrix3d p = cross_matrix(phi), r = cross_matrix(rho);
  const Eigen::Matrix3d pr = p * r, rp = r * p, prp = pr * p;
  return 0.5 * r + c1 * (pr + rp + prp) + c2 * (p * pr + rp * p - 3 * prp) + c3 * (prp * p + p * prp);
}

struct Equations {
  double cost = 0;
  std::vector<Eigen::Triplet<double>> hessian;  // lower triangle
  Eigen::VectorXd gradient;
};

// First column of each pose, -1 for a fixed one.
struct Columns {
  explicit Columns(const PoseGraph& graph) {
    for (const PoseVariable& pose : graph.poses) {
      of_pose.push_back(pose.fixed ? -1 : count);
      if (!pose.fixed) count += 6;
    }
  }
  std::vector<int> of_pose;
  int count = 0;
};

void add_block(const Matrix6d& block, int row, int column, Equations& out) {
  for (int r = 0; r < 6; ++r)
    for (int c = 0; c < 6; ++c)
      if (row + r >= column + c) out.hessian.emplace_back(row + r, column + c, block(r, c));
}

RobustValue weigh(const PoseEdge& edge, const Vector6d& residual, const SolverOptions& options) {
  const double s = residual.dot(edge.information * residual);
  return edge.robust ? robust(options.loss, options.loss_scale, s) : RobustValue{s, 1};
}

void add_edge(const PoseGraph& graph, const PoseEdge& edge, const Columns& columns,
              const SolverOptions& options, Equations& out) {
  const LinearizedEdge at =
      linearize(edge, graph.poses[edge.i].camera_from_world, graph.poses[edge.j].camera_from_world);
  const RobustValue loss = weigh(edge, at.residual, options);
  out.cost += loss.cost;
  const int ci = columns.of_pose[edge.i], cj = columns.of_pose[edge.j];
  const Matrix6d weighted = loss.weight * edge.information;
  const Matrix6d i = at.by_i.transpose() * weighted, j = at.by_j.transpose() * weighted;
  if (ci >= 0) {
    out.gradient.segment<6>(ci) += i * at.residual;
    add_block(i * at.by_i, ci, ci, out);
  }
  if (cj >= 0) {
    out.gradient.segment<6>(cj) += j * at.residual;
    add_block(j * at.by_j, cj, cj, out);
  }
  if (ci < 0 || cj < 0) return;
  if (ci > cj)
    add_block(i * at.by_j, ci, cj, out);
  else
    add_block(j * at.by_i, cj, ci, out);
}

Equations build(const PoseGraph& graph, const Columns& columns, const SolverOptions& options) {
  Equations out;
  out.gradient.setZero(columns.count);
  for (const PoseEdge& edge : graph.edges) add_edge(graph, edge, columns, options, out);
  return out;
}

bool is_sound(const PoseGraph& graph) {
  const int poses = static_cast<int>(graph.poses.size());
  for (const PoseVariable& pose : graph.poses)
    if (!pose.camera_from_world.is_finite()) return false;
  for (const PoseEdge& edge : graph.edges) {
    const bool known = edge.i >= 0 && edge.i < poses && edge.j >= 0 && edge.j < poses && edge.i != edge.j;
    if (!known || !edge.j_from_i.is_finite() || !edge.information.allFinite()) return false;
  }
  return true;
}

class Solver {
 public:
  Solver(PoseGraph& graph, const SolverOptions& options)
      : graph_(graph), options_(options), columns_(graph), damping_(options.initial_damping) {
    equations_ = build(graph_, columns_, options_);
  }

  double cost() const { return equations_.cost; }
  bool has_free_poses() const { return columns_.count > 0; }

  // One step of Levenberg-Marquardt; nothing while it is not over.
  std::optional<SolveStatus> step() {
    const Eigen::VectorXd step = find_step();
    const bool valid = step.size() > 0 && step.allFinite();
    if (valid) {
      const std::vector<PoseVariable> before = graph_.poses;
      apply(step);
      Equations trial = build(graph_, columns_, options_);
      if (trial.cost <= equations_.cost) return accept(std::move(trial));
      graph_.poses = before;
    }
    damping_ = std::max(damping_ * 10, 1e-6);
    if (damping_ <= kLargestGraphDamping) return std::nullopt;
    return valid ? SolveStatus::kConverged : SolveStatus::kFailed;
  }

 private:
  std::optional<SolveStatus> accept(Equations trial) {
    const double decrease = equations_.cost - trial.cost;
    equations_ = std::move(trial);
    damping_ = std::max(damping_ / 10, 1e-12);
    if (decrease <= options_.relative_decrease * equations_.cost) return SolveStatus::kConverged;
    return std::nullopt;
  }

  Eigen::VectorXd find_step() {
    Sparse hessian(columns_.count, columns_.count);
    hessian.setFromTriplets(equations_.hessian.begin(), equations_.hessian.end());
    for (int i = 0; i < columns_.count; ++i) {
      double& diagonal = hessian.coeffRef(i, i);
      diagonal = diagonal * (1 + damping_) + kLeastPoseInformation;
    }
    if (!analyzed_) factor_.analyzePattern(hessian);
    analyzed_ = true;
    factor_.factorize(hessian);
    if (factor_.info() != Eigen::Success || !(factor_.vectorD().minCoeff() > 0)) return {};
    return factor_.solve(-equations_.gradient);
  }

  void apply(const Eigen::VectorXd& step) {
    for (std::size_t p = 0; p < graph_.poses.size(); ++p)
      if (const int column = columns_.of_pose[p]; column >= 0) {
        SE3& pose = graph_.poses[p].camera_from_world;
        pose = (SE3::exp(step.segment<6>(column)) * pose).normalized();
      }
  }

  PoseGraph& graph_;
  const SolverOptions& options_;
  Columns columns_;
  Equations equations_;
  Eigen::SimplicialLDLT<Sparse> factor_;  // lower triangle
  bool analyzed_ = false;
  double damping_;
};

}  // namespace

Matrix6d inverse_left_jacobian(const Vector6d& xi) {
  const Eigen::Vector3d rho = xi.head<3>(), phi = xi.tail<3>();
  const Eigen::Matrix3d inverse = inverse_left_jacobian_so3(phi);
  Matrix6d out = Matrix6d::Zero();
  out.topLeftCorner<3, 3>() = out.bottomRightCorner<3, 3>() = inverse;
  out.topRightCorner<3, 3>() = -inverse * mixed_block(rho, phi) * inverse;
  return out;
}

LinearizedEdge linearize(const PoseEdge& edge, const SE3& i, const SE3& j) {
  const SE3 motion = j * i.inverse();
  LinearizedEdge out;
  out.residual = (motion * edge.j_from_i.inverse()).log();
  out.by_j = inverse_left_jacobian(out.residual);
  out.by_i = -out.by_j * motion.adjoint();
  return out;
}

SolveSummary solve(PoseGraph& graph, const SolverOptions& options, const std::function<bool()>& stop) {
  SolveSummary summary;
  if (!is_sound(graph)) return summary;
  const std::vector<PoseVariable> before = graph.poses;
  Solver solver(graph, options);
  summary.initial_cost = solver.cost();
  summary.status = solver.has_free_poses() ? SolveStatus::kIterationsUsedUp : SolveStatus::kConverged;
  while (summary.status == SolveStatus::kIterationsUsedUp && summary.iterations < options.iterations) {
    if (stop && stop()) {
      summary.status = SolveStatus::kStopped;
      break;
    }
    ++summary.iterations;
    if (const std::optional<SolveStatus> end = solver.step()) {
      summary.status = *end;
      break;
    }
  }
  summary.final_cost = solver.cost();
  if (!std::isfinite(summary.final_cost)) {
    summary.status = SolveStatus::kFailed;
    graph.poses = before;
  }
  return summary;
}

double total_cost(const PoseGraph& graph, const SolverOptions& options) {
  double cost = 0;
  for (const PoseEdge& edge : graph.edges)
    cost +=
        weigh(edge,
              linearize(edge, graph.poses[edge.i].camera_from_world, graph.poses[edge.j].camera_from_world)
                  .residual,
              options)
            .cost;
  return cost;
}

}  // namespace spslam
