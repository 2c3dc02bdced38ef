// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// True disparities of a rendered sequence, for bench/disparity.cpp: KITTI layout plus depth/ (uint16 PNG,
// planar z in cm, 0 = sky) and world_from_first_camera.txt (world z up, water at z = 0).
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "spslam/camera/stereo_rig.h"

namespace spslam::bench {

struct BenchFrame {
  int number = 0;
  cv::Mat left, right;  // CV_8UC1
  cv::Mat disparity;    // CV_32FC1 in px, NaN on water; empty without depth
};

// Every `every`-th frame; where there is a depth folder, only frames with depth.
std::vector<BenchFrame> read_frames(const std::string& folder, int every);

StereoRig read_rig(const std::string& folder, cv::Size size);

struct TrueDisparity {
  bool known = false;  // false on water and outside
  bool edge = false;   // a depth edge within the neighbourhood
  float value = 0;     // px
};

// The truth about a pixel. Where the disparities within `plane_radius` px depart by more than `edge_range` px
// from a plane, a patch sees more than one surface and locks on the one with the texture (a silhouette, not
// the sky next to it): then `edge` is set and the value is that within `edge_radius` px which is nearest to
// `measured` (NaN: that of the pixel itself); elsewhere it is interpolated at the pixel.
struct EdgeRule {
  int plane_radius = 12, edge_radius = 7;
  double edge_range = 0.1, edge_share = 0.05;
};
TrueDisparity true_disparity(const cv::Mat& disparity, float x, float y, float measured,
                             const EdgeRule& rule);

}  // namespace spslam::bench
