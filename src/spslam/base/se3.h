// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Rigid motions and their Lie algebra. T_a_b maps points in frame b to frame a. Twists are (translation,
// rotation), perturbations act from the left: T <- exp(xi) T. (Sola, Deray, Atchuthan, "A micro Lie theory",
// 2018.)
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace spslam {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

// [v]x, so that cross_matrix(v) * u = v.cross(u).
Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v);

// exp and log of SO(3), rotation vectors in rad; log's angle is in [0, pi].
Eigen::Matrix3d so3_exp(const Eigen::Vector3d& rotation_vector);
Eigen::Vector3d so3_log(const Eigen::Matrix3d& rotation);

// The rotation R that brings directions a_i nearest to b_i, from the sum of b_i a_i' (Kabsch, 1976). Two
// pairs are enough.
Eigen::Matrix3d rotation_between(const Eigen::Matrix3d& sum_of_b_a);

struct SE3 {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  // m

  static SE3 exp(const Vector6d& twist);
  Vector6d log() const;
  SE3 inverse() const { return {rotation.transpose(), -(rotation.transpose() * translation)}; }
  // exp(Ad_T xi) = T exp(xi) T^-1.
  Matrix6d adjoint() const;
  Eigen::Quaterniond quaternion() const { return Eigen::Quaterniond(rotation).normalized(); }
  Eigen::Matrix<double, 3, 4> matrix3x4() const;
  // The nearest rigid motion, after many products have let the rotation drift from SO(3).
  SE3 normalized() const { return {quaternion().toRotationMatrix(), translation}; }
  bool is_finite() const { return rotation.allFinite() && translation.allFinite(); }

  friend SE3 operator*(const SE3& a, const SE3& b) {
    return {a.rotation * b.rotation, a.rotation * b.translation + a.translation};
  }
  friend Eigen::Vector3d operator*(const SE3& a, const Eigen::Vector3d& p) {
    return a.rotation * p + a.translation;
  }
};

// Distance, m, of two cameras' centres; poses are camera_from_world.
inline double distance_of_centres(const SE3& a, const SE3& b) {
  return (a.inverse().translation - b.inverse().translation).norm();
}

}  // namespace spslam
