// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Localization in a map that stays as it is (SPEC part 8). Odometry with its local mapping runs in a world of
// its own, the session; every few frames a place of the map is recognized, and a filter (localization.h) says
// where in the map the camera is; in the end all that was recognized is smoothed into one trajectory. Nothing
// that odometry does can harm the map, and nothing in the map can bend odometry.
#pragma once

#include <mutex>

#include "spslam/odometry/tracker.h"
#include "spslam/system/bounded_queue.h"
#include "spslam/system/slam.h"
#include "spslam/system/worker.h"

namespace spslam {

class Localizer {
 public:
  // Throws OptionError for a map without keyframes.
  Localizer(const StereoRig& rig, const SlamOptions& options, Map map, const Vocabulary& vocabulary);
  ~Localizer() { stop(); }
  Localizer(const Localizer&) = delete;
  Localizer& operator=(const Localizer&) = delete;

  // What odometry says of a frame becomes what is known of it in the map. Frames in order. Its covariance is
  // that of the pose in the map.
  TrackResult place(const TrackerOutput& odometry);
  // session: the frames as odometry and its mapping have corrected them in the end; those that it lacks stay
  // as they were tracked.
  void finish(const std::vector<TrajectoryPose>& session);

  // Frames whose pose in the map is known; those before the camera was found too, by odometry backwards.
  // After finish() smoothed: each by what was recognized before and after it.
  std::vector<TrajectoryPose> trajectory() const;
  const Map& map() const { return map_; }

 private:
  static constexpr int kLost = -1;
  struct PlacedFrame {
    FrameId frame;
    double timestamp = 0;
    TrackStatus status = TrackStatus::kLost;
    SE3 camera_from_session;
    int stretch = kLost;  // of unbroken odometry
    int piece = kLost;    // of a stretch: frames whose pose in the map is known, until it is found anew
    std::optional<SE3> camera_from_world;
  };
  struct Request {
    std::size_t index = 0;  // of the frame
    std::shared_ptr<const SeenFrame> frame;
    std::optional<SE3> expected;  // camera_from_world
  };
  struct Answer {
    std::size_t index = 0;
    UncertainPose pose;
    bool precise = true;
  };

  void ask(std::shared_ptr<const SeenFrame> frame);
  std::optional<Answer> look(const Request& request) const;
  void stop();
  void take_answers();
  void take(const Answer& answer);
  void place_backwards();
  void take_over(const std::vector<TrajectoryPose>& session);
  void smooth_pieces();

  StereoRig rig_;
  SlamOptions options_;
  const Map map_;
  KeyframeIndex index_;
  LocalizationFilter filter_;
  std::vector<PlacedFrame> frames_;
  std::vector<SeenPlace> used_, unused_;
  int stretch_ = 0, pieces_ = 0;
  bool is_finished_ = false;
  BoundedQueue<Request> requests_{1};
  std::mutex answers_mutex_;  // guards the answers
  std::vector<Answer> answers_;
  Worker worker_;  // last: it uses all of the above
};

}  // namespace spslam
