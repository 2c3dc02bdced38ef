// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/system/slam.h"

#include <cmath>

#include "spslam/system/localizer.h"
#include "spslam/system/map_file.h"
#include "spslam/system/stages.h"

namespace spslam {

namespace {

// Of the odometry beside a fixed map: its loops are the map's, and so are the places it is found again at.
SlamOptions session_options(SlamOptions options) {
  options.loop.enabled = false;
  options.tracker.state.relocalization_frames = 0;
  options.mapper.features.image_quality = 0;
  return options;
}

std::vector<KeyframeInfo> keyframes_of(const Map& map) {
  std::vector<KeyframeInfo> out;
  for (const auto& [id, keyframe] : map.keyframes())
    out.push_back({id, keyframe.frame, keyframe.timestamp, keyframe.camera_from_world.inverse(),
                   static_cast<int>(keyframe.sightings.size())});
  return out;
}

// The frames as the map has corrected them.
std::vector<TrajectoryPose> corrected_by(const Stages& stages) {
  return stages.read([&](const Map& map) {
    std::vector<TrajectoryPose> out;
    for (const FramePose& frame : stages.settled())
      if (const auto reference = map.camera_from_world(frame.reference))
        out.push_back({frame.frame, frame.timestamp, frame.status,
                       (frame.camera_from_reference * *reference).inverse()});
    return out;
  });
}

}  // namespace

Slam::Slam(const StereoRig& rig, const SlamOptions& options, Map map, const Vocabulary& vocabulary)
    : rig_(rig) {
  check_options(options);
  if (!options.localization.enabled) {
    stages_ = std::make_unique<Stages>(rig, options, std::move(map), vocabulary);
    return;
  }
  localizer_ = std::make_unique<Localizer>(rig, options, std::move(map), vocabulary);
  stages_ = std::make_unique<Stages>(rig, session_options(options), Map{}, vocabulary);
}

Slam::~Slam() = default;

TrackResult Slam::track(const StereoFrame& pair) {
  if (!std::isfinite(pair.timestamp) || (last_timestamp_ && pair.timestamp <= *last_timestamp_)) {
    TrackResult refused;
    refused.timestamp = pair.timestamp;
    // What is known stays known, but nothing was measured.
    refused.status = last_.status == TrackStatus::kTracking ? TrackStatus::kCoasting : last_.status;
    refused.world_from_camera = last_.world_from_camera;
    refused.covariance = last_.covariance, refused.entropy = last_.entropy;
    refused.reason =
        "time " + std::to_string(pair.timestamp) + " s is not after the last frame's; the frame is left out";
    return refused;
  }
  last_timestamp_ = pair.timestamp;
  const TrackerOutput output = stages_->track(pair);
  last_ = localizer_ ? localizer_->place(output) : output.result;
  return last_;
}

void Slam::wait_for_map() {
  stages_->wait_for_map();
}

void Slam::finish() {
  std::exception_ptr failure;
  try {
    stages_->finish();
  } catch (...) {
    failure = std::current_exception();  // what was placed until then is smoothed all the same
  }
  if (localizer_) localizer_->finish(corrected_by(*stages_));
  if (failure) std::rethrow_exception(failure);
}

std::vector<TrajectoryPose> Slam::trajectory() const {
  return localizer_ ? localizer_->trajectory() : corrected_by(*stages_);
}

std::vector<KeyframeInfo> Slam::keyframes() const {
  if (localizer_) return keyframes_of(localizer_->map());
  return stages_->read(keyframes_of);
}

std::size_t Slam::landmark_count() const {
  if (localizer_) return localizer_->map().landmarks().size();
  return stages_->read([](const Map& map) { return map.landmarks().size(); });
}

std::vector<MappingInfo> Slam::mapping() const {
  return stages_->mapping_log();
}

std::vector<LoopAttempt> Slam::loops() const {
  return stages_->loop_log();
}

void Slam::save(const std::filesystem::path& path) const {
  if (localizer_) return save_map(path, localizer_->map(), rig_);
  stages_->read([&](const Map& map) { save_map(path, map, rig_); });
}

}  // namespace spslam
