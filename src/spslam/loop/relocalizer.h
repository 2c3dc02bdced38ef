// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Where in the map an image was taken, without any guess (SPEC part 8): candidates by words, each verified
// like a loop. No answer rather than a wrong one.
#pragma once

#include "spslam/loop/keyframe_index.h"
#include "spslam/loop/patch_pose.h"
#include "spslam/loop/verification.h"

namespace spslam {

struct RelocalizationOptions {
  int candidates = 5;
  VerificationOptions verification;
  PatchPoseOptions patches;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.candidates, {"candidates", "", "places that are compared, best first", 1, 1000});
    visit.group("verification", self.verification);
    visit.group("patches", self.patches);
  }
};

struct Relocalized {
  SE3 camera_from_world;
  Matrix6d covariance = Matrix6d::Identity();  // of a left perturbation of it against the reference, (m, rad)
  KeyframeId reference;                        // the keyframe recognized
  int inliers = 0;
};

struct RelocalizationAttempt {
  struct Tried {
    KeyframeId keyframe;
    double score = 0;
    Verification verification;  // without pairs
  };
  std::vector<Tried> tried;
  std::optional<Relocalized> found;
  // Where nothing was found: the place that all but the last test accept, because all that is seen there is
  // too far to tell the position precisely.
  std::optional<Relocalized> imprecise;
};

// One line for the log: each keyframe tried, the test it ended at and its figures.
std::string describe_attempt(const RelocalizationAttempt& attempt);

// Features with inverse depths if stereo gave them; without, the map's alone must do. What is found is made
// precise by patches, where the query and the map have images. Nothing if two places that are accepted
// contradict each other. Keyframes in `exclude` are no candidates, as those of the submap
// that was begun when the old one was lost. Those in `guesses` are compared first, and alone if one of them
// is the place.
RelocalizationAttempt relocalize(const SeenFrame& query, const Map& map, const StereoRig& rig,
                                 const KeyframeIndex& index, const RelocalizationOptions& options,
                                 const std::set<KeyframeId>& exclude = {},
                                 std::span<const KeyframeId> guesses = {});

}  // namespace spslam
