// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// What is measured on a recording before it is tracked: pairs here and there, and all of its times.
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <vector>

#include "spslam/camera/stereo_frame.h"
#include "spslam/camera/stereo_rig.h"
#include "spslam/stereo/pair_matches.h"

namespace spslam {

struct ImageStatistics {
  double saturated = 0, black = 0;  // shares of pixels of at least 254 and at most 1
  double mean = 0, contrast = 0;    // grey values; contrast is the standard deviation
};

// grey: CV_8UC1, not empty.
ImageStatistics measure_image(const cv::Mat& grey);

struct TimeSteps {
  int intervals = 0;
  double median = 0, longest = 0;  // s
  double jitter = 0;               // s, 1.4826 times the median deviation from the median
  int gaps = 0;                    // intervals above 1.75 times the median: a frame or more is missing
  int short_ones = 0;              // intervals below half of it
};

TimeSteps measure_times(std::span<const double> times);

// One pair with its neighbours in time.
struct SampledPair {
  int corners = 0;                       // of the left image
  std::vector<PairMatch> matches;        // of left and right
  bool has_neighbours = false;           // what follows is of use only then
  std::vector<PairMatch> before, after;  // of the left image before and after it, and its own right one
  bool left_repeats = false, right_repeats = false;  // the next image of that eye is the same, bit by bit
  bool eyes_are_equal = false;                       // left and right are the same image, bit by bit
  ImageStatistics left, right;
};

// The pair must be usable, its neighbours (nothing at the ends of a recording) need not be.
SampledPair measure_pair(PairMatcher& matcher, const StereoFrame& pair, const StereoFrame& before = {},
                         const StereoFrame& after = {});

struct RecordingSample {
  StereoRig rig;
  std::vector<double> times;  // s, of all frames
  std::vector<SampledPair> pairs;
  int unusable = 0;           // pairs of the sample that cannot be read
  std::string first_problem;  // of the first of these
};

}  // namespace spslam
