// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// How deep the features of a keyframe are: as deep as the landmarks that it saw at or near them.
#pragma once

#include "spslam/map/map.h"

namespace spslam {

// How far a feature may be from a landmark to take over its depth, px: corners of coarser levels of the
// pyramid are not where those of full size are.
inline constexpr float kDepthRadius = 5;

struct FeatureDepth {
  double inverse_depth = 0, information = 0;  // 1/m along z of the keyframe's left camera, m^2; 0: not known
};

// One for each keypoint, as the map knows the landmarks now.
std::vector<FeatureDepth> feature_depths(const Map& map, const Keyframe& keyframe,
                                         std::span<const Keypoint> keypoints);

}  // namespace spslam
