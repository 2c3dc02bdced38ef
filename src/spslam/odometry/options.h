// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// What can be set about the odometry. Figures behind the defaults: docs/ALGORITHM.md.
#pragma once

#include "spslam/alignment/patch_aligner.h"
#include "spslam/alignment/row_search.h"
#include "spslam/features/orb_options.h"
#include "spslam/odometry/movers.h"
#include "spslam/odometry/rig_monitor.h"
#include "spslam/odometry/trial.h"
#include "spslam/optimize/problem.h"
#include "spslam/segmentation/options.h"
#include "spslam/stereo/options.h"

namespace spslam {

// How a landmark is found again in a new frame: by its patch alone, or by its descriptor among the frame's
// ORB features.
enum class Identity { kPatch, kDescriptor };

inline std::span<const char* const> option_names(Identity) {
  static constexpr const char* names[] = {"patch", "descriptor"};
  return names;
}

struct FollowOptions {
  Identity identity = Identity::kPatch;
  bool align = true;
  int scouts = 120;
  int scout_levels = 4;
  int levels = 2;
  double max_move = 12;
  double search_radius = 20;
  int max_distance = 64;
  double max_distance_ratio = 0.85;
  double position_sigma = 0.35;
  double keypoint_sigma = 0.7;
  double disparity_sigma = 0.12;
  double soft_sigma = 0;
  double soft_disparity = 1.5;
  double max_row_offset = 1.5;
  double max_return = 0.3;
  int max_missed = 2;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.identity, {"identity", "", "what finds a landmark again: patch, or descriptor"});
    visit(self.align,
          {"align", "", "refine positions by aligning patches; off: the keypoint's own position"});
    visit(self.scouts,
          {"scouts", "", "landmarks followed first and widely, to predict the others better", 0, 10000});
    visit(self.scout_levels, {"scout_levels", "", "pyramid levels the scouts are aligned on", 1, 6});
    visit(self.levels, {"levels", "", "pyramid levels the others are aligned on", 1, 6});
    visit(self.max_move,
          {"max_move", "px", "farthest from its prediction that a patch may be found after the scouts", 0.5,
           200});
    visit(self.search_radius,
          {"search_radius", "px", "how far from its prediction a descriptor is sought", 1, 200});
    visit(self.max_distance, {"max_distance", "bits", "largest Hamming distance of a match", 1, 256});
    visit(self.max_distance_ratio, {"max_distance_ratio", "",
                                    "best over second best distance; above it a match is ambiguous", 0.1, 1});
    visit(self.position_sigma, {"position_sigma", "px", "deviation of an aligned position", 0.01, 10});
    visit(self.keypoint_sigma,
          {"keypoint_sigma", "px", "deviation of a keypoint's own position, at full size", 0.01, 10});
    visit(self.disparity_sigma, {"disparity_sigma", "px", "deviation of an aligned disparity", 0.01, 10});
    visit(self.soft_sigma,
          {"soft_sigma", "px", "blur under which small disparities are measured, against aliasing; 0: none",
           0, 3});
    visit(self.soft_disparity, {"soft_disparity", "px", "disparity up to which one is small", 0, 1000});
    visit(self.max_row_offset, {"max_row_offset", "px", "largest row difference of the two eyes", 0.1, 20});
    visit(self.max_return,
          {"max_return", "px", "farthest from the left point that the way back from the right eye may end",
           0.01, 5});
    visit(self.max_missed,
          {"max_missed", "", "frames in a row without it after which a landmark is let go", 0, 100});
  }
};

struct FarOptions {
  bool enabled = true;
  double ransac_threshold = 2.0;
  int ransac_rounds = 50;
  int memory = 10;
  double min_weight = 0.1;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.enabled, {"enabled", "", "weigh far points by how often they proved right, equation (8)"});
    visit(self.ransac_threshold,
          {"ransac_threshold", "px", "residual up to which a far point is an inlier", 0.1, 50});
    visit(self.ransac_rounds, {"ransac_rounds", "", "hypotheses", 1, 10000});
    visit(self.memory, {"memory", "", "frames whose inlier frequency makes the weight", 1, 1000});
    visit(self.min_weight, {"min_weight", "", "the weight never falls below", 0, 1});
  }
};

