// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The whole system behind one function: slam.track(timestamp, left, right).
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "spslam/camera/stereo_frame.h"
#include "spslam/camera/stereo_rig.h"
#include "spslam/loop/loop_closer.h"
#include "spslam/map/map.h"
#include "spslam/odometry/track_result.h"
#include "spslam/system/slam_options.h"

namespace spslam {

// A frame's pose as it is known now, after all corrections so far. One for each frame given since the first
// usable one.
struct TrajectoryPose {
  FrameId frame;
  double timestamp = 0;  // s
  TrackStatus status = TrackStatus::kTracking;
  SE3 world_from_camera;
};

// A keyframe as the results list it.
struct KeyframeInfo {
  KeyframeId id;
  FrameId frame;
  double timestamp = 0;
  SE3 world_from_camera;
  int sightings = 0;
};

// What local mapping did with a keyframe.
struct MappingInfo {
  KeyframeId keyframe;
  double seconds = 0;
  int retriangulated = 0, outliers = 0, culled_landmarks = 0, culled_keyframes = 0;
  int iterations = 0;  // of the local bundle adjustment
  double initial_cost = 0, final_cost = 0;
  std::size_t keyframes = 0, landmarks = 0;  // in the map afterwards
  int triangulated = 0, fused = 0;           // landmarks made between keyframes, duplicates that became one
};

class Localizer;
class Stages;

class Slam {
 public:
  // Throws InputError for a rig, OptionError for options that are not usable. map: what is known already, as
  // load_map() gives it; then the first frame is looked for in it, and nothing is tracked until it is found.
  // With options.localization.enabled the map stays as it is: what track() says is where in it the camera is
  // (`lost` until that is known), and what odometry maps on the way is forgotten in the end.
  // Places are recognized by the words of the vocabulary; maps do not depend on it.
  Slam(const StereoRig& rig, const SlamOptions& options = {}, Map map = {},
       const Vocabulary& vocabulary = built_in_vocabulary());
  ~Slam();
  Slam(const Slam&) = delete;
  Slam& operator=(const Slam&) = delete;

  // Frames in order of time, from one thread. A pair that cannot be used (wrong size, no image, a time not
  // after the last one's) gets a status and a reason, not an exception. The result's pose is what is known at
  // this moment; later corrections change the past, which trajectory() has.
  TrackResult track(const StereoFrame& pair);
  TrackResult track(double timestamp, const cv::Mat& left, const cv::Mat& right) {
    return track({timestamp, left, right, ""});
  }

  // Waits until every keyframe so far is in the map. For recordings, whose frames come as fast as they are
  // asked for: what tracking knows of the map then does not depend on how busy the machine is. Not for a
  // camera, whose frames nobody keeps. From the same thread as track().
  void wait_for_map();

  // Ends the input: everything waiting is worked off. Without it the
  // frames of the last window are not in the map. track() must not be called after it.
  void finish();
  // The corrected past; whole only after finish().
  std::vector<TrajectoryPose> trajectory() const;
  std::vector<KeyframeInfo> keyframes() const;
  std::size_t landmark_count() const;
  // One a keyframe that was handed to the mapper, in order.
  std::vector<MappingInfo> mapping() const;
  // What was tried to recognize each of them, in order.
  std::vector<LoopAttempt> loops() const;
  // Writes the map to a file (map_file.h); whole only after finish(). Throws OutputError. While localizing it
  // is the map that was given.
  void save(const std::filesystem::path& path) const;

 private:
  StereoRig rig_;
  std::optional<double> last_timestamp_;  // s
  TrackResult last_;                      // of the last frame that was not left out
  std::unique_ptr<Localizer> localizer_;  // null unless the map is fixed
  std::unique_ptr<Stages> stages_;
};

}  // namespace spslam
