// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The motion between two views of the same things: points of the older one (bearing, inverse depth and its
// information) and where the newer one sees them (u, v, disparity). With the short baseline of a boat most
// depths are poor, and some say nothing; so a point's depth is not taken as given but eliminated, weighed by
// its information, wherever an error is judged.
#pragma once

#include <optional>

#include "spslam/optimize/problem.h"

namespace spslam {

struct Correspondence {
  int point = 0, feature = 0;                          // of the place and of the newer keyframe
  Eigen::Vector3d bearing = Eigen::Vector3d::UnitZ();  // (x, y, 1) in the older camera
  double inverse_depth = 0, information = 0;
  Eigen::Vector3d measured = Eigen::Vector3d::Zero();       // u, v, disparity in the newer one, px
  Eigen::Vector3d inverse_sigma = Eigen::Vector3d::Zero();  // 1/px, 0 if not measured
};

// Squared error in standard deviations with the inverse depth moved to where it fits best; infinite behind
// the camera, where the best fit is clearly beyond infinity, and where one camera is so much nearer to the
// point than the other that no descriptor could have matched.
double squared_error(const StereoRig& rig, const SE3& newer_from_older, const Correspondence& c);

// The same with its position as uncertain as the way makes it that the point moved in the image against those
// at infinity: what stands out in depth does not look the same from elsewhere. `share` of that way (px) is
// added to the deviation.
Correspondence widened(const StereoRig& rig, const SE3& newer_from_older, Correspondence c, double share);

// What it says of the translation, 1/m^2, with its inverse depth eliminated: trace of the information.
double translation_information(const StereoRig& rig, const SE3& newer_from_older, const Correspondence& c);

std::vector<Correspondence> inliers_of(const StereoRig& rig, const SE3& newer_from_older,
                                       const std::vector<Correspondence>& all, double sigmas);

struct ConsensusOptions {
  int iterations = 300;
  double confidence = 0.999;
  double inlier_sigmas = 3.4;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.iterations, {"iterations", "", "samples drawn at most", 1, 100000});
    visit(self.confidence, {"confidence", "", "of having drawn a sample without a wrong match", 0.5, 1});
    visit(self.inlier_sigmas, {"inlier_sigmas", "sigma", "error of an inlier at most", 0.5, 20});
  }
};

// The motion most correspondences agree with, and they. RANSAC (Fischler and Bolles, 1981) with the scores of
// MSAC (Torr and Zisserman, 2000) and a local refinement of each new best (Chum, Matas and Kittler, 2003);
// hypotheses from three points with depths (P3P, OpenCV's) and from directions alone. The same for the same
// input.
struct Consensus {
  SE3 newer_from_older;
  std::vector<Correspondence> inliers;
};
Consensus find_consensus(const StereoRig& rig, const std::vector<Correspondence>& all,
                         const ConsensusOptions& options);

struct RefinedMotion {
  SE3 newer_from_older;
  Matrix6d covariance = Matrix6d::Identity();  // of a left perturbation, (m, rad)
  double cost_per_freedom = 0;                 // near 1 if the variances are right
};
// The least-squares motion over all correspondences given, under a robust loss; nothing if there is none.
std::optional<RefinedMotion> refine_motion(const StereoRig& rig, const std::vector<Correspondence>& inliers,
                                           const SE3& start, int iterations);

}  // namespace spslam
