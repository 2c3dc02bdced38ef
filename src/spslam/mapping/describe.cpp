// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/mapping/describe.h"

#include "spslam/map/feature_depths.h"

namespace spslam {

std::shared_ptr<const KeyframeFeatures> describe(const Map& map, const Keyframe& keyframe,
                                                 OrbExtractor& extractor, const DescribeOptions& options) {
  if (keyframe.left.empty()) return nullptr;
  auto out = std::make_shared<KeyframeFeatures>();
  out->level_scale = static_cast<float>(extractor.options().scale);
  extractor.set_image(keyframe.left.level(0));
  for (const Sighting& sighting : keyframe.sightings) {
    if (static_cast<int>(out->keypoints.size()) >= options.count) break;
    out->keypoints.push_back(
        {static_cast<float>(sighting.measured.x()), static_cast<float>(sighting.measured.y()), 0, 0, 0});
  }
  extractor.orient(out->keypoints);
  OrbRequest rest;
  rest.count = options.count - static_cast<int>(out->keypoints.size());
  if (rest.count > 0)
    for (const Keypoint& corner : extractor.detect(rest))
      if (corner.octave > 0) out->keypoints.push_back(corner);
  out->descriptors = extractor.describe(out->keypoints);
  for (const FeatureDepth& depth : feature_depths(map, keyframe, out->keypoints)) {
    out->inverse_depths.push_back(static_cast<float>(depth.inverse_depth));
    out->information.push_back(static_cast<float>(depth.information));
  }
  return out;
}

}  // namespace spslam
