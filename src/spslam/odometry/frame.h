// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// A frame as the odometry sees it: pyramids to align patches in, and what was found in the images. Immutable
// once built.
#pragma once

#include <vector>

#include "spslam/alignment/pyramid.h"
#include "spslam/base/ids.h"
#include "spslam/features/types.h"
#include "spslam/map/types.h"
#include "spslam/stereo/types.h"

namespace spslam {

struct Frame {
  FrameId id;
  double timestamp = 0;  // s
  AlignmentPyramid left, right;
  AlignmentPyramid soft_left, soft_right;  // of blurred images, for small disparities; empty if not wanted
  RegionMap regions;                       // empty if the frame was not segmented
  // Only where descriptors give the identity; stereo is as long as the keypoints.
  Features features;
  std::vector<StereoMeasurement> stereo;
};

}  // namespace spslam
