// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/loop/loop_closer.h"

#include <algorithm>
#include <iterator>
#include <limits>

namespace spslam {
namespace {

constexpr int kCloseNeighbour = 15;  // landmarks shared by keyframes that must look alike
constexpr int kConnected = 15;       // landmarks shared without which submaps stay apart
constexpr int kConfirmersTried = 3;  // for each confirmation wanted
constexpr double kAgreementSigmas = 4;
constexpr double kAgreementFloor = 0.1;  // m; poses of neighbours are not exact either
constexpr double kAgreementTurn = 1.5;   // deg
constexpr double kScaleError = 0.01;     // of depths, at least

double degrees(const SE3& motion) {
  return so3_log(motion.rotation).norm() * 180 / M_PI;
}

// Length of the way from one keyframe to another, by the keyframes between.
double way_between(const Map& map, KeyframeId from, KeyframeId to) {
  double length = 0;
  const Keyframe* before = map.find(from);
  for (auto it = map.keyframes().upper_bound(from); it != map.keyframes().end() && it->first <= to; ++it) {
    length += (it->second.camera_from_world * before->camera_from_world.inverse()).translation.norm();
    before = &it->second;
  }
  return length;
}

LoopClosure closure_of(KeyframeId newer, const Place& place, const Verification& verified) {
  LoopClosure out;
  out.edge = {place.id, newer, verified.newer_from_older, static_cast<double>(verified.inliers)};
  out.covariance = verified.covariance;
  for (const Correspondence& c : verified.pairs) {
    const PlacePoint& point = place.points[c.point];
    const Keypoint& at = place.keypoint(point);
    if (at.octave == 0) out.pairs.push_back({place.sources[point.source].id, {at.x, at.y}, c.feature});
  }
  return out;
}

}  // namespace

LoopCloser::LoopCloser(const StereoRig& rig, const DetectionOptions& detection,
                       const VerificationOptions& verification, const PatchPoseOptions& patches,
                       const Vocabulary& vocabulary)
    : rig_(rig), options_(detection), verification_(verification), patches_(patches), index_(vocabulary) {
  rig.check();
  check_options(detection);
  check_options(verification);
  check_options(patches);
}

void LoopCloser::add(const Map& map, KeyframeId id) {
  const Keyframe* keyframe = map.find(id);
  if (!keyframe) return;
  connect(map, id);
  if (keyframe->features) index_.add(id, *keyframe->features);
}

// A keyframe that shares nothing with any older one begins a submap. To join two, a few landmarks that were
// perhaps found again by mistake are not enough.
void LoopCloser::connect(const Map& map, KeyframeId id) {
  if (submaps_.contains(id)) return;
  for (const Covisible& other : map.covisible(id)) {
    if (!submaps_.contains(other.id)) continue;
    if (!submaps_.contains(id))
      submaps_[id] = submap_of(other.id);
    else if (other.shared >= kConnected)
      join(id, other.id);
  }
  if (!submaps_.contains(id)) submaps_[id] = submaps_begun_++;
  for (const LoopEdge& loop : map.loops())
    if (loop.newer == id || loop.older == id) join(loop.newer, loop.older);
}

void LoopCloser::join(KeyframeId a, KeyframeId b) {
  const int kept = std::min(submap_of(a), submap_of(b)), gone = std::max(submap_of(a), submap_of(b));
  if (kept < 0 || kept == gone) return;
  for (auto& [id, submap] : submaps_)
    if (submap == gone) submap = kept;
}

int LoopCloser::submap_of(KeyframeId id) const {
  const auto it = submaps_.find(id);
  return it == submaps_.end() ? -1 : it->second;
}

LoopAttempt LoopCloser::detect(const Map& map, KeyframeId newest) {
  LoopAttempt attempt;
  attempt.keyframe = newest;
  const Keyframe* keyframe = map.find(newest);
  if (!keyframe || !keyframe->features) {
    trails_.clear();
    return attempt;
  }
  attempt.timestamp = keyframe->timestamp;
  connect(map, newest);
  std::vector<LoopCandidate> candidates = find_candidates(map, *keyframe, attempt);
  add(map, newest);
  const bool pausing = last_closed_.valid() && newest.value - last_closed_.value <= options_.pause;
  for (LoopCandidate& candidate : candidates) {
    if (candidate.consistency >= options_.consistency && !pausing)
      examine(map, *keyframe, candidate, attempt);
    attempt.candidates.push_back(std::move(candidate));
    if (attempt.closure) break;
  }
  return attempt;
}

void LoopCloser::closed(const LoopClosure& closure) {
  last_closed_ = closure.edge.newer;
  join(closure.edge.newer, closure.edge.older);
  trails_.clear();
}

// What is connected with the keyframe already, or too young.
std::set<KeyframeId> LoopCloser::excluded(const Map& map, KeyframeId newest) const {
  std::set<KeyframeId> out = {newest};
  for (const Covisible& other : map.covisible(newest)) out.insert(other.id);
  int young = 0;
  const auto& keyframes = map.keyframes();
  for (auto it = std::make_reverse_iterator(keyframes.upper_bound(newest));
       it != keyframes.rend() && young < options_.min_gap; ++it, ++young)
    if (connected(it->first, newest)) out.insert(it->first);
  return out;
}

// The likeness that pictures of one place have here and now (Mur-Artal et al. 2015, section VII-A).
double LoopCloser::least_score(const Map& map, const Keyframe& keyframe, const WordVector& words) const {
  double least = 1;
  for (const Covisible& near : map.covisible(keyframe.id, kCloseNeighbour))
    if (const WordVector* other = index_.find(near.id)) least = std::min(least, similarity(words, *other));
  return least < 1 ? options_.min_score_share * least : 0;
}

std::vector<LoopCandidate> LoopCloser::find_candidates(const Map& map, const Keyframe& keyframe,
                                                       LoopAttempt& attempt) {
  const WordVector words = index_.vocabulary().describe(keyframe.features->descriptors);
  attempt.least_score = least_score(map, keyframe, words);
  std::vector<Candidate> alike = index_.query(words, excluded(map, keyframe.id));
  std::erase_if(alike, [&](const Candidate& c) { return c.score < attempt.least_score; });
  std::vector<CandidateGroup> groups = group_candidates(alike, map);
  groups.resize(std::min(groups.size(), static_cast<std::size_t>(options_.candidates)));
  std::vector<LoopCandidate> out;
  std::vector<Trail> trails;
  for (const CandidateGroup& group : groups) {
    Trail trail;
    trail.members.insert(group.members.begin(), group.members.end());
    for (const Covisible& near : map.covisible(group.best)) trail.members.insert(near.id);
    for (const Trail& before : trails_) {
      const bool same = std::any_of(before.members.begin(), before.members.end(),
                                    [&](KeyframeId id) { return trail.members.contains(id); });
      if (same) trail.length = std::max(trail.length, before.length + 1);
    }
    LoopCandidate candidate;
    candidate.keyframe = group.best, candidate.timestamp = map.find(group.best)->timestamp;
    candidate.score = group.score, candidate.consistency = trail.length;
    out.push_back(std::move(candidate));
    trails.push_back(std::move(trail));
  }
  trails_ = std::move(trails);
  return out;
}

void LoopCloser::examine(const Map& map, const Keyframe& keyframe, LoopCandidate& candidate,
                         LoopAttempt& attempt) const {
  const Keyframe& older = *map.find(candidate.keyframe);
  candidate.way = connected(candidate.keyframe, keyframe.id)
                      ? way_between(map, candidate.keyframe, keyframe.id)
                      : std::numeric_limits<double>::infinity();
  candidate.stage = LoopStage::kNoReturn;
  if (candidate.way <
      options_.min_detour * distance_of_centres(older.camera_from_world, keyframe.camera_from_world))
    return;
  const Place place = place_of(map, rig_, candidate.keyframe, verification_.neighbours);
  Verification verified = verify(place, *keyframe.features, rig_, index_.vocabulary(), verification_);
  LoopClosure closure = closure_of(keyframe.id, place, verified);
  verified.pairs.clear();
  candidate.verification = std::move(verified);
  candidate.stage = LoopStage::kNotVerified;
  if (!candidate.verification.accepted()) return;
  candidate.stage = LoopStage::kImplausible;
  if (!is_plausible(map, keyframe, candidate)) return;
  candidate.stage = LoopStage::kNotConfirmed;
  candidate.confirmed = confirm(map, keyframe, place, candidate);
  if (candidate.confirmed < options_.confirmations) return;
  candidate.stage = LoopStage::kAccepted;
  make_precise(map, keyframe, candidate);
  closure.edge.newer_from_older = candidate.verification.newer_from_older;
  closure.covariance = candidate.verification.covariance;
  attempt.closure = std::move(closure);
}

// By the patches of the older side's keyframes, those around the candidate that are not of today.
void LoopCloser::make_precise(const Map& map, const Keyframe& keyframe, LoopCandidate& candidate) const {
  const SE3 older_from_world = map.find(candidate.keyframe)->camera_from_world;
  Verification& verified = candidate.verification;
  const std::vector<KeyframeId> side =
      keyframes_of_place(map, candidate.keyframe, patches_.keyframes, excluded(map, keyframe.id));
  const auto precise = pose_by_patches(map, rig_, pyramid_of(keyframe, rig_, patches_.alignment),
                                       verified.newer_from_older * older_from_world, side, patches_);
  if (!precise) return;
  verified.newer_from_older = (precise->camera_from_world * older_from_world.inverse()).normalized();
  // Where the two sides' depths are of different scale, one of them is wrong, and the translation as well.
  const Eigen::Vector3d off =
      std::hypot(kScaleError, std::log(verified.scale)) * verified.newer_from_older.translation;
  Matrix6d covariance = precise->covariance;
  covariance.topLeftCorner<3, 3>() += off * off.transpose();
  verified.set_covariance(covariance);
  measure_gap(map, keyframe, candidate);
}

// What closing would move by.
void LoopCloser::measure_gap(const Map& map, const Keyframe& keyframe, LoopCandidate& candidate) {
  const Keyframe& older = *map.find(candidate.keyframe);
  const SE3 by_odometry = keyframe.camera_from_world * older.camera_from_world.inverse();
  const SE3& found = candidate.verification.newer_from_older;
  // Of the camera's centres, so that the turn does not count as a way.
  candidate.gap = distance_of_centres(found, by_odometry);
  candidate.turn_gap = degrees(found * by_odometry.inverse());
}

// A wall that repeats itself looks like a loop that is one period off; but odometry does not drift that much.
bool LoopCloser::is_plausible(const Map& map, const Keyframe& keyframe, LoopCandidate& candidate) const {
  measure_gap(map, keyframe, candidate);
  return candidate.gap <= options_.max_drift_floor + options_.max_drift * candidate.way &&
         candidate.turn_gap <= options_.max_turn_drift_floor + options_.max_turn_drift * candidate.way;
}

// How many of the keyframes before find the same motion by themselves, theirs among each other being known.
int LoopCloser::confirm(const Map& map, const Keyframe& keyframe, const Place& place,
                        const LoopCandidate& candidate) const {
  int confirmed = 0, tried = 0;
  for (const Covisible& near : map.covisible(keyframe.id)) {
    const Keyframe& other = *map.find(near.id);
    if (confirmed >= options_.confirmations || tried >= kConfirmersTried * options_.confirmations) break;
    if (!other.features) continue;
    ++tried;
    const Verification verified = verify(place, *other.features, rig_, index_.vocabulary(), verification_);
    if (!verified.accepted()) continue;
    const SE3 expected = other.camera_from_world * keyframe.camera_from_world.inverse() *
                         candidate.verification.newer_from_older;
    const SE3 off = verified.newer_from_older * expected.inverse();
    const double sigma = std::hypot(verified.translation_sigma, candidate.verification.translation_sigma);
    const double distance = distance_of_centres(verified.newer_from_older, expected);
    if (distance <= kAgreementFloor + kAgreementSigmas * sigma && degrees(off) <= kAgreementTurn) ++confirmed;
  }
  return confirmed;
}

}  // namespace spslam
