// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Tracking against the local map: landmarks of the published view that should be in sight again.
#pragma once

#include "spslam/odometry/active_map.h"
#include "spslam/odometry/options.h"

namespace spslam {

// The landmarks of the view that are not followed and should be seen from `camera_from_world`: in the image,
// under an angle and at a scale at which their patch still looks alike, and not where another is followed.
// The best known first, at most options.recall.count.
std::vector<Landmark> landmarks_in_sight(const ActiveMap& map, const LocalMapView& view,
                                         const SE3& camera_from_world, const TrackerOptions& options);

// Makes them followed, with the view's keyframes as hosts, to be let go again unless the next frame shows
// them.
void recall(const LocalMapView& view, const SE3& camera_from_world, const TrackerOptions& options,
            ActiveMap& map);

}  // namespace spslam
