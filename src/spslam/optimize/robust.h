// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Robust losses: rho(s) of a squared, normalized residual s. Weights are rho'(s) (iteratively reweighted
// least squares).
#pragma once

#include <cmath>
#include <span>

namespace spslam {

enum class Loss { kNone, kHuber, kPseudoHuber, kCauchy };

inline std::span<const char* const> option_names(Loss) {
  static constexpr const char* names[] = {"none", "huber", "pseudo-huber", "cauchy"};
  return names;
}

struct RobustValue {
  double cost;    // rho(s), s near 0
  double weight;  // d rho / d s, 1 at 0
};

// scale: in standard deviations, where the loss leaves the parabola. Pseudo-Huber: Charbonnier et al. 1997,
// the paper's section 3.2.2; Cauchy: Hartley and Zisserman, appendix 6.8.
inline RobustValue robust(Loss loss, double scale, double s) {
  const double c2 = scale * scale;
  switch (loss) {
    case Loss::kHuber:
      if (s <= c2) return {s, 1};
      return {2 * scale * std::sqrt(s) - c2, scale / std::sqrt(s)};
    case Loss::kPseudoHuber: {
      const double root = std::sqrt(1 + s / c2);
      return {2 * c2 * (root - 1), 1 / root};
    }
    case Loss::kCauchy:
      return {c2 * std::log1p(s / c2), 1 / (1 + s / c2)};
    case Loss::kNone:
      break;
  }
  return {s, 1};
}

}  // namespace spslam
