// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/loop/loop_closer.h"

namespace spslam {
namespace {

LoopClosure make_closure(const Place& older, KeyframeId newer, const Verification& found) {
  LoopClosure closure;
  closure.edge = {older.id, newer, found.newer_from_older, static_cast<double>(found.inliers)};
  closure.covariance = found.covariance;
  for (const Correspondence& pair : found.pairs) {
    const PlacePoint& point = older.points[pair.point];
    const Keypoint& keypoint = older.keypoint(point);
    closure.pairs.push_back({older.sources[point.source].id, {keypoint.x, keypoint.y}, pair.feature});
  }
  return closure;
}

LoopCandidate summary_of(const CandidateGroup& group, const Verification& found) {
  return {group.best,    group.best_score,        found.stage,          found.matches, found.consensus,
          found.inliers, found.translation_sigma, found.rotation_sigma, found.scale,   false};
}

}  // namespace

LoopCloser::LoopCloser(const StereoRig& rig, const LoopOptions& options, Vocabulary vocabulary)
    : rig_(rig), options_(options), index_(std::move(vocabulary)) {
  check_options(options);
}

void LoopCloser::add(const Map& map, KeyframeId id) {
  const Keyframe* keyframe = map.find(id);
  if (keyframe && keyframe->features) index_.add(id, *keyframe->features);
}

// Those far enough back, that share no landmark with it, and that look at least somewhat as much like it as
// the keyframe before it does.
std::vector<CandidateGroup> LoopCloser::groups_for(const Map& map, KeyframeId newest) const {
  std::set<KeyframeId> exclude = {newest};
  for (const Covisible& near : map.covisible(newest)) exclude.insert(near.id);
  int newer = options_.min_gap;
  for (auto it = map.keyframes().rbegin(); it != map.keyframes().rend() && newer-- > 0; ++it)
    exclude.insert(it->first);
  const WordVector* words = index_.find(newest);
  if (!words) return {};
  const double least = options_.score_share * index_.score(newest, previous_);
  std::vector<Candidate> candidates = index_.query(*words, exclude);
  std::erase_if(candidates, [&](const Candidate& candidate) { return candidate.score < least; });
  std::vector<CandidateGroup> groups = group_candidates(candidates, map, options_.grouping);
  if (static_cast<int>(groups.size()) > options_.candidates)
    groups.resize(static_cast<std::size_t>(options_.candidates));
  return groups;
}

LoopAttempt LoopCloser::detect(const Map& map, KeyframeId newest) {
  LoopAttempt attempt;
  attempt.keyframe = newest;
  const Keyframe* keyframe = map.find(newest);
  if (!keyframe || !keyframe->features) return attempt;
  add(map, newest);
  const std::vector<CandidateGroup> groups = groups_for(map, newest);
  previous_ = newest;
  if (closed_.valid() && newest.value <= closed_.value + options_.pause) return attempt;
  bool was_verified = false;
  for (const CandidateGroup& group : groups) {
    const Place older = place_of(map, rig_, group.best, options_.verification.neighbours);
    const Verification found =
        verify(older, *keyframe->features, rig_, index_.vocabulary(), options_.verification);
    attempt.candidates.push_back(summary_of(group, found));
    if (!found.accepted()) continue;
    was_verified = true;
    const LoopClosure closure = make_closure(older, newest, found);
    if (!is_consistent(map, closure.edge, newest)) break;
    attempt.candidates.back().consistent = true;
    attempt.closure = closure;
    pending_.reset();
    closed_ = newest;
    return attempt;
  }
  if (!was_verified) pending_.reset();
  return attempt;
}

// Whether enough keyframes in a row imply the same change of the world.
bool LoopCloser::is_consistent(const Map& map, const LoopEdge& edge, KeyframeId newest) {
  const SE3 seen = edge.newer_from_older * map.find(edge.older)->camera_from_world;
  const SE3 new_from_old = seen.inverse() * map.find(newest)->camera_from_world;
  Implied implied{newest, new_from_old, 1};
  if (pending_) {
    // The difference, as it acts on the newest camera.
    const SE3 camera_from_world = map.find(newest)->camera_from_world;
    const SE3 difference =
        camera_from_world * pending_->new_from_old.inverse() * new_from_old * camera_from_world.inverse();
    const bool agrees = difference.translation.norm() <= options_.consistent_translation &&
                        so3_log(difference.rotation).norm() * 180 / M_PI <= options_.consistent_rotation;
    if (agrees) implied.in_a_row = pending_->in_a_row + 1;
  }
  pending_ = implied;
  return implied.in_a_row >= options_.consistency;
}

std::optional<Relocalized> LoopCloser::relocalize(const Map& map, const KeyframeFeatures& seen) const {
  std::vector<CandidateGroup> groups = group_candidates(index_.query(seen), map, options_.grouping);
  if (static_cast<int>(groups.size()) > options_.relocalization_candidates)
    groups.resize(static_cast<std::size_t>(options_.relocalization_candidates));
  std::optional<Relocalized> best;
  for (const CandidateGroup& group : groups) {
    const Verification found = verify_place(map, group.best, seen);
    if (!found.accepted() || (best && found.inliers <= best->inliers)) continue;
    best = Relocalized{found.newer_from_older * map.find(group.best)->camera_from_world, found.covariance,
                       group.best, found.inliers};
  }
  return best;
}

Verification LoopCloser::verify_place(const Map& map, KeyframeId older, const KeyframeFeatures& newer) const {
  return verify(place_of(map, rig_, older, options_.verification.neighbours), newer, rig_,
                index_.vocabulary(), options_.verification);
}

}  // namespace spslam
