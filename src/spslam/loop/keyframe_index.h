// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Which keyframes look like this one: an inverted file from words to keyframes (Galvez-Lopez and Tardos 2012,
// section IV) with the covisibility graph to add up what neighbours say (Mur-Artal, Montiel and Tardos,
// "ORB-SLAM: a versatile and accurate monocular SLAM system", 2015, section III-D).
#pragma once

#include <map>
#include <set>
#include <span>
#include <vector>

#include "spslam/loop/vocabulary.h"
#include "spslam/map/map.h"

namespace spslam {

struct Candidate {
  KeyframeId id;
  double score = 0;  // similarity(), 0 to 1
  friend bool operator==(const Candidate&, const Candidate&) = default;
};

// Candidates that see the same part of the map, with the sum of their scores.
struct CandidateGroup {
  KeyframeId best;  // the one with the highest score of its own
  double best_score = 0;
  double score = 0;                 // of all members together
  std::vector<KeyframeId> members;  // ascending
};

// Not for concurrent calls while one of them is add or erase.
class KeyframeIndex {
 public:
  explicit KeyframeIndex(Vocabulary vocabulary);  // shares its memory

  // Replaces the keyframe's words if it is there already.
  void add(KeyframeId id, const KeyframeFeatures& features);
  void add(KeyframeId id, WordVector words);
  void erase(KeyframeId id);  // nothing if it is not there

  std::size_t size() const { return keyframes_.size(); }
  const Vocabulary& vocabulary() const { return vocabulary_; }
  const WordVector* find(KeyframeId id) const;  // null if it is not there

  // All that share a word and are not excluded: highest score first, then by id.
  std::vector<Candidate> query(const WordVector& words, const std::set<KeyframeId>& exclude = {}) const;
  std::vector<Candidate> query(const KeyframeFeatures& features,
                               const std::set<KeyframeId>& exclude = {}) const;

 private:
  struct Posting {
    std::uint32_t slot;
    float share;
  };

  Vocabulary vocabulary_;
  std::map<KeyframeId, std::uint32_t> keyframes_;  // to their slots
  std::vector<WordVector> slots_;
  std::vector<KeyframeId> ids_;                // of the slots; not valid where one is free
  std::vector<std::uint32_t> free_;            // slots
  std::vector<std::vector<Posting>> inverse_;  // of each word
};

// The 20 best candidates, each with those of its 10 most covisible keyframes that are candidates too; of
// groups around the same best keyframe the one with the highest sum. Highest sum first, then by id.
// `candidates` as query() gives them; those that the map does not have (any more) make no group.
std::vector<CandidateGroup> group_candidates(std::span<const Candidate> candidates, const Map& map);

}  // namespace spslam
