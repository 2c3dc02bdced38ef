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

// Corners of the frame away from the sightings, each with a disparity. A disparity about zero, or below, is
// kept: the point is a direction without a depth, and says so by the information of its inverse depth.
std::vector<NewLandmark> find_new_landmarks(const ActiveMap& map, const Frame& frame,
                                            const std::vector<Sighting>& sightings, FrontEnd& front_end,
                                            const TrackerOptions& options);

}  // namespace spslam
