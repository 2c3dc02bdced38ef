// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Where a patch of one image lies in another, to a small part of a pixel: Lucas and Kanade's alignment in its
// inverse compositional form (Baker and Matthews, "Lucas-Kanade 20 Years On", 2004), with the template warped
// by the predicted motion and a gain and an offset of brightness solved for at every step. SPEC, last
// section: identity from ORB, position from the patch.
#pragma once

#include <Eigen/Core>

#include "spslam/alignment/pyramid.h"
#include "spslam/base/options.h"

namespace spslam {

struct AlignmentOptions {
  int patch_radius = 6;
  int levels = 4;
  int iterations = 12;
  double convergence = 0.01;
  double min_contrast = 2.0;
  double min_correlation = 0.87;
  double noise_factor = 1.5;
  double noise = 2.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.patch_radius, {"patch_radius", "px", "half width of the square patch", 2, 7});
    visit(self.levels, {"levels", "", "pyramid levels, each half the size of the one below", 1, 6});
    visit(self.iterations, {"iterations", "", "steps at most on each level", 1, 100});
    visit(self.convergence, {"convergence", "px", "a shorter step ends a level", 1e-4, 1});
    visit(self.min_contrast,
          {"min_contrast", "grey values", "standard deviation that a patch must have", 0, 100});
    visit(self.min_correlation,
          {"min_correlation", "", "normalized correlation below which a match is refused", -1, 1});
    visit(self.noise_factor,
          {"noise_factor", "",
           "times the image's own noise, which two views of a patch need not share; 0: off", 0, 10});
    visit(self.noise,
          {"noise", "grey values", "image noise at least assumed for the variance of a position", 0.1, 50});
  }
};

enum class AlignmentStatus : std::uint8_t {
  kOk,
  kOutside,     // the patch left the image
  kFlat,        // too little contrast, or contrast in one direction only
  kDifferent,   // what was found does not look like the template
  kUnconverged  // the steps did not become small
};

struct Alignment {
  AlignmentStatus status = AlignmentStatus::kOutside;
  Eigen::Vector2f position = Eigen::Vector2f::Zero();        // px in the target image, full size
  Eigen::Matrix2f covariance = Eigen::Matrix2f::Identity();  // px^2, from the noise of the images alone
  float correlation = 0;                                     // normalized, of template and patch found

  bool ok() const { return status == AlignmentStatus::kOk; }
};

// Aligns the patch around `point` of `from` with `to`, from the coarsest useful level down to full size.
// point, start: px of the full-size images. to_from_warp: what the predicted motion does to small offsets
// around the point (identity where only the position changes). first_level: the level to start on; -1 for the
// coarsest.
Alignment align_patch(const AlignmentPyramid& from, const Eigen::Vector2f& point, const AlignmentPyramid& to,
                      const Eigen::Vector2f& start, const Eigen::Matrix2f& to_from_warp,
                      const AlignmentOptions& options, int first_level = -1);

}  // namespace spslam
