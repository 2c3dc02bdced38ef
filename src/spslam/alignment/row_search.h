// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Where along its row a patch lies in the other eye, to a pixel: the start that sub-pixel alignment needs.
#pragma once

#include <optional>

#include "spslam/alignment/patch_aligner.h"

namespace spslam {

struct RowSearchOptions {
  int level = 1;
  int rows = 1;
  double min_disparity = -4;
  double max_disparity = 160;
  double min_correlation = 0.7;
  double uniqueness = 0.05;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.level, {"level", "", "pyramid level (each half the size) that is searched", 0, 4});
    visit(self.rows, {"rows", "px", "rows above and below that are searched too, on that level", 0, 4});
    visit(self.min_disparity,
          {"min_disparity", "px", "smallest disparity; below zero, since noise and rigs are", -32, 0});
    visit(self.max_disparity, {"max_disparity", "px", "largest disparity", 8, 512});
    visit(self.min_correlation,
          {"min_correlation", "", "normalized correlation that the best place must have", -1, 1});
    visit(self.uniqueness, {"uniqueness", "", "by how much it must exceed that of any other place", 0, 1});
  }
};

// Disparity (px, full size) of the best place in `right` for the patch of `left` around `point`, or nothing
// if no place is good or two are equally good.
std::optional<float> search_row(const AlignmentPyramid& left, const Eigen::Vector2f& point,
                                const AlignmentPyramid& right, int patch_radius,
                                const RowSearchOptions& options);

}  // namespace spslam
