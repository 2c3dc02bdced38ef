// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// A small harbour that any motion can be rendered in: a textured floor, two walls and an end wall under a
// bright sky, by casting a ray for each pixel.
#pragma once

#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "spslam/base/error.h"
#include "spslam/base/random.h"
#include "spslam/camera/stereo_frame.h"
#include "spslam/io/calibration.h"
#include "spslam/io/text.h"
#include "spslam/io/trajectory.h"

namespace spslam::test {

inline constexpr int kSceneFrames = 16;
inline constexpr double kFrameTime = 0.1;  // s

inline StereoRig scene_rig() {
  return {.fx = 240, .fy = 240, .cx = 159.5, .cy = 99.5, .baseline = 0.2, .width = 320, .height = 200};
}

// Forward with a slow bend and a little roll, 1 m/s.
inline SE3 scene_pose(int index) {
  const double t = kFrameTime * index;
  Vector6d twist;
  twist << 0.08 * t, 0.02 * std::sin(2 * t), 1.0 * t, 0.01 * std::sin(3 * t), 0.05 * t,
      0.015 * std::sin(2 * t);
  return SE3::exp(twist);
}

inline double lattice(int x, int y, std::uint64_t seed) {
  const auto cell = static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 20U;
  return Random(cell ^ static_cast<std::uint32_t>(y) ^ (seed << 52U)).uniform();
}

// Smooth noise, in [0, 1], of cells one unit wide.
inline double noise(double x, double y, std::uint64_t seed) {
  const double fx = std::floor(x), fy = std::floor(y), a = x - fx, b = y - fy;
  const int i = static_cast<int>(fx), j = static_cast<int>(fy);
  return (lattice(i, j, seed) * (1 - a) + lattice(i + 1, j, seed) * a) * (1 - b) +
         (lattice(i, j + 1, seed) * (1 - a) + lattice(i + 1, j + 1, seed) * a) * b;
}

// Coarse and fine spots; those finer than a pixel (`footprint` m) fade out.
inline double surface_brightness(double u, double v, double footprint, std::uint64_t seed) {
  double sum = 75;
  for (const double cell : {0.8, 0.3, 0.12}) {
    const double weight = std::clamp(cell / (2 * footprint) - 0.5, 0.0, 1.0);
    sum += weight * 55 * (noise(u / cell, v / cell, seed) - 0.5);
  }
  return sum;
}

// What a ray from `origin` along `direction` (z forward, y down) sees, as a grey value.
inline double seen(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double pixel_angle) {
  struct Plane {
    int axis;
    double at;
  };
  constexpr Plane kPlanes[] = {{1, 1.2}, {0, -3.0}, {0, 3.5}, {2, 16.0}};
  double nearest = 1e9, brightness = 225;  // the sky
  for (std::size_t k = 0; k < std::size(kPlanes); ++k) {
    const auto& [axis, at] = kPlanes[k];
    const double distance = (at - origin[axis]) / direction[axis];
    if (!(distance > 0) || distance >= nearest) continue;
    const Eigen::Vector3d point = origin + distance * direction;
    if (axis != 1 && (point.y() < -2.0 || point.y() > 1.2)) continue;
    nearest = distance;
    const double u = axis == 0 ? point.z() : point.x(), v = axis == 1 ? point.z() : point.y();
    const double slant = std::abs(direction[axis]) / direction.norm();
    brightness = surface_brightness(u, v, distance * pixel_angle / std::max(0.05, slant), k + 1);
  }
  return brightness;
}

inline cv::Mat render_eye(const StereoRig& rig, const SE3& world_from_eye) {
  cv::Mat image(rig.height, rig.width, CV_8UC1);
  for (int y = 0; y < rig.height; ++y)
    for (int x = 0; x < rig.width; ++x) {
      const Eigen::Vector3d ray = world_from_eye.rotation * rig.bearing(x, y);
      image.at<std::uint8_t>(y, x) =
          cv::saturate_cast<std::uint8_t>(seen(world_from_eye.translation, ray, 1 / rig.fx));
    }
  return image;
}

// The index-th pair of the sequence.
inline StereoFrame scene_pair(int index, const StereoRig& rig = scene_rig()) {
  const SE3 left = scene_pose(index);
  const SE3 right = left * SE3{Eigen::Matrix3d::Identity(), {rig.baseline, 0, 0}};
  return {kFrameTime * index, render_eye(rig, left), render_eye(rig, right), ""};
}

inline Trajectory scene_truth() {
  Trajectory truth;
  for (int i = 0; i < kSceneFrames; ++i) truth.push_back({kFrameTime * i, scene_pose(i)});
  return truth;
}

inline std::string scene_image_name(int index) {
  const std::string digits = std::to_string(index);
  return std::string(6 - digits.size(), '0') + digits + ".png";
}

// The sequence as a KITTI folder with its ground truth.
inline void write_scene(const std::filesystem::path& folder) {
  std::string times;
  for (const char* eye : {"image_0", "image_1"}) std::filesystem::create_directories(folder / eye);
  for (int i = 0; i < kSceneFrames; ++i) {
    const StereoFrame pair = scene_pair(i);
    times += fixed_text(pair.timestamp, 6) + "\n";
    if (!cv::imwrite((folder / "image_0" / scene_image_name(i)).string(), pair.left) ||
        !cv::imwrite((folder / "image_1" / scene_image_name(i)).string(), pair.right))
      throw OutputError(folder.string() + ": an image cannot be written");
  }
  write_text_file(folder / "times.txt", times);
  write_text_file(folder / "calib.txt", format_kitti_calibration(scene_rig()));
  write_text_file(folder / "poses.txt", format_kitti_poses(scene_truth()));
}

}  // namespace spslam::test
