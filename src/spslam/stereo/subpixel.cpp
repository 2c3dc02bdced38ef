// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/stereo/subpixel.h"

#include <algorithm>
#include <cmath>

namespace spslam {
namespace {

// Offset of the minimum of the parabola through (-1, before), (0, centre), (1, after).
std::optional<double> parabola(double before, double centre, double after) {
  const double curvature = before + after - 2 * centre;
  if (!(curvature > 0)) return {};
  const double offset = 0.5 * (before - after) / curvature;
  if (std::abs(offset) > 0.5) return {};
  return offset;
}

std::optional<double> equiangular(double before, double centre, double after) {
  const double rise = std::max(before, after) - centre;
  if (!(rise > 0)) return {};
  const double offset = 0.5 * (before - after) / rise;
  if (std::abs(offset) > 0.5) return {};
  return offset;
}

}  // namespace

std::optional<SubPixel> interpolate(const FiveSamples& s, Interpolation interpolation) {
  SubPixel result;
  result.curvature = s.left + s.right - 2 * s.centre;
  if (!(result.curvature > 0)) return {};
  if (interpolation == Interpolation::kNone) return result;
  const auto along = interpolation == Interpolation::kEquiangular ? equiangular(s.left, s.centre, s.right)
                                                                  : parabola(s.left, s.centre, s.right);
  if (!along) return {};
  result.du = *along;
  if (interpolation == Interpolation::kQuadric) {
    const auto across = parabola(s.up, s.centre, s.down);
    if (!across) return {};
    result.dv = *across;
  }
  return result;
}

}  // namespace spslam
