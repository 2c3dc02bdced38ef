// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/map/map.h"

#include <stdexcept>

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

}  // namespace

void Map::add(Keyframe keyframe) {
  insert(keyframes_, std::move(keyframe), "keyframe");
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

}  // namespace spslam
