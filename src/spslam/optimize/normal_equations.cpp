// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/optimize/normal_equations.h"

#include <tbb/parallel_for.h>

namespace spslam {
namespace {

constexpr std::size_t kBlock = 128;  // landmarks

// Sums over one block of landmarks, for each pair (host, observing pose) in coordinates of their relative
// motion, so that the adjoint that leads to the two poses is applied once a pair and not once an observation.
struct PairSums {
  Matrix6d hessian = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  Eigen::Matrix<double, 6, 4> by_offset = Eigen::Matrix<double, 6, 4>::Zero();
};

struct BlockSums {
  std::vector<PairSums> pairs;  // one a pair of the table
  Matrix4d offset_hessian = Matrix4d::Zero();
  Vector4d offset_gradient = Vector4d::Zero();
  double cost = 0;
};

struct Pair {
  int host, pose;
  SE3 camera_from_host;
  Matrix6d adjoint;
};

// The pairs that are observed, and each observation's place among them.
struct PairTable {
  std::vector<Pair> pairs;
  std::vector<int> of_observation;

  explicit PairTable(const Problem& problem) {
    const std::size_t poses = problem.poses.size();
    std::vector<int> index(poses * poses, -1);
    of_observation.reserve(problem.observations.size());
    for (const Observation& z : problem.observations) {
      const int host = problem.landmarks[z.landmark].host;
      int& at = index[static_cast<std::size_t>(host) * poses + static_cast<std::size_t>(z.pose)];
      if (at < 0) {
        at = static_cast<int>(pairs.size());
        const SE3 motion =
            problem.poses[z.pose].camera_from_world * problem.poses[host].camera_from_world.inverse();
        pairs.push_back({host, z.pose, motion, motion.adjoint()});
      }
      of_observation.push_back(at);
    }
  }
};

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

class BlockAccumulator {
 public:
  BlockAccumulator(const Problem& problem, const PoseColumns& columns, const SolverOptions& options,
                   const PairTable& table, NormalEquations& out)
      : problem_(problem), columns_(columns), options_(options), table_(table), out_(out) {}

  // Observations [first, last) of landmark l.
  void add_landmark(int l, std::size_t first, std::size_t last, BlockSums& sums) const {
    const LandmarkVariable& landmark = problem_.landmarks[l];
    const double prior_error = landmark.inverse_depth - landmark.prior_inverse_depth;
    double hessian = landmark.prior_information, gradient = landmark.prior_information * prior_error;
    sums.cost += landmark.prior_information * prior_error * prior_error;
    auto mixed = out_.mixed.row(l);
    mixed.setZero();
    for (std::size_t i = first; i < last; ++i) add_observation(i, landmark, mixed, hessian, gradient, sums);
    if (landmark.fixed) mixed.setZero();
    out_.landmark_hessian[l] = landmark.fixed ? 0 : hessian;
    out_.landmark_gradient[l] = landmark.fixed ? 0 : gradient;
  }

 private:
  template <class Row>
  void add_observation(std::size_t i, const LandmarkVariable& landmark, Row& mixed, double& hessian,
                       double& gradient, BlockSums& sums) const {
    const Observation& z = problem_.observations[i];
    const Pair& pair = table_.pairs[table_.of_observation[i]];
    Linearized at =
        linearize(problem_.rig, pair.camera_from_host, landmark.bearing, landmark.inverse_depth, z.measured);
    if (!at.in_front) return;
    const Vector4d basis = DisparityOffset::basis(problem_.rig, z.measured.x(), z.measured.y());
    at.residual.z() += basis.dot(problem_.disparity_offset.coefficients);
    const Eigen::Vector3d w = weigh(at.residual, z, options_, sums.cost);
    const Eigen::Vector3d weighted_by_depth = w.cwiseProduct(at.by_inverse_depth);
    hessian += weighted_by_depth.dot(at.by_inverse_depth);
    gradient += weighted_by_depth.dot(at.residual);
    if (columns_.offset >= 0) {
      mixed.template segment<4>(columns_.offset) += weighted_by_depth.z() * basis.transpose();
      sums.offset_hessian += w.z() * basis * basis.transpose();
      sums.offset_gradient += w.z() * at.residual.z() * basis;
    }
    if (landmark.host == z.pose) return;  // a host's own disparity says nothing of its pose
    const int host_column = columns_.of_pose[landmark.host], pose_column = columns_.of_pose[z.pose];
    if (host_column < 0 && pose_column < 0) return;
    PairSums& sum = sums.pairs[table_.of_observation[i]];
    const Eigen::Matrix<double, 6, 3> weighted = at.by_relative.transpose() * w.asDiagonal();
    sum.hessian.noalias() += weighted.lazyProduct(at.by_relative);
    sum.gradient.noalias() += weighted.lazyProduct(at.residual);
    if (columns_.offset >= 0) sum.by_offset.noalias() += weighted.col(2) * basis.transpose();
    const Vector6d cross = weighted.lazyProduct(at.by_inverse_depth);
    if (pose_column >= 0) mixed.template segment<6>(pose_column) += cross.transpose();
    if (host_column >= 0)
      mixed.template segment<6>(host_column) -= (pair.adjoint.transpose() * cross).transpose();
  }

