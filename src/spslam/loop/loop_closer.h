// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Loop detection and relocalization (SPEC, part 8): candidates from the keyframe index, geometric
// verification, and, for a loop, two keyframes in a row that say the same.
#pragma once

#include "spslam/loop/essential_graph.h"
#include "spslam/loop/fusion.h"
#include "spslam/loop/keyframe_index.h"
#include "spslam/loop/verification.h"

namespace spslam {

struct LoopOptions {
  bool enabled = true;
  int min_gap = 20;
  int pause = 5;
  int candidates = 3;
  int relocalization_candidates = 8;
  double score_share = 0.3;
  int consistency = 2;
  double consistent_translation = 0.3;
  double consistent_rotation = 1;
  GroupingOptions grouping;
  VerificationOptions verification;
  EssentialGraphOptions graph;
  FusionOptions fusion;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.enabled, {"enabled", "", "close loops"});
    visit(self.min_gap, {"min_gap", "", "newest keyframes that are no candidates for a loop", 1, 100000});
    visit(self.pause, {"pause", "", "keyframes after a closed loop in which none is sought", 0, 100000});
    visit(self.candidates, {"candidates", "", "places verified for a keyframe at most", 1, 100});
    visit(self.relocalization_candidates,
          {"relocalization_candidates", "", "places verified for a lost frame at most", 1, 1000});
    visit(self.score_share,
          {"score_share", "", "score of a candidate at least, over that of the keyframe before the newest", 0,
           1});
    visit(self.consistency,
          {"consistency", "", "keyframes in a row that must be verified and agree before a loop is closed", 1,
           100});
    visit(self.consistent_translation,
          {"consistent_translation", "m", "by which the corrections that they imply may differ", 0.001, 100});
    visit(self.consistent_rotation, {"consistent_rotation", "deg", "the same, of rotation", 0.001, 180});
    visit.group("grouping", self.grouping);
    visit.group("verification", self.verification);
    visit.group("graph", self.graph);
    visit.group("fusion", self.fusion);
  }
};

// What became of one candidate.
struct LoopCandidate {
  KeyframeId older;
  double score = 0;  // of the words of the two
  VerificationStage stage = VerificationStage::kNotDescribed;
  int matches = 0, consensus = 0, inliers = 0;
  double translation_sigma = 0, rotation_sigma = 0;  // m, deg
  double scale = 1;                                  // of the newer side's depths to the older's
  bool consistent = false;                           // with the keyframe before
};

struct LoopAttempt {
  KeyframeId keyframe;
  std::vector<LoopCandidate> candidates;
  std::optional<LoopClosure> closure;  // if the loop may be closed
};

struct Relocalized {
  SE3 camera_from_world;
  Matrix6d covariance = Matrix6d::Identity();  // of a left perturbation of it, (m, rad)
  KeyframeId reference;
  int inliers = 0;
};

// Not for concurrent calls; the map must not change during one.
class LoopCloser {
 public:
  LoopCloser(const StereoRig& rig, const LoopOptions& options, Vocabulary vocabulary);

  // Makes a keyframe of the map a candidate for later ones. Nothing if it has no features.
  void add(const Map& map, KeyframeId id);
  void erase(KeyframeId id) { index_.erase(id); }
  // Whether a keyframe that has just been mapped sees a place that was seen before; then adds it.
  LoopAttempt detect(const Map& map, KeyframeId newest);
  // Where a camera is that sees these features; nothing unless it is known for sure.
  std::optional<Relocalized> relocalize(const Map& map, const KeyframeFeatures& seen) const;

 private:
  // The change of the world that a closure implies for its newer keyframe.
  struct Implied {
    KeyframeId keyframe;
    SE3 new_from_old;
    int in_a_row = 1;
  };
  std::vector<CandidateGroup> groups_for(const Map& map, KeyframeId newest) const;
  Verification verify_place(const Map& map, KeyframeId older, const KeyframeFeatures& newer) const;
  bool is_consistent(const Map& map, const LoopEdge& edge, KeyframeId newest);

  StereoRig rig_;
  LoopOptions options_;
  KeyframeIndex index_;
  std::optional<Implied> pending_;
  KeyframeId previous_, closed_;
};

}  // namespace spslam
