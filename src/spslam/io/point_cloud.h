// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// A map as other programs read it: points and the way of the camera, in the world frame, m.
#pragma once

#include <string>
#include <vector>

#include "spslam/map/map.h"

namespace spslam {

struct CloudPoint {
  LandmarkId id;
  Eigen::Vector3d position;  // m, in the world
  double sigma = 0;          // m, standard deviation along the ray from its host
  Region region = Region::kNear;
  int observers = 0;  // keyframes that saw it
};

struct CloudOptions {
  double max_uncertainty = 0.1;  // sigma / distance
  int min_observers = 2;
};

// The landmarks whose depth is usable: in front of their host, known well enough, seen often enough, and no
// mirror image on the water. In the order of their ids.
std::vector<CloudPoint> cloud_points(const Map& map, const CloudOptions& options = {});

// PLY (ascii 1.0): the points, near ones green and far ones red, then the keyframes' positions, blue, with an
// edge from each to the next. sigma is 0 for a keyframe.
std::string format_ply(const std::vector<CloudPoint>& points, const Map& map);
// "landmark,x,y,z,sigma,region,observers"
std::string format_points_csv(const std::vector<CloudPoint>& points);
// "keyframe,frame,timestamp,x,y,z,qx,qy,qz,qw,parent": world from camera; parent empty for the root.
std::string format_keyframe_poses_csv(const Map& map);

}  // namespace spslam
