// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// How well a vocabulary recognizes places, on images whose poses are known.
#pragma once

#include <span>
#include <vector>

#include "spslam/base/se3.h"
#include "spslam/loop/vocabulary.h"

namespace spslam {

struct PlaceRecallOptions {
  double distance = 3;
  double angle = 30;
  double gap = 10;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.distance, {"distance", "m", "two views within this distance are of the same place", 0, 1e6});
    visit(self.angle, {"angle", "deg", "... if they look in directions within this angle", 0, 180});
    visit(self.gap, {"gap", "s", "an image is compared with those that are older by more than this", 0, 1e6});
  }
};

// An image of known pose.
struct PlaceView {
  double timestamp = 0;  // s
  SE3 world_from_camera;
  std::vector<Descriptor> descriptors;
};

struct RecallResult {
  int queries = 0;     // images with others to compare them with
  int revisits = 0;    // of these, those with one of the same place among the others
  int first = 0;       // of these, those whose best answer is of the same place
  int among_five = 0;  // ... one of whose five best answers is
  // Of these, those whose best answer is right and scores higher than any wrong best answer to any query:
  // what a loop closer would find that relies on the score alone and may never be wrong.
  int certain = 0;
  double highest_wrong = 0;              // score of a wrong best answer
  double describe_ms = 0, query_ms = 0;  // mean of a query
};

// Asks for each view in turn, among those of the same sequence that are older, by the gap, than it (as a loop
// closer does). Views in order of time.
RecallResult measure_recall(std::span<const PlaceView> views, const Vocabulary& vocabulary,
                            const PlaceRecallOptions& options = {});
// Asks for each view among all of another sequence, whose poses must be in the same world (as localization in
// a saved map does).
RecallResult measure_recall(std::span<const PlaceView> views, std::span<const PlaceView> map,
                            const Vocabulary& vocabulary, const PlaceRecallOptions& options = {});

}  // namespace spslam
