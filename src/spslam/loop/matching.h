// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Which features of two images are of the same thing, by their descriptors alone: compared only under the
// same node of the vocabulary's tree (Galvez-Lopez and Tardos 2012, section V-A), unambiguous (Lowe's ratio),
// mutual, and turned by the same angle.
#pragma once

#include "spslam/loop/vocabulary.h"
#include "spslam/map/types.h"

namespace spslam {

struct MatchingOptions {
  int node_level = 1;
  int max_distance = 64;
  double ratio = 0.85;
  double turn = 25;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.node_level,
          {"node_level", "", "level of the tree (root 0) under whose nodes descriptors are compared", 0, 10});
    visit(self.max_distance, {"max_distance", "bit", "Hamming distance of a match at most", 1, 256});
    visit(self.ratio, {"ratio", "", "best distance over second best, at most", 0.1, 1});
    visit(self.turn, {"turn", "deg", "a match may be turned that much from what most are", 1, 180});
  }
};

struct FeatureMatch {
  int first = 0, second = 0;  // features of the two images
  int distance = 0;           // bit
  friend bool operator==(const FeatureMatch&, const FeatureMatch&) = default;
};

// The features of a keyframe under the nodes of the vocabulary that the options say; all under one of an
// empty vocabulary.
NodeFeatures group_features(const Vocabulary& vocabulary, const KeyframeFeatures& features,
                            const MatchingOptions& options);

// Ascending by first; each feature at most once. The nodes are those of group_features().
std::vector<FeatureMatch> match_features(const KeyframeFeatures& first, const NodeFeatures& first_nodes,
                                         const KeyframeFeatures& second, const NodeFeatures& second_nodes,
                                         const MatchingOptions& options);

}  // namespace spslam
