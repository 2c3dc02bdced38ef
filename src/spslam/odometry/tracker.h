// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Visual odometry, the first of the three threads: a pose for each frame, from the landmarks it follows and a
// short window of frames. The window owns the present, the map the past: a keyframe is handed to the mapper
// when it leaves the window.
#pragma once

#include "spslam/base/uncertain_pose.h"
#include "spslam/odometry/active_map.h"
#include "spslam/odometry/far_points.h"
#include "spslam/odometry/frame_problem.h"
#include "spslam/odometry/front_end.h"
#include "spslam/odometry/motion_model.h"
#include "spslam/odometry/stage_timer.h"
#include "spslam/odometry/track_result.h"
#include "spslam/odometry/trial.h"

namespace spslam {

// A frame's pose relative to a keyframe of the map, so that corrections of the map move it too.
struct FramePose {
  FrameId frame;
  double timestamp = 0;  // s
  TrackStatus status = TrackStatus::kTracking;
  KeyframeId reference;
  SE3 camera_from_reference;
};

struct TrackerOutput {
  TrackResult result;
  std::vector<KeyframeProposal> proposals;  // keyframes that left the window
  std::vector<FramePose> settled;           // frames that odometry will not change any more
  std::shared_ptr<const SeenFrame> seen;    // this frame, if set_describe_interval() wants it
};

// Where in the map a frame was taken, by what it looks like. The place is sure; if it is not `precise`, all
// is far there and the pose alone is no beginning.
struct FoundPose {
  UncertainPose pose;
  bool precise = true;
};
// Nothing if it is not surely there.
using Relocalize = std::function<std::optional<FoundPose>(const SeenFrame&)>;

class Tracker {
 public:
  // Throws OptionError or InputError for options or a rig that are not usable.
  Tracker(const StereoRig& rig, const TrackerOptions& options);

  // Frames in order of time. A pair that cannot be used gets a status, not an exception.
  TrackerOutput track(const StereoFrame& pair);
  // Takes over what the mapper has corrected since: poses and inverse depths of what is still followed, and
  // landmarks that should be in sight again.
  void adopt(const LocalMapView& view);
  // What a lost frame is looked for with. must_localize: there is a map already, in which the first frame has
  // to be found; the ids to be given go on behind those of the map.
  void set_relocalizer(Relocalize relocalize) { relocalize_ = std::move(relocalize); }
  void continue_map(KeyframeId next_keyframe, LandmarkId next_landmark);
  // While the mapper is behind, keyframes are made only where points are lost or the motion becomes
  // uncertain.
  void set_mapper_busy(bool busy) { mapper_is_busy_ = busy; }
  // Every so many frames the result tells what the frame looks like, for whoever compares it; 0: never.
  void set_describe_interval(int frames) { describe_interval_ = frames; }
  // Empties the window, at the end of a run.
  TrackerOutput finish();

 private:
  // What became of a frame, kept until it settles.
  struct Unsettled {
    FrameId frame;
    double timestamp;
    TrackStatus status;
    SE3 camera_from_world;  // of frames that are not in the window
    bool in_window;
    bool in_open_gap;  // carried by the last velocity, and nothing has been measured since
  };
  struct SeenByKeyframe {
    LandmarkId landmark;
    Eigen::Vector2f position;
  };

  bool measure_pose(const Frame& frame, TrackResult& result, StageTimer& timer);
  std::vector<Sighting> find_landmarks(const Frame& frame, SE3& predicted, TrackResult& result);
  bool is_sound(const MotionEstimate& motion, const std::vector<Sighting>& sightings,
                TrackResult& result) const;
  SeenFrame see(const Frame& frame);
  void begin(const Frame& frame, TrackResult& result);
  std::optional<UncertainPose> starting_pose(const Frame& frame, TrackResult& result);
  void coast(const std::string& reason, TrackResult& result);
  Matrix6d coasting_covariance(double seconds) const;
  void close_gap(double timestamp, const SE3& measured);
  void finish_frame(TrackerOutput& out);

  KeyframeEvidence evidence(const WindowFrame& present) const;
  void take_corrections(const LocalMapView& view);
  void make_keyframe(const Frame& frame, WindowFrame& present);
  void settle(std::size_t frames_kept, TrackerOutput& out);
  KeyframeProposal propose(const WindowFrame& frame);
  void let_go();
  int let_movers_go();

  TrackerOptions options_;
  FrontEnd front_end_;
  FarPoints far_points_;
  Trials trials_;
  KeyframePolicy policy_;
  MotionModel motion_;
  RigMonitor rig_monitor_;
  int frames_since_rig_check_ = 0, frames_since_movers_ = 0;
  ActiveMap map_;
  TrackStatus status_ = TrackStatus::kInitializing;
  Matrix6d motion_covariance_ =
      Matrix6d::Identity() * 1e-12;  // of the newest frame against the landmarks it saw
  std::int64_t frames_ = 0, keyframes_ = 0, landmarks_ = 0;  // ids given
  bool mapper_is_busy_ = false;
  Relocalize relocalize_;
  bool must_localize_ = false;
  int relocalizations_ = 0;  // tried since the loss
  int describe_interval_ = 0;
  int frames_since_keyframe_ = 0, tracked_before_ = 0;
  SE3 keyframe_pose_;                             // camera_from_world of the last keyframe when it was made
  std::vector<SeenByKeyframe> seen_by_keyframe_;  // ascending
  std::map<LandmarkId, Landmark> retired_;        // no longer followed, but their host is still in the window
  std::deque<Unsettled> unsettled_;
  KeyframeId settled_reference_;           // the last keyframe handed over
  std::map<KeyframeId, SE3> handed_over_;  // camera_from_world of the newest of them, as it is believed here
};

}  // namespace spslam
