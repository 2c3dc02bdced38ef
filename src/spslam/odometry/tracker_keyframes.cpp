// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The tracker's keyframes: when one is made, what it brings, and how it is handed over.

#include "spslam/base/median.h"
#include "spslam/odometry/new_landmarks.h"
#include "spslam/odometry/recall.h"
#include "spslam/odometry/tracker.h"

namespace spslam {
namespace {

constexpr std::size_t kRemembered = 64;  // keyframes; the mapper is never farther behind

}  // namespace

KeyframeEvidence Tracker::evidence(const WindowFrame& present) const {
  KeyframeEvidence out;
  out.mapper_is_busy = mapper_is_busy_;
  out.frames_since_keyframe = frames_since_keyframe_;
  out.tracked = static_cast<int>(present.sightings.size());
  out.tracked_before = tracked_before_;
  out.entropy = differential_entropy(motion_covariance_);
  out.rotation =
      so3_log(present.camera_from_world.rotation * keyframe_pose_.rotation.transpose()).norm() * 180 / M_PI;
  std::vector<double> motions;
  for (const Sighting& s : present.sightings) {
    const auto it = std::lower_bound(seen_by_keyframe_.begin(), seen_by_keyframe_.end(), s.landmark,
                                     [](const SeenByKeyframe& a, LandmarkId b) { return a.landmark < b; });
    if (it != seen_by_keyframe_.end() && it->landmark == s.landmark)
      motions.push_back((s.measured.head<2>().cast<float>() - it->position).norm());
  }
  out.share_of_keyframe = seen_by_keyframe_.empty() ? 1
                                                    : static_cast<double>(motions.size()) /
                                                          static_cast<double>(seen_by_keyframe_.size());
  out.parallax = median(std::move(motions));
  return out;
}

void Tracker::make_keyframe(const Frame& frame, WindowFrame& present) {
  present.keyframe = {keyframes_++};
  map_.hosts[present.keyframe] = {present.keyframe, present.id, present.timestamp, present.camera_from_world,
                                  frame.left};
  for (NewLandmark& fresh : find_new_landmarks(map_, frame, present.sightings, front_end_, options_)) {
    fresh.landmark.id = fresh.sighting.landmark = {landmarks_++};
    fresh.landmark.host = present.keyframe;
    present.sightings.push_back(fresh.sighting);
    map_.landmarks.push_back({fresh.landmark, fresh.landmark.inverse_depth});
  }
  // Landmarks that the mapper made have ids beyond the tracker's own.
  std::sort(map_.landmarks.begin(), map_.landmarks.end(),
            [](const ActiveLandmark& a, const ActiveLandmark& b) { return a.landmark.id < b.landmark.id; });
  std::sort(present.sightings.begin(), present.sightings.end(),
            [](const Sighting& a, const Sighting& b) { return a.landmark < b.landmark; });
  frames_since_keyframe_ = 0;
  keyframe_pose_ = present.camera_from_world;
  seen_by_keyframe_.clear();
  for (const Sighting& s : present.sightings)
    seen_by_keyframe_.push_back({s.landmark, s.measured.head<2>().cast<float>()});
}

// Landmarks not found in the newest frame are missed; those missed too often retire, to be handed over with
// their host unless they were on trial.
void Tracker::let_go() {
  for (ActiveLandmark& active : map_.landmarks) ++active.missed;
  for (const Sighting& s : map_.window.back().sightings)
    if (const int i = map_.index_of(s.landmark); i >= 0) map_.landmarks[i].missed = 0;
  trials_.judge(map_, options_.follow.max_missed);
  for (const ActiveLandmark& active : map_.landmarks)
    if (active.missed > options_.follow.max_missed && !active.on_trial)
      retired_[active.landmark.id] = active.landmark;
  forget(map_, options_.follow.max_missed);
}

// Those that move by themselves go at once, with all that was seen of them, and the window is solved without.
int Tracker::let_movers_go() {
  if (!options_.movers.enabled || ++frames_since_movers_ < options_.movers.interval) return 0;
  frames_since_movers_ = 0;
  const std::vector<int> movers = find_movers(map_, options_.movers);
  for (const int i : movers) {
    trials_.refute(map_.rig, options_.follow.max_missed, map_.landmarks[i]);
    map_.moving.insert(map_.landmarks[i].landmark.id);
  }
  if (movers.empty()) return 0;
  for (WindowFrame& frame : map_.window)
    std::erase_if(frame.sightings, [&](const Sighting& s) { return map_.moving.contains(s.landmark); });
  refine_window(map_, options_.window);
  return static_cast<int>(movers.size());
}

void Tracker::settle(std::size_t frames_kept, TrackerOutput& out) {
  while (!unsettled_.empty()) {
    const Unsettled& oldest = unsettled_.front();
    if (oldest.in_window ? map_.window.size() <= frames_kept : oldest.in_open_gap) break;
    SE3 pose = oldest.camera_from_world;
    if (oldest.in_window) {
      const WindowFrame& frame = map_.window.front();
      pose = frame.camera_from_world;
      if (frame.keyframe.valid()) {
        out.proposals.push_back(propose(frame));
        settled_reference_ = frame.keyframe;
        handed_over_[settled_reference_] = pose;
        if (handed_over_.size() > kRemembered) handed_over_.erase(handed_over_.begin());
      }
      shorten_window(map_, static_cast<int>(map_.window.size()) - 1, options_.window);
    }
    out.settled.push_back({oldest.frame, oldest.timestamp, oldest.status, settled_reference_,
                           pose * handed_over_[settled_reference_].inverse()});
    unsettled_.pop_front();
  }
}

KeyframeProposal Tracker::propose(const WindowFrame& frame) {
  KeyframeProposal proposal;
  proposal.keyframe = map_.hosts.at(frame.keyframe);
  proposal.keyframe.sightings = frame.sightings;
  for (Sighting& s : proposal.keyframe.sightings)
    s.measured.z() -= map_.disparity_offset.at(map_.rig, s.measured.x(), s.measured.y());
  for (const Sighting& s : frame.sightings) {
    const int i = map_.index_of(s.landmark);
    const auto retired = retired_.find(s.landmark);
    if (i < 0 ? retired == retired_.end() : map_.landmarks[i].on_trial) continue;
    const Landmark& landmark = i >= 0 ? map_.landmarks[i].landmark : retired->second;
    (landmark.host == frame.keyframe ? proposal.new_landmarks : proposal.known_landmarks).push_back(landmark);
  }
  proposal.moving_landmarks.assign(map_.moving.begin(), map_.moving.end());
  map_.moving.clear();
  proposal.previous = settled_reference_;
  proposal.camera_from_previous = frame.camera_from_world * handed_over_[settled_reference_].inverse();
  std::erase_if(retired_, [&](const auto& entry) { return entry.second.host <= frame.keyframe; });
  return proposal;
}

TrackerOutput Tracker::finish() {
  TrackerOutput out;
  for (Unsettled& frame : unsettled_) frame.in_open_gap = false;
  settle(0, out);
  return out;
}

void Tracker::adopt(const LocalMapView& view) {
  if (view.corrected) take_corrections(view);
  if (options_.recall.enabled && status_ == TrackStatus::kTracking)
    recall(view, motion_.last_pose(), options_, map_);
}

void Tracker::take_corrections(const LocalMapView& view) {
  // The window moves rigidly with the newest keyframe that the mapper knows, and everything that hangs on it.
  SE3 old_from_world;
  for (const Keyframe& keyframe : view.keyframes)
    if (const auto known = handed_over_.find(keyframe.id); known != handed_over_.end())
      old_from_world = known->second.inverse() * keyframe.camera_from_world;  // the newest one's stays
  for (auto& [id, pose] : handed_over_) pose = pose * old_from_world;
  for (const Keyframe& keyframe : view.keyframes)
    if (const auto known = handed_over_.find(keyframe.id); known != handed_over_.end())
      known->second = keyframe.camera_from_world;
  for (auto& [id, host] : map_.hosts) host.camera_from_world = host.camera_from_world * old_from_world;
  for (const Keyframe& keyframe : view.keyframes)
    if (const auto host = map_.hosts.find(keyframe.id); host != map_.hosts.end())
      host->second.camera_from_world = keyframe.camera_from_world;
  for (WindowFrame& frame : map_.window) {
    frame.camera_from_world = frame.camera_from_world * old_from_world;
    if (frame.keyframe.valid()) map_.hosts.at(frame.keyframe).camera_from_world = frame.camera_from_world;
  }
  for (Unsettled& frame : unsettled_) frame.camera_from_world = frame.camera_from_world * old_from_world;
  keyframe_pose_ = keyframe_pose_ * old_from_world;
  motion_.correct(motion_.last_pose() * old_from_world);
  for (const Landmark& landmark : view.landmarks)
    if (const int i = map_.index_of(landmark.id); i >= 0) {
      ActiveLandmark& active = map_.landmarks[i];
      // Culling has given it another host: that one's inverse depth is not ours.
      if (active.landmark.host != landmark.host) continue;
      active.landmark.inverse_depth = landmark.inverse_depth;
      active.prior_inverse_depth = landmark.inverse_depth;
    }
}

}  // namespace spslam
