// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Finds the landmarks that are followed in a new frame: identity by patch or by descriptor, position by
// alignment with the host's patch, warped by the predicted motion, and the disparity by alignment of the two
// eyes.
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "spslam/odometry/active_map.h"
#include "spslam/odometry/frame.h"
#include "spslam/odometry/options.h"

namespace spslam {

// Where a landmark should be, and what the motion does to the pixels around it.
struct Prediction {
  Eigen::Vector2d position;          // px
  double disparity = 0;              // px, with the rig's offset
  Eigen::Matrix2f camera_from_host;  // of small offsets, px per px
};

// Nothing if the landmark is behind the camera or outside of the image.
std::optional<Prediction> predict(const ActiveMap& map, const Landmark& landmark,
                                  const SE3& camera_from_world);

// Disparity (left x minus right x, px) of a point of the left image by alignment from `start`, first on
// `first_level`, in the softened images if it is small and there are any; nothing if it fails, does not lead
// back, or the rows differ too much.
std::optional<double> align_disparity(const Frame& frame, const Eigen::Vector2f& left, double start,
                                      int first_level, const TrackerOptions& options);

// The landmarks (indices into map.landmarks) found in the frame, in the order given. levels: pyramid levels
// to align on.
std::vector<Sighting> follow_patches(const ActiveMap& map, std::span<const int> landmarks, const Frame& frame,
                                     const SE3& predicted, int levels, const TrackerOptions& options);

// The same with the identity from the frame's ORB features; ambiguous matches are dropped (paper 3.1.4).
std::vector<Sighting> follow_descriptors(const ActiveMap& map, std::span<const int> landmarks,
                                         const Frame& frame, const SE3& predicted,
                                         const TrackerOptions& options);

}  // namespace spslam
