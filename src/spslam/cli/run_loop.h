// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The frames of a data set, one by one, into the system.
#pragma once

#include <exception>

#include "spslam/cli/run_arguments.h"
#include "spslam/cli/run_checkpoint.h"
#include "spslam/cli/run_tables.h"
#include "spslam/io/prefetch.h"

namespace spslam {

// Gives the frames to slam until their end, a signal or an exception, which is returned so that what was done
// before it can be written.
std::exception_ptr track_frames(const RunArguments& arguments, const Dataset& dataset, Prefetcher& frames,
                                Slam& slam, Checkpoint& checkpoint, RunRecord& record);

}  // namespace spslam
