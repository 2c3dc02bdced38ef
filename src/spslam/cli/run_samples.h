// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Sample frames of a run for its report.
#pragma once

#include "spslam/cli/run_folder.h"
#include "spslam/io/dataset.h"
#include "spslam/system/slam_options.h"

namespace spslam {

// Writes `count` frames of first .. last, spread evenly, as samples/frame_000123.png: features near and far
// as the run told them apart. Frames without a usable image are left out. Throws OutputError.
void write_samples(const ResultFolder& folder, const Dataset& dataset, const TrackerOptions& options,
                   int first, int last, int count);

}  // namespace spslam
