// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/base/se3.h"

#include <Eigen/SVD>
#include <cmath>

namespace spslam {
namespace {

constexpr double kSmallAngle = 1e-5;  // rad; below it the series are exact to double precision

// The left Jacobian V of SO(3): the translation of exp(rho, phi) is V(phi) rho.
Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& phi) {
  const double angle = phi.norm();
  const Eigen::Matrix3d k = cross_matrix(phi);
  if (angle < kSmallAngle) return Eigen::Matrix3d::Identity() + 0.5 * k + k * k / 6.0;
  const double a2 = angle * angle;
  return Eigen::Matrix3d::Identity() + (1 - std::cos(angle)) / a2 * k +
         (angle - std::sin(angle)) / (a2 * angle) * k * k;
}

}  // namespace

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

Eigen::Matrix3d so3_exp(const Eigen::Vector3d& phi) {
  const double angle = phi.norm();
  if (angle < kSmallAngle) {
    const Eigen::Matrix3d k = cross_matrix(phi);
    return Eigen::Matrix3d::Identity() + k + 0.5 * k * k;
  }
  return Eigen::AngleAxisd(angle, phi / angle).toRotationMatrix();
}

Eigen::Vector3d so3_log(const Eigen::Matrix3d& rotation) {
  Eigen::Quaterniond q(rotation);
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();
  if (sine < kSmallAngle) return 2.0 / q.w() * q.vec();
  return 2.0 * std::atan2(sine, q.w()) / sine * q.vec();
}

Eigen::Matrix3d rotation_between(const Eigen::Matrix3d& sum_of_b_a) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sum_of_b_a, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  return svd.matrixU() * Eigen::Vector3d(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
}

SE3 SE3::exp(const Vector6d& twist) {
  const Eigen::Vector3d phi = twist.tail<3>();
  return {so3_exp(phi), left_jacobian(phi) * twist.head<3>()};
}

Vector6d SE3::log() const {
  Vector6d twist;
  twist.tail<3>() = so3_log(rotation);
  twist.head<3>() = left_jacobian(twist.tail<3>()).partialPivLu().solve(translation);
  return twist;
}

Matrix6d SE3::adjoint() const {
  Matrix6d a = Matrix6d::Zero();
  a.topLeftCorner<3, 3>() = rotation;
  a.bottomRightCorner<3, 3>() = rotation;
  a.topRightCorner<3, 3>() = cross_matrix(translation) * rotation;
  return a;
}

Eigen::Matrix<double, 3, 4> SE3::matrix3x4() const {
  Eigen::Matrix<double, 3, 4> m;
  m << rotation, translation;
  return m;
}

}  // namespace spslam
