// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Every choice of the stereo stage. The defaults are what bench/disparity.cpp measured as best.
#pragma once

#include <span>

#include "spslam/alignment/patch_aligner.h"
#include "spslam/base/options.h"

namespace spslam {

enum class Interpolation {
  kNone,         // whole pixels
  kParabola,     // 1D parabola along the row
  kQuadric,      // the paper's: surface through the centre and its four neighbours
  kEquiangular,  // 1D, two straight lines of opposite slope: the true shape of SAD near its minimum
};
inline std::span<const char* const> option_names(Interpolation) {
  static constexpr const char* kNames[] = {"none", "parabola", "quadric", "equiangular"};
  return kNames;
}

// sigma^2 = floor^2 + (slope * predicted)^2, where `predicted` is what the match itself lets expect (its
// residual over its texture). Constants fitted by bench/disparity.cpp, so that error over sigma has a spread
// of about 1.
struct DisparityNoise {
  double floor = 0.1;
  double slope = 1.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.floor, {"floor", "px", "deviation of the best match", 0.001, 10});
    visit(self.slope, {"slope", "", "weight of the deviation predicted from residual and texture", 0, 100});
  }
};

struct StereoOptions {
  // coarse: descriptors along the row
  double min_disparity = -2.0;
  double max_disparity_share = 0.15;
  double row_tolerance = 2.0;
  int max_distance = 80;
  double max_distance_ratio = 0.9;
  bool left_right_check = true;
  // fine: block matching; alignment needs no better start than the keypoints (measured), so it is for doing
  // without
  bool block_matching = false;
  bool search_2d = true;
  int block_radius = 5;
  int search_radius = 4;
  int search_radius_rows = 2;
  bool match_brightness = true;
  Interpolation interpolation = Interpolation::kQuadric;
  double max_block_ratio = 2.5;
  // gradient alignment
  bool alignment = true;
  bool align_unmatched = true;
  int align_first_level = 0;
  double align_max_move = 3.0;
  double align_max_return = 0.3;
  double align_max_row_offset = 2.0;
  double align_near_disparity = 3.0;
  int align_near_radius = 5;
  AlignmentOptions align{.patch_radius = 7, .iterations = 8, .convergence = 0.02};
  DisparityNoise block_noise{0.06, 0.09};
  DisparityNoise align_noise{0.03, 1.8};

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.min_disparity, {"min_disparity", "px",
                               "least disparity; below 0, so that noise at infinity stays unbiased", -50, 0});
    visit(self.max_disparity_share,
          {"max_disparity_share", "", "largest disparity as a share of the image width", 0.01, 1});
    visit(self.row_tolerance,
          {"row_tolerance", "px", "half height of the band along the epipolar row, at level 0", 0.5, 20});
    visit(self.max_distance, {"max_distance", "bits", "largest Hamming distance of a match", 1, 256});
    visit(self.max_distance_ratio,
          {"max_distance_ratio", "",
           "best distance over the second best at another place; above it a match is ambiguous", 0.1, 1});
    visit(self.left_right_check,
          {"left_right_check", "", "the right point and block must lead back to the left one"});
    visit(self.block_matching,
          {"block_matching", "", "refine by SAD blocks; off: the keypoints' own positions"});
    visit(self.search_2d,
          {"search_2d", "", "search blocks in rows above and below too; off: along the row only"});
    visit(self.block_radius,
          {"block_radius", "px", "half width of the square block, on the keypoint's level", 2, 7});
    visit(self.search_radius,
          {"search_radius", "px", "half width of the search window, on the keypoint's level", 1, 8});
    visit(self.search_radius_rows,
          {"search_radius_rows", "px", "half height of the search window, on the keypoint's level", 1, 4});
    visit(self.match_brightness,
          {"match_brightness", "",
           "give the left block the mean and contrast of the right one before comparing"});
    visit(self.interpolation, {"interpolation", "", "how the SAD's minimum is found between pixels"});
    visit(self.max_block_ratio,
          {"max_block_ratio", "", "largest SAD as a multiple of the frame's median", 1, 1000});
    visit(self.alignment,
          {"alignment", "", "align patches by their gradients; off: block matching has the last word"});
    visit(self.align_unmatched,
          {"align_unmatched", "",
           "align points without a descriptor match too, from their neighbours' disparity"});
    visit(self.align_first_level,
          {"align_first_level", "", "level (each half the size) on which a matched point's alignment starts",
           0, 5});
    visit(self.align_max_move, {"align_max_move", "px", "farthest that alignment may move a match", 0.1, 20});
    visit(self.align_max_return,
          {"align_max_return", "px", "farthest from the left point that the way back may end", 0.01, 5});
    visit(self.align_max_row_offset,
          {"align_max_row_offset", "px", "largest row offset of an aligned point", 0.1, 10});
    visit(self.align_near_disparity,
          {"align_near_disparity", "px", "above it a point is near: a patch there shows more than one depth",
           0, 1000});
    visit(self.align_near_radius,
          {"align_near_radius", "px",
           "half width of the patch of a near point; align.patch_radius is that of the others", 2, 7});
    visit.group("align", self.align);
    visit.group("block_noise", self.block_noise);
    visit.group("align_noise", self.align_noise);
  }
};

// The paper as written: SAD over a square window, quadric surface, nothing else.
StereoOptions paper_stereo_options();
// The feature SLAM that the paper starts from: SAD along the row, one-dimensional parabola.
StereoOptions baseline_stereo_options();

}  // namespace spslam
