// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// What a run has to tell, as the texts of its files.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "spslam/io/dataset.h"
#include "spslam/system/slam.h"

namespace spslam {

struct FrameRecord {
  int index = 0;  // in the data set
  double decode_seconds = 0;
  TrackResult result;
};

struct RunRecord {
  std::set<KeyframeId> loaded;             // keyframes of the map that the run continued or localized in
  std::vector<FrameRecord> frames;         // in the order they were given
  std::vector<TrajectoryPose> trajectory;  // this and what follows: after Slam::finish()
  std::vector<KeyframeInfo> keyframes;
  std::vector<MappingInfo> mapping;
  std::vector<LoopAttempt> loops;
  std::size_t landmarks = 0;
  double wall_seconds = 0;
};

const char* state_name(TrackStatus status);

// frames.csv: one line a frame, times in ms, standard deviations in m and rad (the roots of the traces of the
// covariance's blocks; empty before the first pose); near and far count what was found.
std::string frames_csv(const RunRecord& record);
// covariance.csv: one line a frame, the upper triangle of the covariance of its pose (TrackResult) row by
// row; empty before the first pose.
std::string covariance_csv(const RunRecord& record);
// keyframes.csv: the map's keyframes in the end. Those of a loaded map have no frame and the reason "loaded".
std::string keyframes_csv(const RunRecord& record);
// mapping.csv: what local mapping did with each keyframe, those that were culled later among them.
std::string mapping_csv(const RunRecord& record);
// loops.csv: each place that a keyframe was compared with, how far that went, and the motion where it was
// accepted.
std::string loops_csv(const RunRecord& record);
Trajectory stamped_trajectory(const std::vector<TrajectoryPose>& poses);
// A row for each frame given: one without a pose of its own repeats the pose before it, or, before the first,
// the first pose. Empty if no frame has a pose.
Trajectory trajectory_of_every_frame(const RunRecord& record);
// The time of each row in s, as KITTI's times.txt has them.
std::string times_text(const Trajectory& rows);
// Stages of the frames whose pair was usable, and of all frames for decoding, in ms; totals in s and MB.
std::string timing_json(const RunRecord& record, const std::string& dataset);
double peak_memory_mb();
// Median of the whole tracking of a usable frame, in ms; 0 without one.
double median_frame_ms(const RunRecord& record);

}  // namespace spslam
