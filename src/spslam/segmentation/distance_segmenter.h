// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Distance segmentation (paper 3.1.2, 4.1): near the shore what is bright is the sky, and what borders on the
// sky is far.
#pragma once

#include <deque>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "spslam/features/types.h"
#include "spslam/segmentation/options.h"
#include "spslam/segmentation/regions.h"
#include "spslam/segmentation/threshold.h"

namespace spslam {

struct SegmentationResult {
  bool has_far = false;  // whether any pixel is far or mirror
  bool held =
      false;  // the frame was taken for overexposed, or the like, and has the regions of the frame before
  double threshold = 0;     // grey; a pixel is bright above it
  double bimodality = 0;    // of the averaged histogram: between-class over total variance, 0 to 1
  double contrast = 0;      // grey, of the averaged histogram: difference of the classes' means
  double bright_share = 0;  // of this frame at the threshold
  RegionMap regions;        // regions.at(x, y), regions.mask()
};

// Every keypoint takes the label of its pixel.
std::vector<Region> label_keypoints(const RegionMap& regions, std::span<const Keypoint> keypoints);

// Holds the past frames' histograms; one for each camera.
class DistanceSegmenter {
 public:
  // Throws OptionError for options out of range.
  explicit DistanceSegmenter(const SegmentationOptions& options = {});

  // The next left image, CV_8UC1, of any size (a change of size starts anew). Throws InputError for another
  // type.
  SegmentationResult update(const cv::Mat& left);

  const SegmentationOptions& options() const { return options_; }

 private:
  Split next_split(const Histogram& present);
  bool is_upset(double bright_share) const;
  bool is_first() const { return last_.regions.size.empty(); }

  SegmentationOptions options_;
  std::deque<Histogram> window_;
  SegmentationResult last_;
  int held_ = 0;  // frames since the last that was segmented itself
};

}  // namespace spslam
