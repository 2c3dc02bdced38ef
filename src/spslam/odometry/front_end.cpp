// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/odometry/front_end.h"

#include <tbb/parallel_invoke.h>

#include "spslam/stereo/stereo.h"

namespace spslam {
namespace {

std::vector<cv::Mat> levels_of(const ScalePyramid& pyramid) {
  std::vector<cv::Mat> levels;
  levels.reserve(static_cast<std::size_t>(pyramid.size()));
  for (int i = 0; i < pyramid.size(); ++i) levels.push_back(pyramid[i]);
  return levels;
}

std::string size_text(const cv::Mat& image) {
  return std::to_string(image.cols) + " x " + std::to_string(image.rows);
}

OrbOptions corner_options(const TrackerOptions& options) {
  OrbOptions corners = options.orb;
  corners.levels = std::min(options.landmarks.levels, options.orb.levels);
  return corners;
}

}  // namespace

FrontEnd::FrontEnd(const TrackerOptions& options)
    : options_(options),
      left_(options.orb),
      right_(options.orb),
      corners_(corner_options(options)),
      segmenter_(options.segmentation) {}

std::string FrontEnd::problem_of(const StereoFrame& pair, const StereoRig& rig) {
  if (!pair.problem.empty()) return pair.problem;
  for (const auto& [image, name] : {std::pair{&pair.left, "left"}, std::pair{&pair.right, "right"}}) {
    if (image->empty()) return std::string(name) + " image is empty";
    if (image->type() != CV_8UC1) return std::string(name) + " image is not 8 bit grey";
    if (image->cols != rig.width || image->rows != rig.height)
      return std::string(name) + " image is " + size_text(*image) + " px, the calibration is for " +
             std::to_string(rig.width) + " x " + std::to_string(rig.height);
  }
  return "";
}

bool FrontEnd::needs_features() const {
  return options_.follow.identity == Identity::kDescriptor || options_.stereo_by_descriptor;
}

Frame FrontEnd::process(const StereoFrame& pair, FrameId id) {
  Frame frame;
  frame.id = id;
  frame.timestamp = pair.timestamp;
  image_ = pair.left;
  Features right_features;
  const bool noise = options_.alignment.noise_factor > 0;
  tbb::parallel_invoke(
      [&] {
        frame.left = AlignmentPyramid(pair.left, options_.alignment.levels, noise);
        if (options_.follow.soft_sigma > 0) frame.soft_left = frame.left.softened(options_.follow.soft_sigma);
        if (needs_features()) frame.features = left_.extract(pair.left);
      },
      [&] {
        frame.right = AlignmentPyramid(pair.right, options_.alignment.levels, noise);
        if (options_.follow.soft_sigma > 0)
          frame.soft_right = frame.right.softened(options_.follow.soft_sigma);
        if (needs_features()) right_features = right_.extract(pair.right);
        if (options_.segment) frame.regions = segmenter_.update(pair.left).regions;
      });
  if (needs_features()) {
    const std::vector<cv::Mat> left = levels_of(left_.pyramid()), right = levels_of(right_.pyramid());
    frame.stereo = measure_stereo({frame.features, left, &frame.left}, {right_features, right, &frame.right},
                                  options_.stereo);
  }
  return frame;
}

Features FrontEnd::new_corners(std::span<const cv::Point2f> occupied, int count) {
  OrbRequest request;
  request.count = count;
  request.occupied = occupied;
  request.radius = static_cast<float>(options_.landmarks.spacing);
  return corners_.extract(image_, request);
}

}  // namespace spslam
