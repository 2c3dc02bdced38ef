// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/system/slam.h"

#include <chrono>
#include <cmath>
#include <mutex>
#include <thread>

#include "spslam/odometry/tracker.h"
#include "spslam/system/bounded_queue.h"

namespace spslam {

struct Slam::Stages {
  Stages(const StereoRig& rig, const SlamOptions& slam_options)
      : options(slam_options),
        tracker(rig, options.tracker),
        mapper(rig, options.tracker.orb, options.mapper) {
    if (options.threads == Threads::kParallel) mapping = std::thread([this] { map_keyframes(); });
  }
  ~Stages() { stop(); }

  void stop() {
    proposals.close();
    if (mapping.joinable()) mapping.join();
  }
  // The mapper's thread.
  void map_keyframes() {
    while (auto proposal = proposals.pop()) insert(std::move(*proposal));
  }
  void insert(KeyframeProposal proposal) {
    const auto start = std::chrono::steady_clock::now();
    const std::scoped_lock lock(map_mutex);
    MappingResult done = mapper.insert(std::move(proposal), [this] { return !proposals.empty(); });
    log.push_back(
        {done.keyframe, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
         done.retriangulated, done.outliers, done.culled_landmarks, static_cast<int>(done.culled.size()),
         done.adjustment.iterations, done.adjustment.initial_cost, done.adjustment.final_cost,
         mapper.map().keyframes().size(), mapper.map().landmarks().size()});
    const std::scoped_lock view_lock(view_mutex);
    view = std::move(done.view);
  }
  LocalMapView take_view() {
    const std::scoped_lock lock(view_mutex);
    return std::exchange(view, {});
  }
  void take(TrackerOutput& output) {
    settled.insert(settled.end(), output.settled.begin(), output.settled.end());
    for (KeyframeProposal& proposal : output.proposals) {
      if (options.threads == Threads::kSequential)
        insert(std::move(proposal));
      else
        proposals.push(std::move(proposal));
    }
  }

  SlamOptions options;
  Tracker tracker;
  bool has_frame = false;
  double last_timestamp = 0;
  bool finished = false;
  BoundedQueue<KeyframeProposal> proposals{8};
  std::vector<FramePose> settled;  // of the caller's thread
  mutable std::mutex map_mutex;    // guards what follows
  LocalMapper mapper;
  std::vector<MappingInfo> log;
  std::mutex view_mutex;  // guards the view, so that the tracker never waits for the mapper
  LocalMapView view;
  std::thread mapping;  // last: it uses all of the above
};

Slam::Slam(const StereoRig& rig, const SlamOptions& options) {
  check_options(options);
  stages_ = std::make_unique<Stages>(rig, options);
}

Slam::~Slam() = default;

TrackResult Slam::track(const StereoFrame& pair) {
  if (!std::isfinite(pair.timestamp) || (stages_->has_frame && pair.timestamp <= stages_->last_timestamp)) {
    TrackResult refused;
    refused.timestamp = pair.timestamp;
    refused.reason =
        "time " + std::to_string(pair.timestamp) + " s is not after the last frame's; the frame is left out";
    return refused;
  }
  stages_->has_frame = true;
  stages_->last_timestamp = pair.timestamp;
  if (const LocalMapView view = stages_->take_view(); view.revision > 0) stages_->tracker.adopt(view);
  stages_->tracker.set_mapper_busy(!stages_->proposals.empty());
  TrackerOutput output = stages_->tracker.track(pair);
  stages_->take(output);
  return output.result;
}

void Slam::finish() {
  if (std::exchange(stages_->finished, true)) return;
  TrackerOutput rest = stages_->tracker.finish();
  stages_->take(rest);
  stages_->stop();
}

std::vector<TrajectoryPose> Slam::trajectory() const {
  const std::scoped_lock lock(stages_->map_mutex);
  std::vector<TrajectoryPose> out;
  for (const FramePose& frame : stages_->settled)
    if (const auto reference = stages_->mapper.map().camera_from_world(frame.reference))
      out.push_back(
          {frame.frame, frame.timestamp, frame.status, (frame.camera_from_reference * *reference).inverse()});
  return out;
}

std::vector<KeyframeInfo> Slam::keyframes() const {
  const std::scoped_lock lock(stages_->map_mutex);
  std::vector<KeyframeInfo> out;
  for (const auto& [id, keyframe] : stages_->mapper.map().keyframes())
    out.push_back({id, keyframe.frame, keyframe.timestamp, keyframe.camera_from_world.inverse(),
                   static_cast<int>(keyframe.sightings.size())});
  return out;
}

std::size_t Slam::landmark_count() const {
  const std::scoped_lock lock(stages_->map_mutex);
  return stages_->mapper.map().landmarks().size();
}

std::vector<MappingInfo> Slam::mapping() const {
  const std::scoped_lock lock(stages_->map_mutex);
  return stages_->log;
}

}  // namespace spslam
