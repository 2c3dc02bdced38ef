// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// What the tracker keeps: the landmarks it follows, their host keyframes, and a short window of frames.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <vector>

#include "spslam/map/types.h"
#include "spslam/optimize/problem.h"

namespace spslam {

// What the frames after its host's said of a new landmark (trial.h).
enum class Verdict : std::uint8_t { kOpen, kProven, kRefuted };

struct ActiveLandmark {
  Landmark landmark;
  // What frames that have left the window said of the inverse depth.
  double prior_inverse_depth = 0, prior_information = 0;
  int missed = 0;  // usable frames in a row in which it was not found
  Verdict verdict = Verdict::kOpen;
  bool on_trial = false;          // says nothing of the motion before it is proven
  int agreed = 0, disagreed = 0;  // sightings, while the verdict is open
};

struct WindowFrame {
  FrameId id;
  double timestamp = 0;  // s
  SE3 camera_from_world;
  KeyframeId keyframe;  // not valid if it is none
  std::vector<Sighting> sightings;
};

struct ActiveMap {
  StereoRig rig;
  DisparityOffset disparity_offset;
  std::map<KeyframeId, Keyframe> hosts;   // of the landmarks, and of the window's keyframes
  std::vector<ActiveLandmark> landmarks;  // ascending ids
  std::deque<WindowFrame> window;         // ascending time
  std::set<LandmarkId> moving = {};       // found to move by themselves; the mapper has not been told yet

  // Index of a landmark, or -1.
  int index_of(LandmarkId id) const;
};

// Of a sighting in a frame at camera_from_world, the rig's offset counted in.
Linearized linearize(const ActiveMap& map, const Landmark& landmark, const SE3& camera_from_world,
                     const Sighting& sighting);

// Frames beyond the first `frames` of the window leave it; what they said of inverse depths stays as the
// landmarks' prior.
void shorten_window(ActiveMap& map, int frames, const SolverOptions& options);

// Sets each landmark's information to what its prior and the window's sightings say of it.
void update_information(ActiveMap& map, const SolverOptions& options);

// Lets go of landmarks missed more than `limit` times, and of hosts that nothing needs any more.
void forget(ActiveMap& map, int limit);

}  // namespace spslam
