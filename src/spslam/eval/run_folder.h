// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// What a run left in its result folder, made into a report.
#pragma once

#include <filesystem>
#include <string_view>

#include "spslam/eval/html_report.h"

namespace spslam {

// Reads trajectory_tum.txt, frames.csv, timing.json, metrics.json, config.yaml and samples/*.png (in the
// order of their names, which become the captions). What is missing, as after a kill, or damaged is left out,
// and the notes say so. Throws InputError if there is neither a trajectory nor a table of frames that can be
// read.
ReportInput read_run_folder(const std::filesystem::path& folder);

// frames.csv: a head line with column names, of which timestamp is required and state, near, far and keyframe
// (empty, 0, false, no or none: not one) are used. A number that is missing or cannot be read is NaN. name
// stands for the file in messages.
std::vector<ReportFrame> parse_frames_csv(std::string_view text, const std::string& name);

// timing.json: an object of stages, or one under "stages", each {mean, p50, p95, max} in ms; a "_ms" at the
// end of a key does not matter. Every other number at the top becomes a fact. Adds to report.
void parse_timing_json(std::string_view text, const std::string& name, ReportInput& report);

}  // namespace spslam
