// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The stages behind Slam: the tracker in the caller's thread, local mapping and loop closing in one each, or
// all in order in the caller's. Values go down through bounded queues; what comes back is a view.
#pragma once

#include <mutex>

#include "spslam/loop/loop_closer.h"
#include "spslam/mapping/local_mapper.h"
#include "spslam/odometry/tracker.h"
#include "spslam/system/bounded_queue.h"
#include "spslam/system/slam.h"
#include "spslam/system/worker.h"

namespace spslam {

class Stages {
 public:
  Stages(const StereoRig& rig, const SlamOptions& options, Map map, const Vocabulary& vocabulary);
  ~Stages() { stop(); }
  Stages(const Stages&) = delete;
  Stages& operator=(const Stages&) = delete;

  // Frames in order of time. The output has no keyframes any more: they are on their way. This, the waiting
  // and the end throw what a thread has failed with, such as std::bad_alloc.
  TrackerOutput track(const StereoFrame& pair);
  // See Slam::wait_for_map().
  void wait_for_map();
  // Ends the input and works off what waits. Nothing may be tracked afterwards.
  void finish();

  // Reads the map, while nobody writes to it.
  template <class F>
  auto read(F f) const {
    const std::scoped_lock lock(map_mutex_);
    return f(mapper_.map());
  }
  const std::vector<FramePose>& settled() const { return settled_; }  // from the caller's thread
  std::vector<MappingInfo> mapping_log() const;
  std::vector<LoopAttempt> loop_log() const;

 private:
  void start_threads();
  void rethrow_failure() const;
  void adopt_view();
  void take(TrackerOutput& output);
  void insert(KeyframeProposal proposal);
  void close_loop(KeyframeId id);
  void write(MapCorrection correction);
  void publish(LocalMapView view);
  void publish_mapped(LocalMapView view);  // of a keyframe that was on its way
  std::optional<FoundPose> relocalize(const SeenFrame& frame);
  void stop();

  // One that waits is the rule when tracking runs as fast as it can, and is worth an adjustment done in full.
  bool mapper_is_behind() const { return proposals_.size() > 1; }
  bool is_parallel() const { return options_.threads == Threads::kParallel; }

  StereoRig rig_;
  SlamOptions options_;
  Tracker tracker_;
  bool is_finished_ = false;
  std::vector<FramePose> settled_;
  BoundedQueue<KeyframeProposal> proposals_{4};
  BoundedQueue<KeyframeId> described_{64};
  mutable std::mutex map_mutex_;  // guards what follows
  LocalMapper mapper_;
  LoopCloser closer_;
  std::vector<MappingInfo> mapping_log_;
  std::vector<LoopAttempt> loop_log_;
  std::mutex view_mutex_;  // guards what follows, so that track() never waits for the mapper
  LocalMapView view_;
  int unmapped_ = 0;                // keyframes on their way into the map
  std::condition_variable mapped_;  // none is, or none will ever be
  Worker mapping_, loop_closing_;   // last: they use all of the above
};

}  // namespace spslam
