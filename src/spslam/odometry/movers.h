// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Which landmarks move by themselves. Another boat is near and full of corners, and from one frame to the
// next its points agree with the shore to within their noise; over a window they do not. So each landmark's
// track is fitted twice, as a point that stands still and as one with a constant velocity of its own, and
// where the second explains it better by more than chance it moves. (A likelihood ratio test of two nested
// models.) The poses are taken as the window has them: most of what it was solved from must stand still.
#pragma once

#include <optional>
#include <vector>

#include "spslam/odometry/active_map.h"

namespace spslam {

struct MoverOptions {
  bool enabled = true;
  int interval = 3;
  int min_sightings = 6;
  double max_gain = 16.3;
  double warp = 0.01;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.enabled, {"enabled", "", "let landmarks go that move by themselves, as those of boats do"});
    visit(self.interval, {"interval", "", "frames from one look to the next", 1, 1000});
    visit(self.min_sightings, {"min_sightings", "",
                               "in the window without which nothing is said of a landmark; more than "
                               "window_frames + 1 switches it off",
                               4, 50});
    visit(self.max_gain,
          {"max_gain", "",
           "chi-square that a velocity of its own may take off a standing landmark's sightings "
           "(16.3: one in a thousand takes more by chance)",
           1, 1e6});
    visit(self.warp,
          {"warp", "",
           "error of an aligned position, as a share of the way that parallax has moved it: patches "
           "are flat and face the camera, the world does not",
           0, 1});
  }
};

// Chi-square, three degrees of freedom, by which a constant velocity explains the landmark's sightings in the
// window better than standing still does. Nothing for landmarks that the newest frame did not see, or that
// were seen too seldom, or without disparities.
std::optional<double> gain_of_moving(const ActiveMap& map, LandmarkId landmark, const MoverOptions& options);

// Indices into map.landmarks of those that move, ascending.
std::vector<int> find_movers(const ActiveMap& map, const MoverOptions& options);

}  // namespace spslam
