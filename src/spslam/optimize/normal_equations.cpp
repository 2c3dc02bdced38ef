// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/optimize/normal_equations.h"

#include <tbb/parallel_for.h>

#include "spslam/optimize/pieces.h"

namespace spslam {
namespace {

// Sums over one piece of the landmarks, for each pair (host, observing pose) in coordinates of their relative
// motion, so that the adjoint that leads to the two poses is applied once a pair and not once an observation.
struct PairSums {
  Matrix6d hessian = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  Eigen::Matrix<double, 6, 4> by_offset = Eigen::Matrix<double, 6, 4>::Zero();
};

struct PieceSums {
  std::vector<PairSums> pairs;  // one a pair of the piece
  Matrix4d offset_hessian = Matrix4d::Zero();
  Vector4d offset_gradient = Vector4d::Zero();
  double cost = 0;
};

struct PairMotion {
  SE3 camera_from_host;
  Matrix6d adjoint;
};

std::vector<PairMotion> motions_of(const Problem& problem, const ProblemStructure& structure) {
  std::vector<PairMotion> motions;
  motions.reserve(structure.pairs.size());
  for (const ObservedPair& pair : structure.pairs) {
    const SE3 motion =
        problem.poses[pair.pose].camera_from_world * problem.poses[pair.host].camera_from_world.inverse();
    motions.push_back({motion, motion.adjoint()});
  }
  return motions;
}

// Robust weights of the image position and of the disparity, which fail independently of each other.
Eigen::Vector3d weigh(const Eigen::Vector3d& residual, const Observation& z, const SolverOptions& options,
                      double& cost) {
  const Eigen::Vector3d r = residual.cwiseProduct(z.inverse_sigma);
  const RobustValue position = robust(options.loss, options.loss_scale, r.head<2>().squaredNorm());
  const RobustValue disparity = robust(options.loss, options.loss_scale, r.z() * r.z());
  cost += z.weight * (position.cost + disparity.cost);
  return z.weight * z.inverse_sigma.cwiseAbs2().cwiseProduct(
                        Eigen::Vector3d(position.weight, position.weight, disparity.weight));
}

class PieceAccumulator {
 public:
  PieceAccumulator(const Problem& problem, const ProblemStructure& structure, const SolverOptions& options,
                   NormalEquations& out)
      : problem_(problem),
        structure_(structure),
        options_(options),
        motions_(motions_of(problem, structure)),
        out_(out) {}

  void add_piece(std::size_t piece, PieceSums& sums) const {
    sums.pairs.resize(structure_.pairs_of_piece[piece].size());
    const auto [first, last] = piece_of(piece, problem_.landmarks.size());
    for (std::size_t l = first; l < last; ++l) add_landmark(l, structure_.pairs_of_piece[piece], sums);
  }
  const PairMotion& motion(std::size_t pair) const { return motions_[pair]; }

 private:
  void add_landmark(std::size_t l, const std::vector<int>& pairs, PieceSums& sums) const {
    const LandmarkVariable& landmark = problem_.landmarks[l];
    const double prior_error = landmark.inverse_depth - landmark.prior_inverse_depth;
    Own own{landmark.prior_information, landmark.prior_information * prior_error};
    sums.cost += landmark.prior_information * prior_error * prior_error;
    for (std::size_t e = structure_.first_entry[l]; e < structure_.first_entry[l + 1]; ++e)
      out_.mixed[e].setZero();
    for (std::size_t i = structure_.first_observation[l]; i < structure_.first_observation[l + 1]; ++i)
      add_observation(i, pairs, own, sums);
    out_.landmark_hessian[static_cast<Eigen::Index>(l)] = landmark.fixed ? 0 : own.hessian;
    out_.landmark_gradient[static_cast<Eigen::Index>(l)] = landmark.fixed ? 0 : own.gradient;
  }

  struct Own {
    double hessian, gradient;
  };

  // As much as a point at the other end of the image: otherwise a step that throws points behind the camera
  // would look like a good one.
  double cost_behind(const Observation& z) const {
    const double r = problem_.rig.width * z.inverse_sigma.x();
    return z.weight * robust(options_.loss, options_.loss_scale, r * r).cost;
  }

