// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// What enters the system: a rectified pair of grey images of one instant.
#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace spslam {

struct StereoFrame {
  double timestamp = 0;  // s
  cv::Mat left, right;   // CV_8UC1, of the rig's size
  // Why the pair cannot be used ("left image truncated: ..."), empty for a good pair. A bad pair is a frame
  // all the same: it has a time and gets a status and a pose.
  std::string problem;
};

}  // namespace spslam
