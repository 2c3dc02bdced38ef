// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Trajectories and the text formats they come in. Camera axes x right, y down, z forward; every parser takes
// the text and a name for messages, throws InputError "name:line: what" and nothing else; times increase
// strictly in the result.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "spslam/base/se3.h"

namespace spslam {

struct StampedPose {
  double timestamp = 0;  // s
  SE3 world_from_camera;
};

using Trajectory = std::vector<StampedPose>;

enum class TrajectoryFormat { kAuto, kTum, kKitti, kEuroc, kUsvinland };
std::span<const char* const> option_names(TrajectoryFormat);

struct TrajectoryFile {
  TrajectoryFormat format = TrajectoryFormat::kAuto;  // kAuto: told from the first line of values
  std::filesystem::path
      times;  // KITTI: file of one time a line; empty: times.txt beside it, or the row's index as time
  SE3 body_from_camera;  // EuRoC: T_BS of the left camera; identity leaves the poses of the body
};

// Reads any of the formats. Throws InputError.
Trajectory read_trajectory(const std::filesystem::path& path, const TrajectoryFile& file = {});
// What the first line of values looks like; kAuto if like nothing known.
TrajectoryFormat recognise_trajectory(std::string_view text);

// TUM: `t tx ty tz qx qy qz qw`. Quaternions further than 1 % from unit length are refused, others
// normalised. A line of the same time as the one before it is dropped (published motion capture files have
// some); an earlier time is an error.
Trajectory parse_tum(std::string_view text, const std::string& name);
// KITTI: 12 numbers a row, world_from_camera row by row. times: one a row, or empty: the row's index (0, 1,
// ...).
Trajectory parse_kitti_poses(std::string_view text, const std::string& name,
                             std::span<const double> times = {});
// EuRoC ground truth: `t_ns, px py pz, qw qx qy qz, ...` of the body.
Trajectory parse_euroc_ground_truth(std::string_view text, const std::string& name,
                                    const SE3& body_from_camera = {});
// USVInland GPSBase.csv: no header, >= 11 columns, 0 t (s), 1 east (m), 2 north (m), 10 heading (deg,
// clockwise from north). No height: the trajectory is planar. World is east, north, up; the camera is level
// and looks where the boat heads.
Trajectory parse_usvinland_gps(std::string_view text, const std::string& name);

// Times with 9 decimals, translations and quaternions with 9 digits behind the point (the sign with qw >= 0).
std::string format_tum(const Trajectory& trajectory);
std::string format_kitti_poses(const Trajectory& trajectory);
// 8 columns: t_ns, position, quaternion of the body.
std::string format_euroc_ground_truth(const Trajectory& trajectory, const SE3& body_from_camera = {});
// World must be east, north, up. Columns that hold nothing planar are 0.
std::string format_usvinland_gps(const Trajectory& trajectory);

// The pose of a level camera that looks towards heading_deg (clockwise from north); world is east, north, up.
SE3 planar_pose(double east, double north, double heading_deg);

}  // namespace spslam
