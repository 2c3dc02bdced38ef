// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// What the map forgets, so that it grows with the area and not with time.
#pragma once

#include "spslam/map/map.h"

namespace spslam {

struct CullingOptions {
  bool enabled = true;
  int landmark_trial = 3;
  int landmark_views = 2;
  double redundant_share = 0.95;
  int redundant_views = 3;
  int keep_newest = 10;
  int revisit_gap = 50;
  int revisit_shared = 30;
  double revisit_rotation = 10;
  double revisit_change = 0.1;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.enabled, {"enabled", "", "forget landmarks that are hardly seen and redundant keyframes"});
    visit(self.landmark_trial,
          {"landmark_trial", "", "keyframes after its host in which a landmark may prove itself", 1, 100});
    visit(self.landmark_views, {"landmark_views", "", "keyframes that must have seen it by then", 1, 100});
    visit(self.redundant_share,
          {"redundant_share", "",
           "share of its landmarks that others see as well, above which a keyframe goes", 0.1, 1});
    visit(self.redundant_views,
          {"redundant_views", "", "other keyframes that must see a landmark for it to count there", 1, 100});
    visit(self.keep_newest, {"keep_newest", "", "newest keyframes that never go", 3, 1000});
    visit(self.revisit_gap,
          {"revisit_gap", "", "keyframes between two for them to be two visits of a place", 1, 100000});
    visit(self.revisit_shared,
          {"revisit_shared", "", "landmarks that both must see for it to be the same place", 1, 10000});
    visit(self.revisit_rotation, {"revisit_rotation", "deg", "largest rotation between them", 0.1, 90});
    visit(self.revisit_change, {"revisit_change", "",
                                "angle (rad) between the rays to a landmark, and relative change of its "
                                "distance, that most landmarks do "
                                "not exceed",
                                0.001, 2});
  }
};

// Erases the landmarks whose trial ended with this keyframe and that too few keyframes saw; their number.
int cull_landmarks(Map& map, KeyframeId newest, const CullingOptions& options);

// Erases the keyframes around this one whose landmarks are almost all seen by enough others, and the one that
// has just ceased to be among the newest if an earlier visit saw the same place: their ids. The root of the
// spanning tree, the ends of loop edges and the newest ones stay.
std::vector<KeyframeId> cull_keyframes(Map& map, KeyframeId newest, const CullingOptions& options);

}  // namespace spslam
