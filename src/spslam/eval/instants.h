// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Whether left and right images are of one instant.
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "spslam/eval/recording_sample.h"

namespace spslam {

// When the right images were exposed, from how well their rows fit those of the left images before, of, and
// after each pair: what moved between the two does not lie in the same rows.
struct Instants {
  int pairs = 0;           // with both neighbours
  double spread[3] = {};   // px, RowOffsets::spread against the left image before, its own, and the next
  bool is_told = false;    // the camera moves enough, and there are matches
  int fitting = 0;         // frames: which left image fits, -1 for the one before
  double delay = 0;        // frames from left to right exposure, by the rows' own motion; 0 unless told
  double delay_sigma = 0;  // frames; 0: the camera does not pitch enough to tell the delay
};

// The matches of a pair's right image with the left one `frames` (-1, 0 or 1) later, and those of all pairs.
const std::vector<PairMatch>& matches_with(const SampledPair& pair, int frames);
std::vector<PairMatch> all_matches(std::span<const SampledPair> pairs, int frames);

Instants measure_instants(std::span<const SampledPair> pairs, cv::Size image);

}  // namespace spslam
