// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/stereo/pair_check.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "spslam/base/median.h"

namespace spslam {
namespace {

constexpr double kLeastSpread = 0.05;  // px: no alignment knows rows better
constexpr int kRounds = 20;

// (1, x, y), with x and y from -1 to 1 over the image.
Eigen::Vector3d regressor(double x, double y, cv::Size image) {
  return {1, 2 * x / (image.width - 1) - 1, 2 * y / (image.height - 1) - 1};
}

struct Plane {
  Eigen::Vector3d coefficients = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double spread = kLeastSpread;
};

double spread_about(std::span<const PairMatch> matches, const Eigen::Vector3d& plane, cv::Size image) {
  std::vector<double> deviations;
  deviations.reserve(matches.size());
  for (const PairMatch& m : matches)
    deviations.push_back(std::abs(m.row_offset - plane.dot(regressor(m.x, m.y, image))));
  return std::max(kLeastSpread, 1.4826 * median(std::move(deviations)));
}

// Least squares reweighted by Cauchy's loss at twice the spread, from the median on.
Plane fit_plane(std::span<const PairMatch> matches, cv::Size image, double start) {
  Plane plane;
  plane.coefficients[0] = start;
  for (int round = 0; round < kRounds; ++round) {
    plane.spread = spread_about(matches, plane.coefficients, image);
    // Slopes that nothing shows, of matches in one place, are none.
    Eigen::Matrix3d normal = Eigen::Vector3d(0, 0.1, 0.1).asDiagonal();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const PairMatch& m : matches) {
      const Eigen::Vector3d v = regressor(m.x, m.y, image);
      const double scaled = (m.row_offset - plane.coefficients.dot(v)) / (2 * plane.spread);
      const double weight = 1 / (1 + scaled * scaled);
      normal += weight * v * v.transpose();
      right += weight * m.row_offset * v;
    }
    const Eigen::LDLT<Eigen::Matrix3d> solver(normal);
    plane.coefficients = solver.solve(right);
    plane.covariance = plane.spread * plane.spread * solver.solve(Eigen::Matrix3d::Identity());
  }
  plane.spread = spread_about(matches, plane.coefficients, image);
  return plane;
}

double quantile(const std::vector<double>& sorted, double share) {
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

}  // namespace

RowOffsets measure_rows(std::span<const PairMatch> matches, cv::Size image) {
  RowOffsets rows;
  rows.middle = {0.5 * (image.width - 1), 0.5 * (image.height - 1)};
  rows.matches = static_cast<int>(matches.size());
  if (matches.empty()) return rows;
  std::vector<double> offsets;
  for (const PairMatch& m : matches) offsets.push_back(m.row_offset);
  rows.median = median(std::move(offsets));
  const Plane plane = fit_plane(matches, image, rows.median);
  rows.spread = plane.spread;
  rows.centre = plane.coefficients[0];
  rows.slope_x = plane.coefficients[1] / rows.middle.x;
  rows.slope_y = plane.coefficients[2] / rows.middle.y;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0}) {
      const Eigen::Vector3d corner(1, x, y);
      const double offset = plane.coefficients.dot(corner);
      if (std::abs(offset) < std::abs(rows.worst_corner)) continue;
      rows.worst_corner = offset;
      rows.corner_sigma = std::sqrt(corner.dot(plane.covariance * corner));
    }
  return rows;
}

std::vector<PairMatch> on_rows(std::span<const PairMatch> matches, const RowOffsets& rows) {
  const double limit = std::max(0.5, 3 * rows.spread);
  std::vector<PairMatch> kept;
  for (const PairMatch& m : matches)
    if (std::abs(m.row_offset - rows.at(m.x, m.y)) <= limit) kept.push_back(m);
  return kept;
}

DisparityStatistics measure_disparities(std::span<const PairMatch> matches) {
  DisparityStatistics result;
  result.matches = static_cast<int>(matches.size());
  if (matches.empty()) return result;
  std::vector<double> sorted;
  for (const PairMatch& m : matches) sorted.push_back(m.disparity);
  std::sort(sorted.begin(), sorted.end());
  const auto share_below = [&](double limit) {
    const auto count = std::lower_bound(sorted.begin(), sorted.end(), limit) - sorted.begin();
    return static_cast<double>(count) / static_cast<double>(sorted.size());
  };
  result.quantile_1 = quantile(sorted, 0.01);
  result.quantile_5 = quantile(sorted, 0.05);
  result.median = quantile(sorted, 0.5);
  result.quantile_95 = quantile(sorted, 0.95);
  result.negative = share_below(-kClearDisparity);
  result.positive = 1 - share_below(kClearDisparity);
  result.below_1 = share_below(1);
  result.below_3 = share_below(3);
  return result;
}

bool seem_swapped(const DisparityStatistics& disparities) {
  return disparities.negative > 0.2 && disparities.negative > 3 * disparities.positive;
}

}  // namespace spslam
