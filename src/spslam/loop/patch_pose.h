// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Where in the map an image was taken, more precisely than features tell: a place that was recognized says
// which landmarks are in sight, the patches of their keyframes say where they are. SPEC, last section:
// identity from ORB, position from the patch.
#pragma once

#include <set>

#include "spslam/alignment/patch_aligner.h"
#include "spslam/base/uncertain_pose.h"
#include "spslam/camera/stereo_rig.h"
#include "spslam/map/map.h"

namespace spslam {

struct PatchPoseOptions {
  bool enabled = true;
  int keyframes = 12;
  double max_move = 12;
  int min_landmarks = 20;
  double min_inlier_share = 0.5;
  double position_sigma = 0.2;
  AlignmentOptions alignment;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.enabled, {"enabled", "", "align patches of the map's keyframes with what was recognized"});
    visit(self.keyframes, {"keyframes", "", "of the place, whose landmarks are looked for", 1, 100});
    visit(self.max_move, {"max_move", "px", "from where the features' pose puts a patch to it", 0.1, 100});
    visit(self.min_landmarks,
          {"min_landmarks", "", "found ones that agree with one pose, at least", 6, 10000});
    visit(self.min_inlier_share, {"min_inlier_share", "", "of those found, at least", 0, 1});
    visit(self.position_sigma,
          {"position_sigma", "px", "of a patch's position, in the light of another day", 0.01, 10});
    visit.group("alignment", self.alignment);
  }
};

// The pose of `left` near `start` (camera_from_world), by the landmarks that these keyframes host, as far as
// they still have an image. Nothing if too few landmarks are found where one pose puts them.
std::optional<UncertainPose> pose_by_patches(const Map& map, const StereoRig& rig,
                                             const AlignmentPyramid& left, const SE3& start,
                                             const std::vector<KeyframeId>& keyframes,
                                             const PatchPoseOptions& options);

// Of the keyframe's left image, be it there still or compressed; empty if it has none.
AlignmentPyramid pyramid_of(const Keyframe& keyframe, const StereoRig& rig, const AlignmentOptions& options);

// The keyframe that was recognized and those that share most landmarks with it, at most so many, without the
// excluded ones: those of another side, whose poses do not fit these.
std::vector<KeyframeId> keyframes_of_place(const Map& map, KeyframeId reference, int count,
                                           const std::set<KeyframeId>& exclude);

}  // namespace spslam
