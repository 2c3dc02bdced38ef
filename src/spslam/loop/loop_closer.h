// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Loop closing, the third of the three threads (SPEC part 8): recognizes places by their words, makes sure by
// geometry, and says where the newest keyframe was seen from before. It reads the map and writes nothing; the
// correction is made on copies (essential_graph.h, fusion.h, full_adjustment.h) and applied by the map's
// writer (correction.h).
#pragma once

#include <set>

#include "spslam/loop/correction.h"
#include "spslam/loop/keyframe_index.h"
#include "spslam/loop/patch_pose.h"
#include "spslam/loop/verification.h"

namespace spslam {

struct DetectionOptions {
  int min_gap = 20;
  double min_score_share = 0.7;
  int candidates = 3;
  int consistency = 1;
  int confirmations = 1;
  double min_detour = 2;
  double max_drift = 0.3;
  double max_drift_floor = 1;
  double max_turn_drift = 0.2;
  double max_turn_drift_floor = 5;
  int pause = 5;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.min_gap, {"min_gap", "", "keyframes between the two ends of a loop, at least", 1, 1e6});
    visit(self.min_score_share,
          {"min_score_share", "",
           "likeness of a candidate over that of the neighbour least like the keyframe, at least", 0, 10});
    visit(self.candidates, {"candidates", "", "groups of candidates looked at, best first", 1, 100});
    visit(self.consistency,
          {"consistency", "", "keyframes before in a row with a candidate of the same group", 0, 20});
    visit(self.confirmations,
          {"confirmations", "", "keyframes before that must give the same motion by themselves", 0, 10});
    visit(self.min_detour,
          {"min_detour", "m/m", "length of the way over the distance of its ends, at least", 1, 1000});
    visit(self.max_drift,
          {"max_drift", "m/m", "gap of a loop over the length of its way, at most", 0.001, 100});
    visit(self.max_drift_floor, {"max_drift_floor", "m", "and this more", 0, 1000});
    visit(self.max_turn_drift,
          {"max_turn_drift", "deg/m", "turn of the gap over the length of its way, at most", 0, 360});
    visit(self.max_turn_drift_floor, {"max_turn_drift_floor", "deg", "and this more", 0, 180});
    visit(self.pause, {"pause", "", "keyframes after a loop without another one", 0, 1000});
  }
};

// Where a candidate was dropped, in order of the tests.
enum class LoopStage {
  kInconsistent,  // the keyframes before did not look like it
  kNoReturn,      // the camera went on and did not come back: odometry over so short a way knows better
  kNotVerified,   // by geometry; the verification says why
  kImplausible,   // odometry cannot have drifted so far
  kNotConfirmed,  // a keyframe before says otherwise, or nothing
  kAccepted
};

inline std::span<const char* const> option_names(LoopStage) {
  static constexpr const char* names[] = {"inconsistent", "no-return",     "not-verified",
                                          "implausible",  "not-confirmed", "accepted"};
  return names;
}

struct LoopCandidate {
  KeyframeId keyframe;
  double timestamp = 0;  // s; its
  double score = 0;      // of the group
  int consistency = 0;   // keyframes before with a candidate of the same group, in a row
  LoopStage stage = LoopStage::kInconsistent;
  Verification verification;     // without pairs
  double gap = 0, turn_gap = 0;  // m, deg: what closing would move by
  double way = 0;                // m: the length of the way; infinite from a submap to another
  int confirmed = 0;             // by keyframes before
};

struct LoopAttempt {
  KeyframeId keyframe;   // the newest
  double timestamp = 0;  // s; its
  double least_score = 0;
  std::vector<LoopCandidate> candidates;  // in the order they were tried; ends with the accepted one
  std::optional<LoopClosure> closure;
};

class LoopCloser {
 public:
  // Throws OptionError.
  LoopCloser(const StereoRig& rig, const DetectionOptions& detection, const VerificationOptions& verification,
             const PatchPoseOptions& patches, const Vocabulary& vocabulary);

  // Looks for a loop that ends in this keyframe and adds it to the index; keyframes in ascending order, each
  // once. The same for the same calls.
  LoopAttempt detect(const Map& map, KeyframeId newest);
  // The correction for a loop that detect() found is in the map: its ends are connected, and the next loops
  // wait (pause).
  void closed(const LoopClosure& closure);
  // Only adds it, as for the keyframes of a map that was loaded.
  void add(const Map& map, KeyframeId id);
  void erase(KeyframeId id) { index_.erase(id); }
  // Whether landmarks or loops connect the two. After a loss tracking may have begun anew where dead
  // reckoning led: a submap, which may be anywhere until a loop joins it to the others.
  bool connected(KeyframeId a, KeyframeId b) const { return submap_of(a) == submap_of(b); }
  const KeyframeIndex& index() const { return index_; }

 private:
  struct Trail {  // a group of candidates and for how many keyframes in a row it was there
    std::set<KeyframeId> members;
    int length = 0;
  };

  void connect(const Map& map, KeyframeId id);
  void join(KeyframeId a, KeyframeId b);
  int submap_of(KeyframeId id) const;
  std::set<KeyframeId> excluded(const Map& map, KeyframeId newest) const;
  double least_score(const Map& map, const Keyframe& keyframe, const WordVector& words) const;
  std::vector<LoopCandidate> find_candidates(const Map& map, const Keyframe& keyframe, LoopAttempt& attempt);
  void examine(const Map& map, const Keyframe& keyframe, LoopCandidate& candidate,
               LoopAttempt& attempt) const;
  void make_precise(const Map& map, const Keyframe& keyframe, LoopCandidate& candidate) const;
  static void measure_gap(const Map& map, const Keyframe& keyframe, LoopCandidate& candidate);
  bool is_plausible(const Map& map, const Keyframe& keyframe, LoopCandidate& candidate) const;
  int confirm(const Map& map, const Keyframe& keyframe, const Place& place,
              const LoopCandidate& candidate) const;

  StereoRig rig_;
  DetectionOptions options_;
  VerificationOptions verification_;
  PatchPoseOptions patches_;
  KeyframeIndex index_;
  std::vector<Trail> trails_;
  KeyframeId last_closed_;
  std::map<KeyframeId, int> submaps_;  // of each keyframe ever added, erased ones too
  int submaps_begun_ = 0;
};

}  // namespace spslam
