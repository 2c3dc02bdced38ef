// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The one estimation problem of the system: poses, landmarks as a bearing and an inverse depth in their host
// frame, and observations (u, v, disparity) with their own variances. The tracker solves it for one pose or a
// short window of them, local and full bundle adjustment for keyframes; they differ in what they put in
// (docs/ARCHITECTURE.md).
//
// With x = R b + w t the scaled point of bearing b and inverse depth w in the observing camera (R, t from
// host to it):
//   u = fx x/z + cx,  v = fy y/z + cy,  disparity = fx B w / z            (the paper's equations (5) and (6))
// which stays well defined for w -> 0, a direction without a depth, and for measured disparities below zero.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "spslam/base/options.h"
#include "spslam/base/se3.h"
#include "spslam/camera/stereo_rig.h"
#include "spslam/optimize/robust.h"

namespace spslam {

struct PoseVariable {
  SE3 camera_from_world;
  bool fixed = false;
};

struct LandmarkVariable {
  int host = 0;                                        // index of a pose
  Eigen::Vector3d bearing = Eigen::Vector3d::UnitZ();  // (x, y, 1) in the host camera
  double inverse_depth = 0;  // 1/m along z; near or below 0: a direction without a depth
  // What is known of the inverse depth beside the observations: a Gaussian, information 0 for nothing.
  double prior_inverse_depth = 0, prior_information = 0;  // 1/m, m^2
  bool fixed = false;
};

struct Observation {
  int landmark = 0, pose = 0;
  Eigen::Vector3d measured = Eigen::Vector3d::Zero();       // u, v, disparity, px
  Eigen::Vector3d inverse_sigma = Eigen::Vector3d::Zero();  // 1/px; 0 for a part that was not measured
  double weight = 1;                                        // w_t of equation (8) for far points, else 1
};

// What a knocked or badly rectified rig adds to its disparities (px), as a polynomial over the image, x = (u
// - cx)/fx, y = (v - cy)/fy: c0 + c1 x + c2 y + c3 x^2. A small yaw of an eye gives c0 and c3, a roll c2, a
// difference of the focal lengths c1. SPEC, last section; Kreso and Segvic, "Improving the egomotion
// estimation by correcting the calibration bias", 2015.
using Vector4d = Eigen::Matrix<double, 4, 1>;
using Matrix4d = Eigen::Matrix<double, 4, 4>;
struct DisparityOffset {
  Vector4d coefficients = Vector4d::Zero();
  Matrix4d prior_information = Matrix4d::Zero();  // 1/px^2, about 0
  bool fixed = true;

  static Vector4d basis(const StereoRig& rig, double u, double v) {
    const double x = (u - rig.cx) / rig.fx, y = (v - rig.cy) / rig.fy;
    return {1, x, y, x * x};
  }
  double at(const StereoRig& rig, double u, double v) const { return basis(rig, u, v).dot(coefficients); }
};

struct Problem {
  StereoRig rig;
  std::vector<PoseVariable> poses;
  std::vector<LandmarkVariable> landmarks;
  std::vector<Observation> observations;  // grouped by landmark, in ascending order
  DisparityOffset disparity_offset;
};

struct SolverOptions {
  int iterations = 10;
  Loss loss = Loss::kCauchy;
  double loss_scale = 3;
  double initial_damping = 1e-4;
  double relative_decrease = 1e-4;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.iterations, {"iterations", "", "Levenberg-Marquardt steps at most", 1, 200});
    visit(self.loss, {"loss", "", "robust loss: none, huber, pseudo-huber or cauchy"});
    visit(self.loss_scale,
          {"loss_scale", "sigma", "residual at which the loss leaves the parabola", 0.1, 100});
    visit(self.initial_damping, {"initial_damping", "", "Levenberg-Marquardt damping at the start", 0, 1e6});
    visit(self.relative_decrease,
          {"relative_decrease", "", "a smaller relative decrease of the cost ends it", 0, 1});
  }
};

enum class SolveStatus { kConverged, kIterationsUsedUp, kStopped, kFailed };

struct SolveSummary {
  SolveStatus status = SolveStatus::kFailed;
  int iterations = 0;
  double initial_cost = 0, final_cost = 0;
  // Inverse of the last (undamped) Hessian of the free poses with the landmarks eliminated, 6 x 6 blocks in
  // the order of the free poses; huge for one that nothing observes, empty if it could not be inverted.
  // Perturbations act from the left on camera_from_world.
  Eigen::MatrixXd covariance;
  // Information of the disparity offset with everything else eliminated, without its prior; zero if it was
  // fixed.
  Matrix4d offset_information = Matrix4d::Zero();
};

// Residual (u, v, disparity minus measured, px) and its derivatives for one observation.
struct Linearized {
  Eigen::Vector3d residual;
  Eigen::Matrix3d by_point;                 // by the scaled point x in the camera, the inverse depth held
  Eigen::Matrix<double, 3, 6> by_relative;  // by a left perturbation of camera_from_host
  Eigen::Vector3d by_inverse_depth;
  bool in_front = false;  // false: the point is behind the camera, nothing else is set
};
Linearized linearize(const StereoRig& rig, const SE3& camera_from_host, const Eigen::Vector3d& bearing,
                     double inverse_depth, const Eigen::Vector3d& measured);

// Minimizes the robust cost over the free poses and landmarks by Levenberg-Marquardt with the landmarks
// eliminated (Schur complement; Triggs et al. 2000). Poses and inverse depths of `problem` are replaced by
// the best ones found. `stop`, if given, is asked before each step and ends it with what was reached so far.
SolveSummary solve(Problem& problem, const SolverOptions& options, bool want_covariance = false,
                   const std::function<bool()>& stop = {});

// The robust cost at the present values.
double total_cost(const Problem& problem, const SolverOptions& options);

}  // namespace spslam
