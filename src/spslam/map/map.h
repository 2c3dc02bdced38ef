// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The map: owner of keyframes and landmarks, by id, with the covisibility graph, the spanning tree and the
// loop edges. Written by the local mapper alone.
#pragma once

#include <map>
#include <optional>

#include "spslam/map/types.h"

namespace spslam {

// A keyframe that sees some of the same landmarks, and how many.
struct Covisible {
  KeyframeId id;
  int shared = 0;
  friend bool operator==(const Covisible&, const Covisible&) = default;
};

class Map {
 public:
  // Throws std::invalid_argument if the id is taken or not valid. A keyframe's parent in the spanning tree is
  // the one it shares most landmarks with, or the newest one if it shares none, unless it comes with one.
  // Sightings that are not finite, or of landmarks that are not there, are left out.
  void add(Keyframe keyframe);
  void add(Landmark landmark);
  // Takes the landmark out of the keyframes that saw it, too.
  void erase(LandmarkId id);
  // The landmarks that it hosts move to the next keyframe that saw them, or go with it; its children in the
  // spanning tree go to its parent; its loop edges go. The root of the tree stays: false.
  bool erase(KeyframeId id);

  const Keyframe* find(KeyframeId id) const;  // null if there is none (any more)
  // Where a keyframe is, or would be now had it not been erased: it stays where it was in its parent's
  // camera. Nothing for one that never was.
  std::optional<SE3> camera_from_world(KeyframeId id) const;
  // The landmark that this one was fused into, in any number of steps; itself if it was not.
  LandmarkId resolve(LandmarkId id) const;
  const Landmark* find(LandmarkId id) const;
  // The keyframes that saw a landmark, ascending.
  const std::vector<KeyframeId>& observers(LandmarkId id) const;
  // Those that share at least `least` landmarks with it: most first, then by id.
  std::vector<Covisible> covisible(KeyframeId id, int least = 1) const;

  // Replaces the estimate of one that is still there; false if it is gone.
  bool set_pose(KeyframeId id, const SE3& camera_from_world);
  bool set_estimate(LandmarkId id, double inverse_depth, double information);
  bool set_features(KeyframeId id, std::shared_ptr<const KeyframeFeatures> features);
  bool set_image(KeyframeId id, std::shared_ptr<const ImageBytes> image);
  // Takes over what another says of a landmark that is still there and still hosted by the same keyframe.
  bool update(const Landmark& landmark);
  // Lets go of the keyframe's pyramid.
  void drop_pyramid(KeyframeId id);
  // Adds what a keyframe saw, or replaces it; false if the keyframe or the landmark is gone.
  bool set_sighting(KeyframeId id, const Sighting& sighting);
  void erase_sighting(KeyframeId id, LandmarkId landmark);
  // `gone` was `kept` all along: who saw it saw `kept`, if not quite at the same place (kFusedSigma). A
  // keyframe that saw both keeps what it saw of `kept`. Sightings of `gone` that come later count for `kept`.
  void fuse(LandmarkId kept, LandmarkId gone);
  void add(const LoopEdge& edge) { loops_.push_back(edge); }

  const std::map<KeyframeId, Keyframe>& keyframes() const { return keyframes_; }
  const std::map<LandmarkId, Landmark>& landmarks() const { return landmarks_; }
  const std::vector<LoopEdge>& loops() const { return loops_; }

 private:
  bool move_to_next_host(const Landmark& landmark, KeyframeId from);

  std::map<KeyframeId, Keyframe> keyframes_;
  std::map<LandmarkId, Landmark> landmarks_;
  std::map<LandmarkId, std::vector<KeyframeId>> observers_;
  std::vector<LoopEdge> loops_;
  struct Erased {
    KeyframeId parent;
    SE3 camera_from_parent;
  };
  std::map<KeyframeId, Erased> erased_;
  std::map<LandmarkId, LandmarkId> fused_into_;
};

// Corners of the same thing found at different times lie that far apart (px): they are whole pixels.
inline constexpr double kFusedSigma = 0.7;
Sighting as_seen_of(LandmarkId kept, Sighting sighting);

// The sighting of a landmark, or null.
const Sighting* find_sighting(const Keyframe& keyframe, LandmarkId landmark);

}  // namespace spslam
