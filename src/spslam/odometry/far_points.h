// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Far points are tested before they are trusted (paper 3.1.4): RANSAC finds those that agree with one
// rotation, and how often they have done so lately is their weight, equation (8).
#pragma once

#include <deque>

#include "spslam/odometry/active_map.h"
#include "spslam/odometry/options.h"

namespace spslam {

class FarPoints {
 public:
  // Drops the far sightings that RANSAC refuses and weighs the others; near ones keep weight 1. Far points
  // turn with the camera and hardly move with it: the hypotheses are corrections of the predicted rotation,
  // each from two points (Fischler and Bolles, 1981; Kabsch's rotation). Seeded by the frame, so that every
  // run draws the same.
  void weigh(const ActiveMap& map, const SE3& predicted, FrameId frame, const FarOptions& options,
             std::vector<Sighting>& sightings);

  double weight() const { return weight_; }  // w_t of the last frame

 private:
  std::deque<double> inlier_share_;
  double weight_ = 1;
};

}  // namespace spslam
