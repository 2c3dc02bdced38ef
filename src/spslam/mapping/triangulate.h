// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Landmarks between covisible keyframes: features that stereo made no landmark of, found again along their
// epipolar lines (3.2.1; Hartley and Zisserman, chapters 11 and 12).
#pragma once

#include <span>

#include "spslam/mapping/epipolar.h"
#include "spslam/mapping/patch_sighting.h"
#include "spslam/mapping/retriangulate.h"

namespace spslam {

struct TriangulationOptions {
  bool enabled = false;
  int keyframes = 5;
  int least_shared = 15;
  double spacing = 6;
  EpipolarOptions matching;
  bool align = true;
  AlignmentOptions alignment;
  double position_sigma = 0.35;
  double max_relative_sigma = 0.1;
  double max_chi2 = 5.99;
  double motion_sigma = 0.2;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.enabled, {"enabled", "", "triangulate features without a landmark between keyframes (3.2.1)"});
    visit(self.keyframes,
          {"keyframes", "", "covisible keyframes that a new one is matched with at most", 1, 50});
    visit(self.least_shared, {"least_shared", "", "landmarks that they must share with it", 1, 1000});
    visit(self.spacing,
          {"spacing", "px", "a feature nearer to a landmark's sighting than this belongs to it", 0, 50});
    visit.group("matching", self.matching);
    visit(self.align, {"align", "", "align the host's patch while both images are there"});
    visit.group("alignment", self.alignment);
    visit(self.position_sigma, {"position_sigma", "px", "deviation of an aligned position", 0.01, 10});
    visit(
        self.max_relative_sigma,
        {"max_relative_sigma", "",
         "deviation of the inverse depth over its value, above which there is too little parallax", 1e-3, 1});
    visit(self.max_chi2,
          {"max_chi2", "", "squared reprojection error over its variance in each view, at most (95 %: 5.99)",
           0.1, 100});
    visit(self.motion_sigma,
          {"motion_sigma", "", "relative error of the way between the keyframes, which the depth has from it",
           0, 1});
  }
};

// A view of a point from another camera than its host's: u, v, disparity in px, and the inverses of their
// deviations, 0 if not measured.
struct DepthView {
  SE3 camera_from_host;
  Eigen::Vector3d measured = Eigen::Vector3d::Zero();
  Eigen::Vector3d inverse_sigma = Eigen::Vector3d::Zero();
};

// The inverse depth (1/m) of a bearing (x, y, 1) that fits all views best by least squares, with its
// information (m^2): linear first, then by Gauss and Newton on the reprojection errors. Nothing if it is not
// determined, not finite, or behind one of the cameras.
std::optional<Triangulated> triangulate(const StereoRig& rig, const Eigen::Vector3d& bearing,
                                        std::span<const DepthView> views);

// Landmarks for the features of `newest` and of its covisible keyframes that belong to none; their number.
// Each is hosted by an older keyframe and has a sighting in every keyframe where it was matched. `next` is
// the id of the first one and is left at the first free one.
int add_landmarks_between(Map& map, const StereoRig& rig, KeyframeId newest, double level_scale,
                          const TriangulationOptions& options, LandmarkId& next);

}  // namespace spslam
