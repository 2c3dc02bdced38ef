// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Landmarks that a new keyframe is the first to see.
#pragma once

#include "spslam/odometry/active_map.h"
#include "spslam/odometry/front_end.h"

namespace spslam {

struct NewLandmark {
  Landmark landmark;  // id and host are set by the caller
  Sighting sighting;  // the host's own: its disparity only
};

// Disparity of a point of the left image by row search and alignment, px; nothing if it is not found or two
// places are alike.
std::optional<double> measure_disparity(const Frame& frame, const Eigen::Vector2f& left,
                                        const TrackerOptions& options);

// What a frame that is no keyframe is recognized by: ORB features of all levels with the inverse depths that
// their disparities give.
KeyframeFeatures describe(const Frame& frame, const StereoRig& rig, const DisparityOffset& offset,
                          FrontEnd& front_end, const TrackerOptions& options);

// Corners of the frame away from the sightings, each with a disparity. A disparity about zero, or below, is
// kept: the point is a direction without a depth, and says so by the information of its inverse depth.
std::vector<NewLandmark> find_new_landmarks(const ActiveMap& map, const Frame& frame,
                                            const std::vector<Sighting>& sightings, FrontEnd& front_end,
                                            const TrackerOptions& options);

}  // namespace spslam
