// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// What must hold of the parts of a map, wherever they come from. Each function says what is wrong, in half a
// sentence, or nothing if all is well.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "spslam/map/types.h"

namespace spslam {

// The ids a map has, ascending and each once.
struct MapIds {
  std::vector<KeyframeId> keyframes;
  std::vector<LandmarkId> landmarks;
};

using MapProblem = std::optional<std::string>;

MapProblem problem_of(const MapIds& ids);
// Numbers are finite, errors not negative, ids exist, a pose is a rigid motion.
MapProblem problem_of(const Landmark& landmark, const MapIds& ids);
MapProblem problem_of(const Keyframe& keyframe, const MapIds& ids);
MapProblem problem_of(const LoopEdge& edge, const MapIds& ids);
// parents[i] is the parent of ids.keyframes[i]: one tree over all of them.
MapProblem problem_of_tree(const std::vector<KeyframeId>& parents, const MapIds& ids);

}  // namespace spslam
