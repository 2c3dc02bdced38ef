// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Is this the same place, and where in it are we? Features matched by descriptor, a motion that most of them
// agree with, more matches where that motion says they should be, and what is left judged: by number, share,
// spread over the image, and by how well the motion is known. A false yes costs the map, a false no nothing,
// so every test must be passed, and each failure says at which one and with what figures.
#pragma once

#include "spslam/loop/matching.h"
#include "spslam/loop/place.h"
#include "spslam/loop/two_view.h"

namespace spslam {

struct VerificationOptions {
  int neighbours = 4;
  MatchingOptions matching;
  ConsensusOptions consensus;
  double position_sigma = 0.8;
  double parallax_share = 0.03;
  double depth_share = 0.1;
  double disparity_bias = 0.05;
  double trimmed_share = 0.1;
  double guided_radius = 30;
  int guided_distance = 72;
  int min_matches = 15;
  int min_consensus = 20;
  int min_inliers = 30;
  double min_inlier_share = 0.5;
  double min_visible_share = 0.08;
  int min_cells = 8;
  double max_translation_sigma = 0.4;
  double max_rotation_sigma = 1;
  bool free_scale = false;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.neighbours, {"neighbours", "", "keyframes around the older one whose points help", 0, 50});
    visit.group("matching", self.matching);
    visit.group("consensus", self.consensus);
    visit(self.position_sigma, {"position_sigma", "px", "of a feature's position, on full size", 0.05, 10});
    visit(
        self.parallax_share,
        {"parallax_share", "", "more of it, over the way that the point moved against the background", 0, 1});
    visit(self.depth_share,
          {"depth_share", "", "by which inverse depths of different times may disagree", 0, 1});
    visit(self.disparity_bias, {"disparity_bias", "px", "error that all disparities may share", 0, 5});
    visit(self.trimmed_share,
          {"trimmed_share", "",
           "inliers that say most of the translation, without which it must follow just as well", 0, 0.9});
    visit(self.guided_radius,
          {"guided_radius", "px", "from where the motion puts a point to its match", 1, 100});
    visit(self.guided_distance,
          {"guided_distance", "bit", "Hamming distance of such a match at most", 1, 256});
    visit(self.min_matches, {"min_matches", "", "matches by descriptor at least", 3, 10000});
    visit(self.min_consensus, {"min_consensus", "", "that agree with one motion at least", 3, 10000});
    visit(self.min_inliers, {"min_inliers", "", "inliers in the end at least", 3, 10000});
    visit(self.min_inlier_share, {"min_inlier_share", "", "of the guided matches, at least", 0, 1});
    visit(self.min_visible_share,
          {"min_visible_share", "", "inliers' share of the points that should be in sight, at least", 0, 1});
    visit(self.min_cells,
          {"min_cells", "", "cells of 8 x 8 that the image is cut into with inliers, at least", 1, 64});
    visit(self.max_translation_sigma,
          {"max_translation_sigma", "m", "standard deviation of the translation at most", 0.001, 100});
    visit(self.max_rotation_sigma,
          {"max_rotation_sigma", "deg", "standard deviation of the rotation at most", 0.001, 90});
    visit(self.free_scale,
          {"free_scale", "", "the two sides may be of different scale; the ratio is measured"});
  }
};

// Where it ended, in order of the tests.
enum class VerificationStage {
  kNotDescribed,  // one of the two has no features
  kMatching,      // too few matches by descriptor
  kConsensus,     // no motion that enough of them agree with
  kInliers,       // too few inliers after guided matching
  kShare,         // too few of the guided matches, or of what should be in sight, are inliers
  kSpread,        // all in one corner of the image
  kUncertain,     // the motion does not follow from them, as from far points alone
  kAccepted
};

inline std::span<const char* const> option_names(VerificationStage) {
  static constexpr const char* names[] = {"not-described", "matching", "consensus", "inliers",
                                          "share",         "spread",   "uncertain", "accepted"};
  return names;
}

struct Verification {
  VerificationStage stage = VerificationStage::kNotDescribed;
  int matches = 0, consensus = 0, guided = 0, inliers = 0, visible = 0, cells = 0;
  SE3 newer_from_older;
  Matrix6d covariance = Matrix6d::Identity();  // of a left perturbation of newer_from_older, (m, rad)
  double translation_sigma = 0;                // m, along the worst direction
  double rotation_sigma = 0;                   // deg, about the worst axis
  // Lengths of the newer side times this are lengths of the older side, from the depths known from both; how
  // many there were.
  double scale = 1;
  int scaled = 0;
  std::vector<Correspondence> pairs;  // the inliers

  void set_covariance(const Matrix6d& value);  // and the two sigmas
  bool accepted() const { return stage == VerificationStage::kAccepted; }
};

// Sound for any input: what is not finite is left out. The same for the same input.
Verification verify(const Place& older, const KeyframeFeatures& newer, const StereoRig& rig,
                    const Vocabulary& vocabulary, const VerificationOptions& options);

}  // namespace spslam
