// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Which features of two keyframes are of the same thing, when the motion between them is known: alike in
// their descriptors (equation (3)), unambiguous (Lowe's ratio), mutual, and on each other's epipolar line
// within what their positions are uncertain by (Sampson's distance; Hartley and Zisserman, section 11.4.3).
#pragma once

#include "spslam/camera/stereo_rig.h"
#include "spslam/map/types.h"

namespace spslam {

struct EpipolarOptions {
  int max_distance = 50;
  double ratio = 0.8;
  double keypoint_sigma = 0.8;
  double max_chi2 = 3.84;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.max_distance, {"max_distance", "bit", "Hamming distance of a match at most", 1, 256});
    visit(self.ratio, {"ratio", "", "best distance over second best along the line, at most", 0.1, 1});
    visit(self.keypoint_sigma, {"keypoint_sigma", "px",
                                "deviation of a feature's position, on its level of the pyramid", 0.05, 10});
    visit(self.max_chi2,
          {"max_chi2", "", "square of the distance from the epipolar line over its variance, at most", 0.1,
           100});
  }
};

struct EpipolarMatch {
  int first = 0, second = 0;  // features of the two keyframes
  int distance = 0;           // bit
  friend bool operator==(const EpipolarMatch&, const EpipolarMatch&) = default;
};

// Deviation of a feature's position, px on full size. level_scale: OrbOptions::scale.
double keypoint_sigma(const Keypoint& keypoint, double level_scale, const EpipolarOptions& options);

// of_first, of_second: the features that take part. Ascending by first; each feature at most once. Nothing
// if there is no motion, as there are no lines then.
std::vector<EpipolarMatch> match_along_epipolar_lines(const StereoRig& rig, const KeyframeFeatures& first,
                                                      const std::vector<int>& of_first,
                                                      const KeyframeFeatures& second,
                                                      const std::vector<int>& of_second,
                                                      const SE3& second_from_first, double level_scale,
                                                      const EpipolarOptions& options);

}  // namespace spslam
