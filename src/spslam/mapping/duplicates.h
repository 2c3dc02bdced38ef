// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Landmarks that may be one and the same, among covisible keyframes (fuse.h) and after a loop
// (loop/fusion.h).
#pragma once

#include <algorithm>
#include <compare>
#include <set>
#include <vector>

#include "spslam/base/ids.h"

namespace spslam {

struct Duplicate {
  int distance;  // of their descriptors
  LandmarkId kept, gone;
  friend auto operator<=>(const Duplicate&, const Duplicate&) = default;
};

// Those that look most alike first, and of each landmark only the first.
inline std::vector<Duplicate> best_of_each(std::vector<Duplicate> found) {
  std::sort(found.begin(), found.end());
  std::set<LandmarkId> taken;
  std::erase_if(found, [&](const Duplicate& pair) {
    if (taken.contains(pair.kept) || taken.contains(pair.gone)) return true;
    taken.insert({pair.kept, pair.gone});
    return false;
  });
  return found;
}

}  // namespace spslam
