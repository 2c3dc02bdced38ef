// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/loop/keyframe_index.h"

#include <algorithm>

namespace spslam {

KeyframeIndex::KeyframeIndex(Vocabulary vocabulary)
    : vocabulary_(std::move(vocabulary)), inverse_(static_cast<std::size_t>(vocabulary_.nodes())) {}

void KeyframeIndex::add(KeyframeId id, const KeyframeFeatures& features) {
  add(id, vocabulary_.describe(features.descriptors));
}

void KeyframeIndex::add(KeyframeId id, WordVector words) {
  erase(id);
  if (free_.empty()) {
    free_.push_back(static_cast<std::uint32_t>(slots_.size()));
    slots_.emplace_back();
    ids_.emplace_back();
  }
  const std::uint32_t slot = free_.back();
  free_.pop_back();
  for (const auto& [word, share] : words.words) inverse_.at(word).push_back({slot, share});
  slots_[slot] = std::move(words);
  ids_[slot] = id;
  keyframes_[id] = slot;
}

void KeyframeIndex::erase(KeyframeId id) {
  const auto found = keyframes_.find(id);
  if (found == keyframes_.end()) return;
  const std::uint32_t slot = found->second;
  for (const auto& [word, share] : slots_[slot].words)
    std::erase_if(inverse_[word], [slot](const Posting& posting) { return posting.slot == slot; });
  slots_[slot] = {};
  ids_[slot] = {};
  free_.push_back(slot);
  keyframes_.erase(found);
}

const WordVector* KeyframeIndex::find(KeyframeId id) const {
  const auto found = keyframes_.find(id);
  return found == keyframes_.end() ? nullptr : &slots_[found->second];
}

std::vector<Candidate> KeyframeIndex::query(const WordVector& words,
                                            const std::set<KeyframeId>& exclude) const {
  // As similarity() adds it up: by ascending word.
  std::vector<double> scores(slots_.size(), 0);
  for (const auto& [word, share] : words.words)
    for (const Posting& posting : inverse_.at(word)) scores[posting.slot] += std::min(share, posting.share);
  std::vector<Candidate> out;
  for (std::size_t slot = 0; slot < scores.size(); ++slot)
    if (scores[slot] > 0 && !exclude.contains(ids_[slot]))
      out.push_back({ids_[slot], std::min(scores[slot], 1.0)});
  std::sort(out.begin(), out.end(), [](const Candidate& a, const Candidate& b) {
    return a.score != b.score ? a.score > b.score : a.id < b.id;
  });
  return out;
}

std::vector<Candidate> KeyframeIndex::query(const KeyframeFeatures& features,
                                            const std::set<KeyframeId>& exclude) const {
  return query(vocabulary_.describe(features.descriptors), exclude);
}

namespace {

constexpr std::size_t kNeighbours = 10;  // most covisible keyframes whose scores are added to a candidate's
constexpr int kGroups = 20;              // candidates looked at, the best ones

CandidateGroup group_around(const Candidate& candidate, const std::map<KeyframeId, double>& scores,
                            const Map& map) {
  CandidateGroup group{candidate.id, candidate.score, candidate.score, {candidate.id}};
  std::vector<Covisible> near = map.covisible(candidate.id);
  near.resize(std::min(near.size(), kNeighbours));
  for (const Covisible& other : near) {
    const auto found = scores.find(other.id);
    if (found == scores.end()) continue;
    group.score += found->second;
    group.members.push_back(other.id);
    if (found->second > group.best_score) group.best = other.id, group.best_score = found->second;
  }
  std::sort(group.members.begin(), group.members.end());
  return group;
}

}  // namespace

std::vector<CandidateGroup> group_candidates(std::span<const Candidate> candidates, const Map& map) {
  std::map<KeyframeId, double> scores;
  for (const Candidate& candidate : candidates) scores[candidate.id] = candidate.score;
  std::map<KeyframeId, CandidateGroup> groups;  // by their best keyframe
  int made = 0;
  for (const Candidate& candidate : candidates) {
    if (made >= kGroups) break;
    if (!map.find(candidate.id)) continue;
    ++made;
    CandidateGroup group = group_around(candidate, scores, map);
    CandidateGroup& kept = groups[group.best];
    if (group.score > kept.score) kept = std::move(group);
  }
  std::vector<CandidateGroup> out;
  for (auto& [best, group] : groups) out.push_back(std::move(group));
  std::sort(out.begin(), out.end(), [](const CandidateGroup& a, const CandidateGroup& b) {
    return a.score != b.score ? a.score > b.score : a.best < b.best;
  });
  return out;
}

}  // namespace spslam
