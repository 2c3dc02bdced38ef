// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/cli/run_samples.h"

#include <spdlog/fmt/fmt.h>

#include <opencv2/imgcodecs.hpp>

#include "spslam/cli/overlay.h"
#include "spslam/features/orb_extractor.h"
#include "spslam/segmentation/distance_segmenter.h"

namespace spslam {
namespace {

// The regions of a frame depend on the window of frames before it.
RegionMap regions_of(const Dataset& dataset, const TrackerOptions& options, int first, int index) {
  if (!options.segment) return {};
  DistanceSegmenter segmenter(options.segmentation);
  SegmentationResult result;
  for (int i = std::max(first, index - options.segmentation.window + 1); i <= index; ++i)
    if (const StereoFrame pair = dataset.load(i); pair.problem.empty()) result = segmenter.update(pair.left);
  return result.regions;
}

}  // namespace

void write_samples(const ResultFolder& folder, const Dataset& dataset, const TrackerOptions& options,
                   int first, int last, int count) {
  const int frames = last - first + 1;
  OrbExtractor extractor(options.orb);
  for (int k = 0; k < std::min(count, frames); ++k) {
    const int index = first + static_cast<int>((2LL * k + 1) * frames / (2LL * std::min(count, frames)));
    const StereoFrame pair = dataset.load(index);
    if (!pair.problem.empty()) continue;
    const cv::Mat picture = draw_overlay(pair.left, regions_of(dataset, options, first, index),
                                         extractor.extract(pair.left).keypoints);
    std::vector<std::uint8_t> png;
    cv::imencode(".png", picture, png);
    folder.write(fmt::format("{}/frame_{:06}.png", kSamplesFolder, index),
                 {reinterpret_cast<const char*>(png.data()), png.size()});
  }
}

}  // namespace spslam