  void add_observation(std::size_t i, const std::vector<int>& pairs, Own& own, PieceSums& sums) const {
    const Observation& z = problem_.observations[i];
    const LandmarkVariable& landmark = problem_.landmarks[z.landmark];
    const auto place = static_cast<std::size_t>(structure_.pair_of_observation[i]);
    const PairMotion& pair = motions_[static_cast<std::size_t>(pairs[place])];
    Linearized at =
        linearize(problem_.rig, pair.camera_from_host, landmark.bearing, landmark.inverse_depth, z.measured);
    if (!at.in_front) {
      sums.cost += cost_behind(z);
      return;
    }
    const Vector4d basis = DisparityOffset::basis(problem_.rig, z.measured.x(), z.measured.y());
    at.residual.z() += basis.dot(problem_.disparity_offset.coefficients);
    const Eigen::Vector3d w = weigh(at.residual, z, options_, sums.cost);
    const Eigen::Vector3d weighted_by_depth = w.cwiseProduct(at.by_inverse_depth);
    own.hessian += weighted_by_depth.dot(at.by_inverse_depth);
    own.gradient += weighted_by_depth.dot(at.residual);
    const bool with_offset = structure_.columns.offset >= 0;
    if (with_offset) {
      if (!landmark.fixed)
        out_.mixed[structure_.first_entry[static_cast<std::size_t>(z.landmark) + 1] - 1].head<4>() +=
            weighted_by_depth.z() * basis;
      sums.offset_hessian += w.z() * basis * basis.transpose();
      sums.offset_gradient += w.z() * at.residual.z() * basis;
    }
    if (landmark.host == z.pose) return;  // a host's own disparity says nothing of its pose
    const std::vector<int>& column = structure_.columns.of_pose;
    if (column[landmark.host] < 0 && column[z.pose] < 0) return;
    PairSums& sum = sums.pairs[place];
    const Eigen::Matrix<double, 6, 3> weighted = at.by_relative.transpose() * w.asDiagonal();
    sum.hessian.noalias() += weighted.lazyProduct(at.by_relative);
    sum.gradient.noalias() += weighted.lazyProduct(at.residual);
    if (with_offset) sum.by_offset.noalias() += weighted.col(2) * basis.transpose();
    const Vector6d cross = weighted.lazyProduct(at.by_inverse_depth);
    if (const int e = structure_.entry_of_pose[i]; e >= 0) out_.mixed[e] += cross;
    if (const int e = structure_.entry_of_host[i]; e >= 0) out_.mixed[e] -= pair.adjoint.transpose() * cross;
  }

  const Problem& problem_;
  const ProblemStructure& structure_;
  const SolverOptions& options_;
  std::vector<PairMotion> motions_;
  NormalEquations& out_;
};

// Adds to the lower half; a and b are first columns.
void add_to_hessian(int a, int b, const Matrix6d& sum, NormalEquations& out) {
  if (a >= b)
    out.pose_hessian.block(a / 6, b / 6) += sum;
  else
    out.pose_hessian.block(b / 6, a / 6) += sum.transpose();
}

void add_offset_block(const Eigen::Matrix<double, 6, 4>& block, int pose, int offset, NormalEquations& out) {
  if (pose >= 0 && offset >= 0)
    out.pose_hessian.block(offset / 6, pose / 6).topRows<4>() += block.transpose();
}

// The relative motion camera_from_host changes by delta_camera - Ad delta_host.
void add_pair(const PairSums& sum, const Matrix6d& adjoint, int host, int pose, int offset,
              NormalEquations& out) {
  add_offset_block(sum.by_offset, pose, offset, out);
  add_offset_block(-adjoint.transpose() * sum.by_offset, host, offset, out);
  if (pose >= 0) {
    add_to_hessian(pose, pose, sum.hessian, out);
    out.pose_gradient.segment<6>(pose) += sum.gradient;
  }
  if (host < 0) return;
  const Matrix6d half = sum.hessian * adjoint;
  add_to_hessian(host, host, adjoint.transpose() * half, out);
  out.pose_gradient.segment<6>(host) -= adjoint.transpose() * sum.gradient;
  if (pose >= 0) add_to_hessian(pose, host, -half, out);
}

void add_offset(const DisparityOffset& offset, int column, const std::vector<PieceSums>& sums,
                NormalEquations& out) {
  out.cost += offset.coefficients.dot(offset.prior_information * offset.coefficients);
  if (column < 0) return;
  Eigen::Map<Matrix6d> hessian = out.pose_hessian.block(column / 6, column / 6);
  hessian.topLeftCorner<4, 4>() += offset.prior_information;
  out.pose_gradient.segment<4>(column) += offset.prior_information * offset.coefficients;
  for (const PieceSums& block : sums) {
    hessian.topLeftCorner<4, 4>() += block.offset_hessian;
    out.pose_gradient.segment<4>(column) += block.offset_gradient;
  }
}

void reset(const Problem& problem, const ProblemStructure& structure, NormalEquations& out) {
  const auto landmarks = static_cast<Eigen::Index>(problem.landmarks.size());
  out.cost = 0;
  out.pose_hessian.reset(structure.envelope);
  out.pose_gradient.setZero(structure.columns.count);
  out.mixed.resize(structure.block_of_entry.size());
  out.landmark_hessian.resize(landmarks);
  out.landmark_gradient.resize(landmarks);
}

}  // namespace

void build_normal_equations(const Problem& problem, const ProblemStructure& structure,
                            const SolverOptions& options, NormalEquations& out) {
  reset(problem, structure, out);
  const PoseColumns& columns = structure.columns;
  const std::size_t pieces = structure.pairs_of_piece.size();
  std::vector<PieceSums> sums(pieces);
  const PieceAccumulator accumulator(problem, structure, options, out);
  tbb::parallel_for(std::size_t{0}, pieces,
                    [&](std::size_t piece) { accumulator.add_piece(piece, sums[piece]); });
  for (std::size_t piece = 0; piece < pieces; ++piece) {
    out.cost += sums[piece].cost;
    for (std::size_t i = 0; i < sums[piece].pairs.size(); ++i) {
      const auto pair = static_cast<std::size_t>(structure.pairs_of_piece[piece][i]);
      add_pair(sums[piece].pairs[i], accumulator.motion(pair).adjoint,
               columns.of_pose[structure.pairs[pair].host], columns.of_pose[structure.pairs[pair].pose],
               columns.offset, out);
    }
  }
  add_offset(problem.disparity_offset, columns.offset, sums, out);
}

}  // namespace spslam
