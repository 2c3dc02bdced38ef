// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// ORB features of an image (paper 3.1.1): oriented FAST corners on a pyramid, well spread, with rotated BRIEF
// descriptors.
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "spslam/features/distribute.h"
#include "spslam/features/orb_options.h"
#include "spslam/features/pyramid.h"
#include "spslam/features/types.h"

namespace spslam {

// Where features may be taken, and how many.
struct OrbRequest {
  int count = 0;                          // features wanted; 0 for OrbOptions::count
  std::span<const cv::Point2f> occupied;  // px, full size: places that have a feature already
  float radius = 0;  // px, full size: no feature is taken nearer than this to an occupied place
  cv::Mat allowed;   // CV_8UC1 of the image's size, 0 where none is wanted; empty for everywhere
};

// One extractor serves one image at a time and keeps its buffers from call to call; use one per eye for both
// in parallel. Levels are worked on in parallel (TBB); the result is the same with any number of threads. Not
// for concurrent calls.
class OrbExtractor {
 public:
  // Throws OptionError for options out of range.
  explicit OrbExtractor(const OrbOptions& options = {});

  // Keypoints with their descriptors, by level, within a level by rank. grey: CV_8UC1 of any size; an image
  // without texture (or an empty one) has no features. Throws InputError for another type or a mask of
  // another size.
  Features extract(const cv::Mat& grey, const OrbRequest& request = {});

  // The same in steps, for those who need only part of it. The image must stay unchanged while it is used.
  void set_image(const cv::Mat& grey);
  // Keypoints of the image set last: position, angle, response, octave.
  std::vector<Keypoint> detect(const OrbRequest& request = {});
  // Sets the angles of keypoints of the image set last that lie anywhere in it, from their position and
  // octave.
  void orient(std::span<Keypoint> keypoints) const;
  // Descriptors of keypoints anywhere in the image set last, from their position, octave and angle; beyond
  // its edge the image is continued by its edge pixels. Throws InputError for a keypoint outside of it or on
  // a level that does not exist.
  std::vector<Descriptor> describe(std::span<const Keypoint> keypoints);

  const OrbOptions& options() const { return options_; }
  const ScalePyramid& pyramid() const { return pyramid_; }

 private:
  struct Level {
    cv::Mat scores, smoothed;
    std::vector<Corner> corners;
    RankedCorners ranked;
    bool is_smooth = false;
  };

  void find_corners(int level, int wanted, const cv::Mat& free);
  cv::Mat free_places(const OrbRequest& request);
  Keypoint make_keypoint(const Corner& corner, int level) const;
  cv::Point pixel_of(const Keypoint& keypoint) const;

  OrbOptions options_;
  ScalePyramid pyramid_;
  std::vector<Level> levels_;
  cv::Mat free_;
};

}  // namespace spslam