  const Problem& problem_;
  const PoseColumns& columns_;
  const SolverOptions& options_;
  const PairTable& table_;
  NormalEquations& out_;
};

void add_offset_block(const Eigen::Matrix<double, 6, 4>& block, int pose, int offset, NormalEquations& out) {
  if (pose < 0 || offset < 0) return;
  out.pose_hessian.block<6, 4>(pose, offset) += block;
  out.pose_hessian.block<4, 6>(offset, pose) += block.transpose();
}

// The relative motion camera_from_host changes by delta_camera - Ad delta_host.
void add_pair(const PairSums& sum, const Matrix6d& adjoint, int host, int pose, int offset,
              NormalEquations& out) {
  add_offset_block(sum.by_offset, pose, offset, out);
  add_offset_block(-adjoint.transpose() * sum.by_offset, host, offset, out);
  if (pose >= 0) {
    out.pose_hessian.block<6, 6>(pose, pose) += sum.hessian;
    out.pose_gradient.segment<6>(pose) += sum.gradient;
  }
  if (host < 0) return;
  const Matrix6d half = sum.hessian * adjoint;
  out.pose_hessian.block<6, 6>(host, host) += adjoint.transpose() * half;
  out.pose_gradient.segment<6>(host) -= adjoint.transpose() * sum.gradient;
  if (pose < 0) return;
  out.pose_hessian.block<6, 6>(pose, host) -= half;
  out.pose_hessian.block<6, 6>(host, pose) -= half.transpose();
}

void add_pose_prior(const PosePrior& prior, const Problem& problem, const PoseColumns& columns,
                    NormalEquations& out) {
  const Vector6d r = (problem.poses[prior.pose].camera_from_world * prior.camera_from_world.inverse()).log();
  out.cost += r.dot(prior.information * r);
  const int column = columns.of_pose[prior.pose];
  if (column < 0) return;
  out.pose_hessian.block<6, 6>(column, column) += prior.information;
  out.pose_gradient.segment<6>(column) += prior.information * r;
}

void add_motion_prior(const MotionPrior& prior, const Problem& problem, const PoseColumns& columns,
                      NormalEquations& out) {
  const std::array<int, 3> poses = {prior.first, prior.second, prior.third};
  const LinearizedMotion at =
      linearize(prior, problem.poses[poses[0]].camera_from_world, problem.poses[poses[1]].camera_from_world,
                problem.poses[poses[2]].camera_from_world);
  out.cost += at.residual.dot(prior.information * at.residual);
  for (int a = 0; a < 3; ++a) {
    const int row = columns.of_pose[poses[a]];
    if (row < 0) continue;
    const Matrix6d weighted = at.by_pose[a].transpose() * prior.information;
    out.pose_gradient.segment<6>(row) += weighted * at.residual;
    for (int b = 0; b < 3; ++b)
      if (const int column = columns.of_pose[poses[b]]; column >= 0)
        out.pose_hessian.block<6, 6>(row, column) += weighted * at.by_pose[b];
  }
}

void add_offset(const DisparityOffset& offset, int column, const std::vector<BlockSums>& sums,
                NormalEquations& out) {
  const Vector4d error = offset.coefficients - offset.prior_mean;
  out.cost += error.dot(offset.prior_information * error);
  if (column < 0) return;
  out.pose_hessian.block<4, 4>(column, column) += offset.prior_information;
  out.pose_gradient.segment<4>(column) += offset.prior_information * error;
  for (const BlockSums& block : sums) {
    out.pose_hessian.block<4, 4>(column, column) += block.offset_hessian;
    out.pose_gradient.segment<4>(column) += block.offset_gradient;
  }
}

// Where each landmark's observations begin.
std::vector<std::size_t> first_observations(const Problem& problem) {
  std::vector<std::size_t> first(problem.landmarks.size() + 1, 0);
  for (const Observation& z : problem.observations) ++first[static_cast<std::size_t>(z.landmark) + 1];
  for (std::size_t l = 1; l < first.size(); ++l) first[l] += first[l - 1];
  return first;
}

void reset(const Problem& problem, const PoseColumns& columns, NormalEquations& out) {
  const auto landmarks = static_cast<Eigen::Index>(problem.landmarks.size());
  out.cost = 0;
  out.pose_hessian.setZero(columns.count, columns.count);
  out.pose_gradient.setZero(columns.count);
  out.mixed.resize(landmarks, columns.count);
  out.landmark_hessian.resize(landmarks);
  out.landmark_gradient.resize(landmarks);
}

}  // namespace

PoseColumns::PoseColumns(const Problem& problem) {
  for (const PoseVariable& pose : problem.poses) {
    of_pose.push_back(pose.fixed ? -1 : count);
    if (!pose.fixed) count += 6;
  }
  if (!problem.disparity_offset.fixed) offset = count, count += 4;
}

void build_normal_equations(const Problem& problem, const PoseColumns& columns, const SolverOptions& options,
                            NormalEquations& out) {
  reset(problem, columns, out);
  const PairTable table(problem);
  const std::vector<std::size_t> first = first_observations(problem);
  const std::size_t landmarks = problem.landmarks.size(), blocks = (landmarks + kBlock - 1) / kBlock;
  std::vector<BlockSums> sums(blocks);
  const BlockAccumulator accumulator(problem, columns, options, table, out);
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
    sums[b].pairs.resize(table.pairs.size());
    for (std::size_t l = b * kBlock; l < std::min((b + 1) * kBlock, landmarks); ++l)
      accumulator.add_landmark(static_cast<int>(l), first[l], first[l + 1], sums[b]);
  });
  for (const BlockSums& block : sums) {
    out.cost += block.cost;
    for (std::size_t pair = 0; pair < block.pairs.size(); ++pair)
      add_pair(block.pairs[pair], table.pairs[pair].adjoint, columns.of_pose[table.pairs[pair].host],
               columns.of_pose[table.pairs[pair].pose], columns.offset, out);
  }
  add_offset(problem.disparity_offset, columns.offset, sums, out);
  for (const PosePrior& prior : problem.pose_priors) add_pose_prior(prior, problem, columns, out);
  for (const MotionPrior& prior : problem.motion_priors) add_motion_prior(prior, problem, columns, out);
}

}  // namespace spslam
