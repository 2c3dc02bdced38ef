// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/system/slam.h"

#include <cmath>

#include "spslam/system/map_file.h"
#include "spslam/system/stages.h"

namespace spslam {

Slam::Slam(const StereoRig& rig, const SlamOptions& options, Map map) : rig_(rig) {
  check_options(options);
  stages_ = std::make_unique<Stages>(rig, options, std::move(map));
}

Slam::~Slam() = default;

TrackResult Slam::track(const StereoFrame& pair) {
  if (!std::isfinite(pair.timestamp) || (last_timestamp_ && pair.timestamp <= *last_timestamp_)) {
    TrackResult refused;
    refused.timestamp = pair.timestamp;
    refused.reason =
        "time " + std::to_string(pair.timestamp) + " s is not after the last frame's; the frame is left out";
    return refused;
  }
  last_timestamp_ = pair.timestamp;
  return stages_->track(pair);
}

void Slam::finish() {
  stages_->finish();
}

std::vector<TrajectoryPose> Slam::trajectory() const {
  return stages_->read([&](const Map& map) {
    std::vector<TrajectoryPose> out;
    for (const FramePose& frame : stages_->settled())
      if (const auto reference = map.camera_from_world(frame.reference))
        out.push_back({frame.frame, frame.timestamp, frame.status,
                       (frame.camera_from_reference * *reference).inverse()});
    return out;
  });
}

std::vector<KeyframeInfo> Slam::keyframes() const {
  return stages_->read([](const Map& map) {
    std::vector<KeyframeInfo> out;
    for (const auto& [id, keyframe] : map.keyframes())
      out.push_back({id, keyframe.frame, keyframe.timestamp, keyframe.camera_from_world.inverse(),
                     static_cast<int>(keyframe.sightings.size())});
    return out;
  });
}

std::size_t Slam::landmark_count() const {
  return stages_->read([](const Map& map) { return map.landmarks().size(); });
}

std::vector<MappingInfo> Slam::mapping() const {
  return stages_->mapping_log();
}

std::vector<LoopAttempt> Slam::loops() const {
  return stages_->loop_log();
}

void Slam::save(const std::filesystem::path& path) const {
  stages_->read([&](const Map& map) { save_map(path, map, rig_); });
}

}  // namespace spslam
