// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// A run in a few lines, for the terminal.
#pragma once

#include <optional>

#include "spslam/cli/run_tables.h"
#include "spslam/eval/evaluation.h"

namespace spslam {

// "49 tracking, 1 coasting"
std::string state_counts(const RunRecord& record);

struct ReasonCount {
  std::string reason;  // of the first of them
  int frames = 0;
  bool others = false;  // some have other numbers in it
};
// Why frames were not tracked, the most frequent first. Reasons that differ in numbers only are one.
std::vector<ReasonCount> reasons_of_untracked(const RunRecord& record);

// Parts of the trajectory without a frame that was lost; the motion from one to the next is dead reckoning,
// or known by a loop only.
int stretches(const std::vector<TrajectoryPose>& trajectory);

// Why no frame at all was tracked; empty if one was.
std::string nothing_tracked(const RunRecord& record);

std::string report_text(const std::string& folder, const RunRecord& record,
                        const std::optional<Evaluation>& evaluation);

}  // namespace spslam
