// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/eval/umeyama.h"

#include <spdlog/fmt/fmt.h>

#include <Eigen/SVD>
#include <cmath>

namespace spslam {
namespace {

constexpr double kStill = 0.01;     // m, RMS distance from the mean position below which a run stands still
constexpr double kStraight = 0.01;  // lateral over longitudinal extent below which a run is straight

template <int D>
struct Moments {
  using Vector = Eigen::Matrix<double, D, 1>;
  Vector mean_estimate = Vector::Zero(), mean_truth = Vector::Zero();
  double variance_estimate = 0, variance_truth = 0;                              // m^2
  Eigen::Matrix<double, D, D> covariance = Eigen::Matrix<double, D, D>::Zero();  // truth by estimate, m^2
};

template <int D>
Moments<D> moments_of(std::span<const AssociatedPose> poses) {
  Moments<D> m;
  const double n = static_cast<double>(poses.size());
  for (const AssociatedPose& pose : poses) {
    m.mean_estimate += pose.estimate.translation.template head<D>() / n;
    m.mean_truth += pose.truth.translation.template head<D>() / n;
  }
  for (const AssociatedPose& pose : poses) {
    const typename Moments<D>::Vector e = pose.estimate.translation.template head<D>() - m.mean_estimate;
    const typename Moments<D>::Vector t = pose.truth.translation.template head<D>() - m.mean_truth;
    m.variance_estimate += e.squaredNorm() / n;
    m.variance_truth += t.squaredNorm() / n;
    m.covariance += t * e.transpose() / n;
  }
  return m;
}

template <int D>
std::string degeneracy(const Moments<D>& m, const Eigen::Matrix<double, D, 1>& singular_values) {
  const double spread = std::sqrt(std::min(m.variance_truth, m.variance_estimate));
  if (spread < kStill)
    return fmt::format(
        "the run stands still ({:.1f} mm RMS about its mean): neither its direction nor its scale can be "
        "determined",
        1e3 * spread);
  if (D == 3 && singular_values[1] < kStraight * kStraight * singular_values[0])
    return "the run is nearly straight: the turn about its line cannot be determined; use the planar "
           "evaluation";
  return {};
}

template <int D>
AlignResult umeyama(std::span<const AssociatedPose> poses, bool with_scale) {
  const Moments<D> m = moments_of<D>(poses);
  const Eigen::JacobiSVD<Eigen::Matrix<double, D, D>> svd(m.covariance,
                                                          Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix<double, D, 1> sign = Eigen::Matrix<double, D, 1>::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0)
    sign[D - 1] = -1;  // a mirror image is no motion
  AlignResult result;
  result.degenerate = degeneracy<D>(m, svd.singularValues());
  Similarity& s = result.truth_from_estimate;
  const Eigen::Matrix<double, D, D> rotation = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
  const double scale = svd.singularValues().dot(sign) / m.variance_estimate;
  result.has_scale = with_scale && m.variance_estimate > 0 && std::isfinite(scale) && scale > 0 &&
                     std::sqrt(std::min(m.variance_truth, m.variance_estimate)) >= kStill;
  if (result.has_scale) s.scale = scale;
  s.rotation.template topLeftCorner<D, D>() = rotation;
  s.translation.template head<D>() = m.mean_truth - s.scale * rotation * m.mean_estimate;
  return result;
}

}  // namespace

std::span<const char* const> option_names(AlignMode) {
  static constexpr const char* names[] = {"none", "se3", "sim3"};
  return names;
}

AlignResult align_positions(std::span<const AssociatedPose> poses, AlignMode mode, bool planar) {
  if (mode == AlignMode::kNone || poses.empty()) return {};
  const bool with_scale = mode == AlignMode::kSim3;
  return planar ? umeyama<2>(poses, with_scale) : umeyama<3>(poses, with_scale);
}

std::vector<AssociatedPose> aligned_poses(const Similarity& truth_from_estimate,
                                          std::span<const AssociatedPose> poses) {
  std::vector<AssociatedPose> aligned(poses.begin(), poses.end());
  for (AssociatedPose& pose : aligned) pose.estimate = truth_from_estimate * pose.estimate;
  return aligned;
}

}  // namespace spslam