struct KeyframeOptions {
  int min_frames = 1;
  int max_frames = 10;
  double lost_of_keyframe = 0.3;
  double lost_of_previous = 0.5;
  double max_rotation = 10;
  double max_parallax = 40;
  bool entropy = true;
  double entropy_change = 0.3;
  int entropy_window = 10;
  int min_tracked = 60;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.min_frames, {"min_frames", "", "frames at least between two keyframes", 1, 1000});
    visit(self.max_frames, {"max_frames", "", "frames after which one is due (i)", 1, 10000});
    visit(self.lost_of_keyframe,
          {"lost_of_keyframe", "", "share of the last keyframe's points lost that makes one due (i)", 0, 1});
    visit(self.lost_of_previous, {"lost_of_previous", "",
                                  "share of the previous frame's points lost that makes one due (ii)", 0, 1});
    visit(self.max_rotation,
          {"max_rotation", "deg", "rotation since the last one that makes one due (i)", 0.1, 180});
    visit(self.max_parallax, {"max_parallax", "px",
                              "median motion of the points in the image that makes one due (i)", 1, 10000});
    visit(self.entropy, {"entropy", "", "watch the entropy of the motion, equation (10) (iii)"});
    visit(self.entropy_change,
          {"entropy_change", "", "relative change of the motion's uncertainty that makes one due (iii)", 0.01,
           10});
    visit(self.entropy_window,
          {"entropy_window", "", "frames whose mean entropy the newest is compared with", 1, 1000});
    visit(self.min_tracked,
          {"min_tracked", "", "fewer tracked points than this make one due whatever else holds", 0, 10000});
  }
};

struct StateOptions {
  int min_inliers = 12;
  double max_covariance = 1.0;
  double coast_time = 2.0;
  int relocalization_frames = 10;
  double coast_acceleration = 0.5;
  double coast_turn = 0.3;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.min_inliers, {"min_inliers", "", "fewer inliers do not make a motion", 3, 1000});
    visit(self.max_covariance,
          {"max_covariance", "m", "a motion less certain than this is not taken", 1e-3, 1e6});
    visit(self.coast_time,
          {"coast_time", "s", "how long constant velocity may carry before the state is lost", 0, 3600});
    visit(
        self.relocalization_frames,
        {"relocalization_frames", "",
         "usable frames that are looked for in the map after a loss before tracking begins anew", 0, 100000});
    visit(self.coast_acceleration,
          {"coast_acceleration", "m/s^2", "acceleration assumed while coasting (1 sigma)", 1e-3, 100});
    visit(self.coast_turn,
          {"coast_turn", "rad/s^2", "angular acceleration assumed while coasting (1 sigma)", 1e-3, 100});
  }
};

struct LandmarkOptions {
  int count = 600;
  double spacing = 6;
  int levels = 1;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.count, {"count", "", "landmarks that are followed at most", 20, 20000});
    visit(self.spacing,
          {"spacing", "px", "least distance of a new landmark from those that are followed", 1, 100});
    visit(self.levels,
          {"levels", "", "pyramid levels (of orb.levels) that new landmarks come from: 1 for full size only",
           1, 16});
  }
};

struct RecallOptions {
  bool enabled = true;
  int count = 200;
  double max_angle = 30;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.enabled, {"enabled", "", "look again for landmarks of the local map that should be in sight"});
    visit(self.count, {"count", "", "looked for at most after each keyframe", 0, 10000});
    visit(self.max_angle, {"max_angle", "deg", "between the views from the host and from here", 1, 90});
  }
};

struct TrackerOptions {
  OrbOptions orb;
  bool segment = true;
  SegmentationOptions segmentation;
  StereoOptions stereo;
  bool stereo_by_descriptor = false;
  AlignmentOptions alignment;
  RowSearchOptions row_search;
  LandmarkOptions landmarks;
  FollowOptions follow;
  RecallOptions recall;
  FarOptions far;
  TrialOptions trial;
  MoverOptions movers;
  SolverOptions motion;
  SolverOptions window{.iterations = 6};
  int window_frames = 10;
  RigOptions rig;
  KeyframeOptions keyframe;
  StateOptions state;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit.group("orb", self.orb);
    visit(self.segment, {"segment", "", "tell near, far and mirrored regions of the image apart (3.1.2)"});
    visit.group("segmentation", self.segmentation);
    visit.group("stereo", self.stereo);
    visit(self.stereo_by_descriptor, {"stereo_by_descriptor", "",
                                      "new disparities by the paper's chain; off: row search and alignment"});
    visit.group("alignment", self.alignment);
    visit.group("row_search", self.row_search);
    visit.group("landmarks", self.landmarks);
    visit.group("follow", self.follow);
    visit.group("recall", self.recall);
    visit.group("far", self.far);
    visit.group("trial", self.trial);
    visit.group("movers", self.movers);
    visit.group("motion", self.motion);
    visit.group("window", self.window);
    visit(self.window_frames, {"window_frames", "", "frames solved together; 1 for one by one", 1, 50});
    visit.group("rig", self.rig);
    visit.group("keyframe", self.keyframe);
    visit.group("state", self.state);
  }
};

}  // namespace spslam
