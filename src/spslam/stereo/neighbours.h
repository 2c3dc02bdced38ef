// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// What the measured points around a keypoint say about its disparity: a start for the alignment of points
// that have no descriptor match.
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "spslam/features/types.h"
#include "spslam/stereo/types.h"

namespace spslam {

class Neighbours {
 public:
  // Takes a copy of what is measured. size: of the full-size image.
  Neighbours(std::span<const Keypoint> keypoints, std::span<const StereoMeasurement> measurements,
             cv::Size size);

  // The measurement of median disparity among those in the cell of the keypoint and around it; status kNone
  // and zeros where there are none.
  StereoMeasurement guess(const Keypoint& keypoint) const;

 private:
  int cell_of(float x, float y) const;

  int columns_ = 0, rows_ = 0;
  std::vector<std::vector<StereoMeasurement>> cells_;
};

}  // namespace spslam
