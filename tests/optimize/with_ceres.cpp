// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "optimize/with_ceres.h"

#include <Eigen/Geometry>
#include <stdexcept>

namespace spslam::test {
namespace {

SE3 pose_of(const double* block) {
  return {Eigen::Map<const Eigen::Quaterniond>(block).toRotationMatrix(),
          Eigen::Map<const Eigen::Vector3d>(block + 4)};
}

// exp(delta) from the left, twist (translation, rotation). Cost functions give their derivatives by delta in
// the first six columns, so the derivative of the block by delta is a selection.
class LeftPerturbation : public ceres::Manifold {
 public:
  int AmbientSize() const override { return 7; }
  int TangentSize() const override { return 6; }
  bool Plus(const double* x, const double* delta, double* out) const override {
    const SE3 pose = (SE3::exp(Eigen::Map<const Vector6d>(delta)) * pose_of(x)).normalized();
    Eigen::Map<Eigen::Quaterniond>{out} = Eigen::Quaterniond(pose.rotation);
    Eigen::Map<Eigen::Vector3d>{out + 4} = pose.translation;
    return true;
  }
  bool PlusJacobian(const double*, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>>{jacobian}.setIdentity();
    return true;
  }
  // Asked for by interfaces that nobody uses here.
  bool Minus(const double*, const double*, double*) const override { return false; }
  bool MinusJacobian(const double*, double*) const override { return false; }
};

struct Seen {
  Eigen::Vector3d x = {}, by_depth = {};  // scaled point in the camera, and its derivative
  Matrix6d adjoint = {};
  bool in_front = false;
};

Seen look(const Eigen::Vector3d& bearing, double const* const* blocks, bool with_adjoint) {
  const SE3 motion = pose_of(blocks[1]) * pose_of(blocks[0]).inverse();
  Seen seen;
  seen.by_depth = motion.translation;
  seen.x = motion.rotation * bearing + *blocks[2] * motion.translation;
  seen.in_front = seen.x.z() > 1e-6;
  if (with_adjoint) seen.adjoint = motion.adjoint();
  return seen;
}

// Derivatives of kRows residuals by host, camera and inverse depth from those by the scaled point.
template <int kRows>
void chain(const Seen& seen, double inverse_depth, const Eigen::Matrix<double, kRows, 3>& by_x,
           const Eigen::Matrix<double, kRows, 1>& by_depth_alone, double** jacobians) {
  using Wide = Eigen::Matrix<double, kRows, 7, Eigen::RowMajor>;
  Eigen::Matrix<double, kRows, 6> by_camera;
  for (int row = 0; row < kRows; ++row) {
    const Eigen::Vector3d j = by_x.row(row);
    by_camera.row(row) << inverse_depth * j.transpose(), seen.x.cross(j).transpose();
  }
  if (jacobians[0]) {
    Eigen::Map<Wide> host(jacobians[0]);
    host.template leftCols<6>().noalias() = -by_camera.lazyProduct(seen.adjoint);
    host.col(6).setZero();
  }
  if (jacobians[1]) {
    Eigen::Map<Wide> camera(jacobians[1]);
    camera.template leftCols<6>() = by_camera;
    camera.col(6).setZero();
  }
  if (jacobians[2])
    Eigen::Map<Eigen::Matrix<double, kRows, 1>>{jacobians[2]} = by_x * seen.by_depth + by_depth_alone;
}

template <int kRows>
void set_zero(double* residuals, double** jacobians) {
  std::fill_n(residuals, kRows, 0.0);
  for (int block = 0; jacobians && block < 3; ++block)
    if (jacobians[block]) std::fill_n(jacobians[block], kRows * (block < 2 ? 7 : 1), 0.0);
}

class PositionCost : public ceres::SizedCostFunction<2, 7, 7, 1> {
 public:
  PositionCost(const StereoRig& rig, const LandmarkVariable& landmark, const Observation& z)
      : rig_(rig), bearing_(landmark.bearing), z_(z) {}
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const Seen seen = look(bearing_, blocks, jacobians && jacobians[0]);
    if (!seen.in_front) return set_zero<2>(residuals, jacobians), true;
    const double iz = 1 / seen.x.z(), u = rig_.fx * seen.x.x() * iz, v = rig_.fy * seen.x.y() * iz;
    const Eigen::Vector2d sharp = z_.inverse_sigma.head<2>();
    residuals[0] = (u + rig_.cx - z_.measured.x()) * sharp.x();
    residuals[1] = (v + rig_.cy - z_.measured.y()) * sharp.y();
    if (!jacobians) return true;
    Eigen::Matrix<double, 2, 3> by_x;
    by_x << rig_.fx * iz, 0, -u * iz, 0, rig_.fy * iz, -v * iz;
    chain<2>(seen, *blocks[2], sharp.asDiagonal() * by_x, Eigen::Vector2d::Zero(), jacobians);
    return true;
  }

 private:
  const StereoRig& rig_;
  const Eigen::Vector3d& bearing_;
  const Observation& z_;
};

class DisparityCost : public ceres::SizedCostFunction<1, 7, 7, 1> {
 public:
  DisparityCost(const StereoRig& rig, const LandmarkVariable& landmark, const Observation& z)
      : fb_(rig.disparity_per_inverse_depth()), bearing_(landmark.bearing), z_(z) {}
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const Seen seen = look(bearing_, blocks, jacobians && jacobians[0]);
    if (!seen.in_front) return set_zero<1>(residuals, jacobians), true;
    const double scale = fb_ * z_.inverse_sigma.z() / seen.x.z();
    residuals[0] = scale * *blocks[2] - z_.measured.z() * z_.inverse_sigma.z();
    if (!jacobians) return true;
    const Eigen::Matrix<double, 1, 3> by_x(0, 0, -scale * *blocks[2] / seen.x.z());
    chain<1>(seen, *blocks[2], by_x, Eigen::Matrix<double, 1, 1>(scale), jacobians);
    return true;
  }

