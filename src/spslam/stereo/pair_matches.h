// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Matches between two eyes that do not assume a rectified rig: neither that rows correspond nor that
// disparities are positive. For checking a rig, not for tracking.
#pragma once

#include <vector>

#include "spslam/alignment/pyramid.h"
#include "spslam/features/orb_extractor.h"

namespace spslam {

struct PairMatch {
  float x = 0, y = 0;    // px in the left image
  float disparity = 0;   // px, left x minus right x; negative if the eyes are swapped
  float row_offset = 0;  // px, right y minus left y; 0 for a perfect rig
};

// What matching needs of one image; made once, matched with several others.
struct EyeFeatures {
  cv::Size size;
  Features features;
  AlignmentPyramid pyramid;
};

// Not for concurrent calls.
class PairMatcher {
 public:
  explicit PairMatcher(int corners = 1000);

  // grey: CV_8UC1, not empty.
  EyeFeatures prepare(const cv::Mat& grey);

 private:
  OrbExtractor extractor_;
};

// The corners of the left image that the right one has too: by descriptor (mutual, and clearly better than
// any other) within a quarter of the width to both sides and 8 % of the height up and down, then by patch
// alignment there and back, which knows rows to about 0.1 px. Patches that do not tell their row (upright
// edges) are left out.
std::vector<PairMatch> match_pair(const EyeFeatures& left, const EyeFeatures& right);

}  // namespace spslam
