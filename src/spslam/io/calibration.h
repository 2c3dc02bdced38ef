// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Calibration files: KITTI's calib.txt and calib_cam_to_cam.txt, EuRoC's sensor.yaml and this project's own
// YAML in physical units.
//
// Rectified pair:                    Raw pair (rectified on loading):
//   width: 640        # px             width: 752
//   height: 320       # px             height: 480
//   fx: 360           # px             left:
//   fy: 360           # px               {fx: 458.654, fy: 457.296, cx: 367.215, cy: 248.375, model: radtan,
//   cx: 319.5         # px                distortion: [-0.283, 0.0739, 0.000193, 1.76e-05]}
//   cy: 159.5         # px             right: {...}
//   baseline: 0.08    # m              right_from_left: [16 or 12 numbers, the matrix row by row, m]
// Models: pinhole (no distortion), radtan (k1 k2 p1 p2 [k3 ...]), equidistant (k1 k2 k3 k4).
//
// docs/RECORDINGS.md has all keys.
//
// Every parser takes the text and a name for messages and throws InputError only.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "spslam/camera/rectifier.h"
#include "spslam/camera/stereo_rig.h"

namespace spslam {

struct StereoCalibration {
  StereoRig rig;  // of a rectified pair; width and height 0 if the file does not say (KITTI). Unset if raw.
  std::optional<RawStereo> raw;  // of a pair that must be rectified
  SE3 reference_from_left;       // KITTI: the left camera in the axes of camera 0, of which its truth is
};

// One EuRoC sensor.yaml.
struct EurocSensor {
  RawCamera camera;
  SE3 body_from_camera;  // T_BS, m
};

// KITTI has four cameras in a row; a pair of them is named by its left one.
enum class KittiPair { kGrey = 0, kColour = 2 };

// Reads one of KITTI's (ends in .txt) or a calibration YAML.
StereoCalibration read_calibration(const std::filesystem::path& path, KittiPair pair = KittiPair::kGrey);

// P0 and P1 (grey; P2 and P3: colour) of calib.txt, `P0: 12 numbers`, or P_rect_00 and P_rect_01 of
// calib_cam_to_cam.txt. Baseline = (P0[3] - P1[3]) / fx. The rig's width and height stay 0 unless S_rect_00
// (S_rect_02) states them.
StereoCalibration parse_kitti_calibration(std::string_view text, const std::string& name,
                                          KittiPair pair = KittiPair::kGrey);
StereoCalibration parse_calibration_yaml(std::string_view text, const std::string& name);
EurocSensor parse_euroc_sensor(std::string_view text, const std::string& name);

// What the parsers read: calib.txt with P0 and P1, and the YAML of a rectified pair.
std::string format_kitti_calibration(const StereoRig& rig);
std::string format_calibration_yaml(const StereoRig& rig);

}  // namespace spslam
