// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// From a pair of images to a Frame (paper 3.1.1 to 3.1.3).
#pragma once

#include "spslam/camera/stereo_frame.h"
#include "spslam/camera/stereo_rig.h"
#include "spslam/features/orb_extractor.h"
#include "spslam/odometry/frame.h"
#include "spslam/odometry/options.h"
#include "spslam/segmentation/distance_segmenter.h"

namespace spslam {

// One for each camera, frames in order: the segmentation remembers the past ones.
class FrontEnd {
 public:
  explicit FrontEnd(const TrackerOptions& options);

  // What makes the pair unusable, or "": a problem of its own, another size or type than the rig's.
  static std::string problem_of(const StereoFrame& pair, const StereoRig& rig);

  // The pair must be usable. Both eyes are worked on in parallel.
  Frame process(const StereoFrame& pair, FrameId id);

  // ORB features of all levels of the left image processed last.
  Features all_features() { return left_.extract(image_); }
  // Corners of the left image of the frame processed last, apart from `occupied` places, with descriptors.
  Features new_corners(std::span<const cv::Point2f> occupied, int count);

 private:
  bool needs_features() const;

  TrackerOptions options_;
  OrbExtractor left_, right_, corners_;
  DistanceSegmenter segmenter_;
  cv::Mat image_;  // the left one of the frame processed last
};

}  // namespace spslam
