// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The minimum of a sampled cost between its samples (3.1.3 and Figure 6 of the paper).
#pragma once

#include <optional>

#include "spslam/stereo/options.h"

namespace spslam {

// The best sample and its four neighbours.
struct FiveSamples {
  double centre = 0, left = 0, right = 0, up = 0, down = 0;
};

struct SubPixel {
  double du = 0, dv = 0;  // px from the centre sample
  double curvature = 0;   // second derivative along the row, cost/px^2
};

// Nothing if the surface has no minimum within half a pixel of the centre. The five samples determine a
// quadric z = a u^2 + b v^2 + c u + d v + e (no mixed term), so its minimum is that of two parabolas;
// kParabola and kEquiangular look along the row only and leave dv = 0.
std::optional<SubPixel> interpolate(const FiveSamples& samples, Interpolation interpolation);

}  // namespace spslam
