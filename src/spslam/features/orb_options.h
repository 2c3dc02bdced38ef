// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// What can be set about ORB features (paper 3.1.1; Rublee et al., "ORB: an efficient alternative to SIFT or
// SURF", 2011).
#pragma once

#include "spslam/base/options.h"

namespace spslam {

struct OrbOptions {
  int count = 1500;
  int levels = 8;
  double scale = 1.2;
  double level_exponent = 2.0;
  int start_threshold = 20;
  int minimum_threshold = 7;
  int cell_size = 64;
  int spacing = 4;
  int border = 16;
  bool subpixel = true;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.count, {"count", "", "features wanted in one image", 1, 100000});
    visit(self.levels, {"levels", "", "levels of the image pyramid", 1, 16});
    visit(self.scale, {"scale", "", "size ratio between neighbouring levels", 1.05, 2.0});
    visit(self.level_exponent,
          {"level_exponent", "",
           "a level's share of the features falls as scale^-exponent; 2 follows the area", 0, 4});
    visit(self.start_threshold,
          {"start_threshold", "grey",
           "FAST threshold a cell begins with; it falls only where a cell stays poor", 1, 254});
    visit(self.minimum_threshold,
          {"minimum_threshold", "grey", "FAST threshold never undercut; fog leaves nearly nothing above 20",
           1, 254});
    visit(self.cell_size,
          {"cell_size", "px", "side of the cells that share a level's features, on that level", 8, 512});
    visit(self.spacing,
          {"spacing", "px", "least distance in x or y of two features of one level, on that level", 1, 64});
    visit(self.border, {"border", "px", "margin without features, on each level", 4, 64});
    visit(self.subpixel,
          {"subpixel", "", "refine corners by a parabola through the scores of their neighbours"});
  }
};

}  // namespace spslam
