// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/odometry/rig_monitor.h"

#include "spslam/base/log.h"
#include "spslam/base/median.h"
#include "spslam/odometry/frame_problem.h"

namespace spslam {
namespace {

constexpr double kOnlyConstant =
    1e8;  // 1/px^2; holds the other coefficients at zero: they are not told apart from depth

std::vector<double> disparities_of(const WindowFrame& frame) {
  std::vector<double> out;
  for (const Sighting& s : frame.sightings)
    if (s.inverse_sigma.z() > 0) out.push_back(s.measured.z());
  return out;
}

}  // namespace

bool leaves_points_in_front(std::vector<double> measured, double offset, double sigma) {
  if (measured.empty()) return true;
  const auto low = measured.begin() + static_cast<std::ptrdiff_t>(measured.size() / 20);
  std::nth_element(measured.begin(), low, measured.end());
  return *low - offset > -3 * sigma;
}

double believable_mean(const std::deque<double>& estimates, double scatter, double floor) {
  if (estimates.empty()) return 0;
  const double centre = median({estimates.begin(), estimates.end()});
  double squares = 3 * scatter * scatter;
  for (const double estimate : estimates) squares += (estimate - centre) * (estimate - centre);
  const auto count = static_cast<double>(estimates.size());
  const double variance = squares / (count + 2) / count + floor * floor;
  return centre == 0 ? 0 : centre * std::max(0.0, 1 - variance / (centre * centre));
}

DisparityOffset RigMonitor::update(const ActiveMap& map, const SolverOptions& solver,
                                   const RigOptions& options) {
  // In a turn other errors of the calibration, of the focal length say, look like an offset.
  const Eigen::Matrix3d turn = map.window.back().camera_from_world.rotation *
                               map.window.front().camera_from_world.rotation.transpose();
  if (so3_log(turn).norm() * 180 / M_PI > options.max_rotation) return map.disparity_offset;
  DisparityOffset offset;
  offset.coefficients = map.disparity_offset.coefficients;
  offset.prior_information.diagonal() << 1e-6, kOnlyConstant, kOnlyConstant, kOnlyConstant;
  offset.fixed = false;
  // Offset and scale of the depths are nearly one direction: the solver must go all the way.
  SolverOptions patient = solver;
  patient.iterations = 50;
  patient.relative_decrease = 1e-7;
  const SolveSummary summary = solve_for_offset(map, patient, offset);
  const double information = summary.offset_information(0, 0);
  // Boats that move alike pull at depth and motion as an offset would.
  const bool is_possible = std::abs(offset.coefficients[0]) <= options.max_offset &&
                           leaves_points_in_front(disparities_of(map.window.back()), offset.coefficients[0],
                                                  options.window_scatter);
  if (summary.status != SolveStatus::kFailed && is_possible &&
      information * options.max_sigma * options.max_sigma > 1) {
    estimates_.push_back(offset.coefficients[0]);
    if (static_cast<int>(estimates_.size()) > options.memory) estimates_.pop_front();
  }
  DisparityOffset believed;
  believed.coefficients[0] = believable_mean(estimates_, options.window_scatter, options.floor);
  spdlog::debug("disparity offset of this window {:.3f} px, believed {:.3f} px", offset.coefficients[0],
                believed.coefficients[0]);
  if (!has_warned_ && std::abs(believed.coefficients[0]) > options.warn) {
    spdlog::warn(
        "the rig adds {:.2f} px to its disparities: it is being corrected, but the rig should be calibrated "
        "anew",
        believed.coefficients[0]);
    has_warned_ = true;
  }
  return believed;
}

}  // namespace spslam
