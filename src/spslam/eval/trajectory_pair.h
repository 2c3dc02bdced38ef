// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// An estimate and its ground truth from two files of whatever formats, with the one question that the formats
// leave open: whether their times can be compared.
#pragma once

#include <filesystem>

#include "spslam/io/trajectory.h"

namespace spslam {

struct TrajectoryPairFiles {
  std::filesystem::path estimate;
  std::filesystem::path truth;
  TrajectoryFormat estimate_format = TrajectoryFormat::kAuto;
  TrajectoryFormat truth_format = TrajectoryFormat::kAuto;
  // Of the KITTI files among them that have no NAME_times.txt beside them; empty: the times.txt beside each,
  // if there is one.
  std::filesystem::path times;
};

struct TrajectoryPair {
  Trajectory estimate;
  Trajectory truth;
  bool by_index = false;  // neither has times: the n-th pose belongs to the n-th
};

// Of two KITTI files of as many rows, one with times and one without, both get the same times. Throws
// InputError if only one has times and they cannot be lent to the other.
TrajectoryPair read_trajectory_pair(const TrajectoryPairFiles& files);

}  // namespace spslam