 private:
  double fb_;
  const Eigen::Vector3d& bearing_;
  const Observation& z_;
};

// factor * inverse depth - value: a host's own disparity, and a prior.
class LinearCost : public ceres::SizedCostFunction<1, 1> {
 public:
  LinearCost(double factor, double value) : factor_(factor), value_(value) {}
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    residuals[0] = factor_ * *blocks[0] - value_;
    if (jacobians && jacobians[0]) jacobians[0][0] = factor_;
    return true;
  }

 private:
  double factor_, value_;
};

std::unique_ptr<ceres::LossFunction> make_loss(Loss loss, double scale) {
  switch (loss) {
    case Loss::kHuber:
      return std::make_unique<ceres::HuberLoss>(scale);
    case Loss::kPseudoHuber:
      return std::make_unique<ceres::SoftLOneLoss>(scale);
    case Loss::kCauchy:
      return std::make_unique<ceres::CauchyLoss>(scale);
    case Loss::kNone:
      break;
  }
  return nullptr;
}

}  // namespace

CeresProblem::CeresProblem(const Problem& problem, Loss loss, double loss_scale)
    : loss_(make_loss(loss, loss_scale)), left_perturbation_(std::make_unique<LeftPerturbation>()) {
  if (!problem.disparity_offset.fixed) throw std::invalid_argument("CeresProblem: no free disparity offset");
  for (const PoseVariable& pose : problem.poses) {
    PoseBlock& block = poses_.emplace_back();
    Eigen::Map<Eigen::Quaterniond>(block.data()) = Eigen::Quaterniond(pose.camera_from_world.rotation);
    Eigen::Map<Eigen::Vector3d>(block.data() + 4) = pose.camera_from_world.translation;
  }
  for (const LandmarkVariable& landmark : problem.landmarks)
    inverse_depths_.push_back(landmark.inverse_depth);
  ceres::Problem::Options options;
  options.loss_function_ownership = options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres_ = std::make_unique<ceres::Problem>(options);
  for (const Observation& z : problem.observations) add(problem, z);
  for (std::size_t l = 0; l < problem.landmarks.size(); ++l) {
    const LandmarkVariable& landmark = problem.landmarks[l];
    const double sharp = std::sqrt(landmark.prior_information);
    if (sharp > 0)
      ceres_->AddResidualBlock(new LinearCost(sharp, sharp * landmark.prior_inverse_depth), nullptr,
                               &inverse_depths_[l]);
    if (landmark.fixed && ceres_->HasParameterBlock(&inverse_depths_[l]))
      ceres_->SetParameterBlockConstant(&inverse_depths_[l]);
  }
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    if (!ceres_->HasParameterBlock(poses_[i].data())) continue;
    ceres_->SetManifold(poses_[i].data(), left_perturbation_.get());
    if (problem.poses[i].fixed) ceres_->SetParameterBlockConstant(poses_[i].data());
  }
}

ceres::LossFunction* CeresProblem::loss_of(double weight) {
  if (weight == 1) return loss_.get();
  return scaled_losses_
      .emplace_back(std::make_unique<ceres::ScaledLoss>(loss_.get(), weight, ceres::DO_NOT_TAKE_OWNERSHIP))
      .get();
}

void CeresProblem::add(const Problem& problem, const Observation& z) {
  const LandmarkVariable& landmark = problem.landmarks[z.landmark];
  double* w = &inverse_depths_[z.landmark];
  const double sharp = z.inverse_sigma.z();
  if (landmark.host == z.pose) {
    if (sharp > 0)
      ceres_->AddResidualBlock(
          new LinearCost(problem.rig.disparity_per_inverse_depth() * sharp, z.measured.z() * sharp),
          loss_of(z.weight), w);
    return;
  }
  double *host = poses_[landmark.host].data(), *camera = poses_[z.pose].data();
  if (z.inverse_sigma.head<2>().maxCoeff() > 0)
    ceres_->AddResidualBlock(new PositionCost(problem.rig, landmark, z), loss_of(z.weight), host, camera, w);
  if (sharp > 0)
    ceres_->AddResidualBlock(new DisparityCost(problem.rig, landmark, z), loss_of(z.weight), host, camera, w);
}

ceres::Solver::Summary CeresProblem::solve(ceres::Solver::Options options) {
  auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  for (double& w : inverse_depths_)
    if (ceres_->HasParameterBlock(&w)) ordering->AddElementToGroup(&w, 0);
  for (PoseBlock& pose : poses_)
    if (ceres_->HasParameterBlock(pose.data())) ordering->AddElementToGroup(pose.data(), 1);
  options.linear_solver_ordering = ordering;
  ceres::Solver::Summary summary;
  ceres::Solve(options, ceres_.get(), &summary);
  summary.initial_cost *= 2, summary.final_cost *= 2;
  return summary;
}

void CeresProblem::write_to(Problem& problem) const {
  for (std::size_t i = 0; i < poses_.size(); ++i)
    problem.poses[i].camera_from_world = pose_of(poses_[i].data()).normalized();
  for (std::size_t l = 0; l < inverse_depths_.size(); ++l)
    problem.landmarks[l].inverse_depth = inverse_depths_[l];
}

}  // namespace spslam::test
