// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The rectified stereo pair: two pinhole cameras of one focal length whose rows correspond.
// Camera axes: x right, y down, z forward. Pixel (0, 0) is the centre of the first pixel.
#pragma once

#include <Eigen/Core>
#include <string>

namespace spslam {

struct StereoRig {
  double fx = 0, fy = 0;      // px
  double cx = 0, cy = 0;      // px, the same in both eyes
  double baseline = 0;        // m, right camera at +x
  int width = 0, height = 0;  // px

  // Throws InputError unless focal lengths and baseline are positive and the principal point lies in the
  // image.
  void check() const;

  double disparity_per_inverse_depth() const { return fx * baseline; }  // px m
  // (x, y, 1) of a pixel, in the left camera; unit depth, not unit length.
  Eigen::Vector3d bearing(double u, double v) const { return {(u - cx) / fx, (v - cy) / fy, 1.0}; }
  // Left pixel of a point or bearing in the left camera; z must not be 0.
  Eigen::Vector2d project(const Eigen::Vector3d& point) const {
    return {fx * point.x() / point.z() + cx, fy * point.y() / point.z() + cy};
  }
  // Depth along z of a disparity, equation (5) of the paper.
  double depth(double disparity) const { return fx * baseline / disparity; }
};

}  // namespace spslam
