// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Rotated BRIEF: 256 comparisons of two smoothed pixels each, the pattern turned to the feature's orientation
// (Calonder et al., "BRIEF: binary robust independent elementary features", 2010; Rublee et al. 2011). The
// pattern is our own: pairs drawn from a Gaussian, of which the least correlated are kept;
// bench/features_pattern.cpp makes it, brief_pattern.h holds it.
#pragma once

#include <opencv2/core.hpp>

#include "spslam/features/orientation.h"
#include "spslam/features/types.h"

namespace spslam {

constexpr int kAngleBins = 64;  // rotations of the pattern that are kept ready

struct BriefPair {
  float ax, ay, bx, by;  // px from the centre, within kPatchRadius; the bit is I(a) < I(b)
};

// What bit 0 .. 255 compares at angle 0.
BriefPair brief_pair(int bit);

// Smooths a CV_8UC1 level for describing: the kernel (1 2 3 4 3 2 1) / 16 along x and y (standard
// deviation 1.6 px), edges repeated; in bytes, rounding up.
void smooth(const cv::Mat& grey, cv::Mat& smoothed);

// The descriptor of a patch of the smoothed level, turned by `angle` in rad.
Descriptor describe_patch(const Patch& smoothed, float angle);

}  // namespace spslam
