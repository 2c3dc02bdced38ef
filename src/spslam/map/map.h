// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The map: owner of keyframes and landmarks, by id. Written by the local mapper alone.
#pragma once

#include <map>

#include "spslam/map/types.h"

namespace spslam {

class Map {
 public:
  // Throws std::invalid_argument if the id is taken or not valid.
  void add(Keyframe keyframe);
  void add(Landmark landmark);
  void erase(KeyframeId id) { keyframes_.erase(id); }
  void erase(LandmarkId id) { landmarks_.erase(id); }

  const Keyframe* find(KeyframeId id) const;  // null if there is none (any more)
  const Landmark* find(LandmarkId id) const;
  // Replaces the estimate of one that is still there; false if it is gone.
  bool set_pose(KeyframeId id, const SE3& camera_from_world);
  bool set_estimate(LandmarkId id, double inverse_depth, double information);

  const std::map<KeyframeId, Keyframe>& keyframes() const { return keyframes_; }
  const std::map<LandmarkId, Landmark>& landmarks() const { return landmarks_; }

 private:
  std::map<KeyframeId, Keyframe> keyframes_;
  std::map<LandmarkId, Landmark> landmarks_;
};

}  // namespace spslam
