// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Watches the rig while it is used: a knock, heat or a hurried calibration adds an offset to all disparities,
// which near the shore, with a pixel or two of disparity, is a wrong scale. Whole windows of frames are
// solved with the offset free; what they agree on is the estimate (SPEC, last section: distant points
// calibrate the rig).
#pragma once

#include <deque>

#include "spslam/odometry/active_map.h"

namespace spslam {

struct RigOptions {
  bool estimate = true;
  int memory = 40;
  double window_scatter = 0.1;
  double max_sigma = 0.03;
  double floor = 0.1;
  double max_rotation = 5;
  double max_offset = 1;
  double warn = 0.3;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.estimate, {"estimate", "", "estimate the rig's disparity offset and correct it"});
    visit(self.memory, {"memory", "", "windows whose estimates are combined", 1, 10000});
    visit(self.window_scatter, {"window_scatter", "px",
                                "scatter of the windows' estimates assumed before there are several", 0, 10});
    visit(self.max_sigma, {"max_sigma", "px", "windows that know the offset less well are left out", 0, 10});
    visit(self.floor,
          {"floor", "px", "offset that alignment itself may cause: none smaller is believed", 0, 10});
    visit(self.max_rotation,
          {"max_rotation", "deg",
           "windows that turn more are left out: there, other errors of the calibration look alike", 0, 180});
    visit(self.max_offset,
          {"max_offset", "px",
           "windows that want more are left out: no rectified rig is so wrong, but what moves looks like it",
           0, 100});
    visit(self.warn,
          {"warn", "px", "offset from which on a warning says that the rig needs calibration", 0, 100});
  }
};

class RigMonitor {
 public:
  // Looks at the map's window and returns the offset to correct from now on.
  DisparityOffset update(const ActiveMap& map, const SolverOptions& solver, const RigOptions& options);

 private:
  std::deque<double> estimates_;  // px, one a window
  bool has_warned_ = false;
};

// Whether disparities of a frame would still be those of points in front of the camera without that offset:
// all but a few (5 %) at least zero, up to their noise. measured: px, raw.
bool leaves_points_in_front(std::vector<double> measured, double offset, double sigma);

// The mean of estimates as far as they can be believed: shrunk by what their scatter, and `floor`, leave open
// (James and Stein's factor, never negative). `scatter` counts as three earlier estimates' deviation.
double believable_mean(const std::deque<double>& estimates, double scatter, double floor);

}  // namespace spslam
