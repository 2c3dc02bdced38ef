// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/map/map.h"

#include <algorithm>
#include <stdexcept>

#include "spslam/map/moved_point.h"

namespace spslam {
namespace {

template <class Id, class Value>
void insert(std::map<Id, Value>& all, Value value, const char* what) {
  const Id id = value.id;
  if (!id.valid() || !all.emplace(id, std::move(value)).second)
    throw std::invalid_argument(std::string(what) + " " + std::to_string(id.value) +
                                ": the id is not valid or taken");
}

template <class Id, class Value>
const Value* look_up(const std::map<Id, Value>& all, Id id) {
  const auto it = all.find(id);
  return it == all.end() ? nullptr : &it->second;
}

template <class Sightings>
auto place_of(Sightings& sightings, LandmarkId id) {
  return std::lower_bound(sightings.begin(), sightings.end(), id,
                          [](const Sighting& a, LandmarkId b) { return a.landmark < b; });
}

void insert_sorted(std::vector<KeyframeId>& ids, KeyframeId id) {
  const auto at = std::lower_bound(ids.begin(), ids.end(), id);
  if (at == ids.end() || *at != id) ids.insert(at, id);
}

}  // namespace

void Map::add(Keyframe keyframe) {
  for (Sighting& sighting : keyframe.sightings)
    if (const LandmarkId kept = resolve(sighting.landmark); kept != sighting.landmark)
      sighting = as_seen_of(kept, sighting);
  std::stable_sort(keyframe.sightings.begin(), keyframe.sightings.end(),
                   [](const Sighting& a, const Sighting& b) { return a.landmark < b.landmark; });
  std::erase_if(keyframe.sightings, [](const Sighting& s) { return !s.measured.allFinite(); });
  const auto same = [](const Sighting& a, const Sighting& b) { return a.landmark == b.landmark; };
  keyframe.sightings.erase(std::unique(keyframe.sightings.begin(), keyframe.sightings.end(), same),
                           keyframe.sightings.end());
  std::erase_if(keyframe.sightings, [&](const Sighting& s) { return !landmarks_.contains(s.landmark); });
  const KeyframeId id = keyframe.id;
  const bool has_parent = keyframe.parent.valid();
  const KeyframeId newest = keyframes_.empty() ? KeyframeId{} : keyframes_.rbegin()->first;
  insert(keyframes_, std::move(keyframe), "keyframe");
  Keyframe& added = keyframes_.at(id);
  for (const Sighting& sighting : added.sightings) insert_sorted(observers_[sighting.landmark], id);
  if (has_parent) return;
  const std::vector<Covisible> neighbours = covisible(id);
  added.parent = neighbours.empty() ? newest : neighbours.front().id;
}

void Map::add(Landmark landmark) {
  insert(landmarks_, std::move(landmark), "landmark");
}

const Keyframe* Map::find(KeyframeId id) const {
  return look_up(keyframes_, id);
}
const Landmark* Map::find(LandmarkId id) const {
  return look_up(landmarks_, id);
}

std::optional<SE3> Map::camera_from_world(KeyframeId id) const {
  SE3 camera_from_ancestor;
  for (const Keyframe* keyframe = find(id); !keyframe; keyframe = find(id)) {
    const Erased* erased = look_up(erased_, id);
    if (!erased) return std::nullopt;
    camera_from_ancestor = camera_from_ancestor * erased->camera_from_parent;
    id = erased->parent;
  }
  return camera_from_ancestor * find(id)->camera_from_world;
}

LandmarkId Map::resolve(LandmarkId id) const {
  while (const LandmarkId* next = look_up(fused_into_, id)) id = *next;
  return id;
}

const std::vector<KeyframeId>& Map::observers(LandmarkId id) const {
  static const std::vector<KeyframeId> kNone;
  const std::vector<KeyframeId>* found = look_up(observers_, id);
  return found ? *found : kNone;
}

std::vector<Covisible> Map::covisible(KeyframeId id, int least) const {
  std::map<KeyframeId, int> shared;
  if (const Keyframe* keyframe = find(id))
    for (const Sighting& sighting : keyframe->sightings)
      for (const KeyframeId other : observers(sighting.landmark)) shared[other] += other != id;
  std::vector<Covisible> out;
  for (const auto& [other, count] : shared)
    if (other != id && count >= std::max(1, least)) out.push_back({other, count});
  std::stable_sort(out.begin(), out.end(),
                   [](const Covisible& a, const Covisible& b) { return a.shared > b.shared; });
  return out;
}

void Map::erase(LandmarkId id) {
  for (const KeyframeId observer : std::vector(observers(id))) erase_sighting(observer, id);
  observers_.erase(id);
  landmarks_.erase(id);
}

bool Map::erase(KeyframeId id) {
  const auto it = keyframes_.find(id);
  if (it == keyframes_.end() || !it->second.parent.valid()) return false;
  std::vector<LandmarkId> orphans;
  for (const auto& [landmark_id, landmark] : landmarks_)
    if (landmark.host == id && !move_to_next_host(landmark, id)) orphans.push_back(landmark_id);
  for (const LandmarkId orphan : orphans) erase(orphan);
  for (const Sighting& sighting : it->second.sightings) std::erase(observers_.at(sighting.landmark), id);
  const KeyframeId parent = it->second.parent;
  erased_[id] = {parent, it->second.camera_from_world * find(parent)->camera_from_world.inverse()};
  for (auto& [other_id, other] : keyframes_)
    if (other.parent == id) other.parent = it->second.parent;
  std::erase_if(loops_, [&](const LoopEdge& edge) { return edge.older == id || edge.newer == id; });
  keyframes_.erase(it);
  return true;
}

// The point stays where it is, in the camera of another keyframe that saw it. False if there is none, or only
// one that would have it behind itself.
bool Map::move_to_next_host(const Landmark& landmark, KeyframeId from) {
  const Keyframe& old_host = keyframes_.at(from);
  for (const KeyframeId id : observers(landmark.id)) {
    if (id == from) continue;
    const Keyframe& host = keyframes_.at(id);
    const Sighting& sighting = *find_sighting(host, landmark.id);
    const SE3 motion = host.camera_from_world * old_host.camera_from_world.inverse();
    const MovedPoint point = move_point(motion, landmark.bearing, landmark.inverse_depth);
    const MovedPoint stereo = move_point(motion, landmark.bearing, landmark.stereo_inverse_depth);
    if (!(point.depth_ratio > 1e-3) || sighting.inverse_sigma.x() <= 0) continue;
    Landmark& moved = landmarks_.at(landmark.id);
    moved.host = id;
    moved.pixel = sighting.measured.head<2>().cast<float>();
    moved.bearing = point.bearing;
    moved.inverse_depth = point.inverse_depth;
    moved.information *= point.information_gain;
    moved.stereo_inverse_depth = stereo.inverse_depth;
    moved.stereo_information *= stereo.depth_ratio > 1e-3 ? stereo.information_gain : 0;
    return true;
  }
  return false;
}

bool Map::set_pose(KeyframeId id, const SE3& camera_from_world) {
  const auto it = keyframes_.find(id);
  if (it == keyframes_.end()) return false;
  it->second.camera_from_world = camera_from_world;
  return true;
}

bool Map::set_estimate(LandmarkId id, double inverse_depth, double information) {
  const auto it = landmarks_.find(id);
  if (it == landmarks_.end()) return false;
  it->second.inverse_depth = inverse_depth;
  it->second.information = information;
  return true;
}

bool Map::set_features(KeyframeId id, std::shared_ptr<const KeyframeFeatures> features) {
  const auto it = keyframes_.find(id);
  if (it == keyframes_.end()) return false;
  it->second.features = std::move(features);
  return true;
}

bool Map::set_image(KeyframeId id, std::shared_ptr<const ImageBytes> image) {
  const auto it = keyframes_.find(id);
  if (it == keyframes_.end()) return false;
  it->second.image = std::move(image);
  return true;
}

bool Map::update(const Landmark& landmark) {
  const auto it = landmarks_.find(landmark.id);
  if (it == landmarks_.end() || it->second.host != landmark.host) return false;
  it->second.inverse_depth = landmark.inverse_depth;
  it->second.information = landmark.information;
  it->second.stereo_inverse_depth = landmark.stereo_inverse_depth;
  it->second.stereo_information = landmark.stereo_information;
  return true;
}

void Map::drop_pyramid(KeyframeId id) {
  if (const auto it = keyframes_.find(id); it != keyframes_.end()) it->second.left = {};
}

bool Map::set_sighting(KeyframeId id, const Sighting& sighting) {
  const auto it = keyframes_.find(id);
  if (it == keyframes_.end() || !landmarks_.contains(sighting.landmark)) return false;
  std::vector<Sighting>& sightings = it->second.sightings;
  const auto at = place_of(sightings, sighting.landmark);
  if (at != sightings.end() && at->landmark == sighting.landmark)
    *at = sighting;
  else
    sightings.insert(at, sighting);
  insert_sorted(observers_[sighting.landmark], id);
  return true;
}

void Map::erase_sighting(KeyframeId id, LandmarkId landmark) {
  const auto it = keyframes_.find(id);
  if (it == keyframes_.end()) return;
  std::vector<Sighting>& sightings = it->second.sightings;
  const auto at = place_of(sightings, landmark);
  if (at == sightings.end() || at->landmark != landmark) return;
  sightings.erase(at);
  std::erase(observers_.at(landmark), id);
}

void Map::fuse(LandmarkId kept, LandmarkId gone) {
  if (kept == gone || !find(kept) || !find(gone)) return;
  for (const KeyframeId observer : std::vector(observers(gone))) {
    const Sighting& sighting = *find_sighting(keyframes_.at(observer), gone);
    if (!find_sighting(keyframes_.at(observer), kept)) set_sighting(observer, as_seen_of(kept, sighting));
  }
  erase(gone);
  fused_into_[gone] = kept;
}

Sighting as_seen_of(LandmarkId kept, Sighting sighting) {
  sighting.landmark = kept;
  // A host's own sighting is a disparity alone, for its position is the bearing itself; of `kept` it is both.
  const double sigma = sighting.inverse_sigma.x() > 0 ? 1 / sighting.inverse_sigma.x() : 0;
  sighting.inverse_sigma.head<2>().setConstant(1 / std::hypot(sigma, kFusedSigma));
  return sighting;
}

const Sighting* find_sighting(const Keyframe& keyframe, LandmarkId landmark) {
  const auto at = place_of(keyframe.sightings, landmark);
  return at != keyframe.sightings.end() && at->landmark == landmark ? &*at : nullptr;
}

}  // namespace spslam
