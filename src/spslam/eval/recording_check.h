// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Whether a recording and its calibration fit, judged from a sample of it: a finding a question, each with
// its figures, a judgement and what to do. docs/RECORDINGS.md says what each means.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "spslam/eval/instants.h"
#include "spslam/eval/recording_sample.h"
#include "spslam/stereo/pair_check.h"

namespace spslam {

enum class Judgement { kOk, kWarning, kBad };
std::span<const char* const> option_names(Judgement);

struct Finding {
  std::string name;  // "rows"
  Judgement judgement = Judgement::kOk;
  std::string text = {};    // what was found, for people
  std::string advice = {};  // what it means and what to do; empty if all is well
  std::vector<std::pair<std::string, double>> values = {};  // for programs, named with their units
};

// Do rows correspond? pair_scatter: px, how much the rows move from pair to pair.
Finding judge_rows(const RowOffsets& rows, double pair_scatter);
// Do points lie in front of the cameras, or are the eyes swapped?
Finding judge_sign(const DisparityStatistics& disparities);

// All of it: pairs, matches, instants, rows, sign, infinity, disparities, images, times, calibration.
std::vector<Finding> check_recording(const RecordingSample& sample);

Judgement worst_judgement(std::span<const Finding> findings);

}  // namespace spslam
