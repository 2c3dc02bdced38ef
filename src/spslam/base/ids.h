// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Ids are types of their own, so that a keyframe's id cannot be used for a landmark.
#pragma once

#include <compare>
#include <cstdint>
#include <functional>

namespace spslam {

template <class Tag>
struct Id {
  std::int64_t value = -1;

  bool valid() const { return value >= 0; }
  friend auto operator<=>(const Id&, const Id&) = default;
};

using FrameId = Id<struct FrameTag>;        // the n-th frame given to the system
using KeyframeId = Id<struct KeyframeTag>;  // in order of insertion
using LandmarkId = Id<struct LandmarkTag>;  // in order of creation

}  // namespace spslam

template <class Tag>
struct std::hash<spslam::Id<Tag>> {
  std::size_t operator()(spslam::Id<Tag> id) const noexcept { return std::hash<std::int64_t>()(id.value); }
};
