// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Pairs of a data set for checking it.
#pragma once

#include "spslam/eval/recording_sample.h"
#include "spslam/io/dataset.h"

namespace spslam {

// `count` pairs spread over the recording, each with its neighbours, and all times.
RecordingSample sample_recording(const Dataset& dataset, int count);

// What `spslam run` asks by itself: logs a warning if the first usable pairs from `start` on have rows more
// than 1 px off or seem to be swapped. Takes less than a tenth of a second.
void warn_of_pairs(const Dataset& dataset, int start);

}  // namespace spslam
