// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// A textured plane in front of the first camera, rendered exactly from any pose: the texture is a formula.
#pragma once

#include <opencv2/core.hpp>

#include "spslam/base/random.h"
#include "spslam/camera/stereo_frame.h"
#include "spslam/odometry/frame.h"

namespace spslam::test {

class PlaneScene {
 public:
  explicit PlaneScene(std::uint64_t seed, double depth = 4) : depth_(depth) {
    rig_.fx = rig_.fy = 280;
    rig_.cx = 159.5, rig_.cy = 119.5;
    rig_.baseline = 0.1;
    rig_.width = 320, rig_.height = 240;
    Random random(seed);
    for (Wave& w : waves_) {  // wavelengths of 8 to 60 px in the first image
      const double k = 2 * M_PI * rig_.fx / depth / random.uniform(8, 60);
      const double direction = random.uniform(0, 2 * M_PI);
      w = {k * std::cos(direction), k * std::sin(direction), random.uniform(0, 2 * M_PI)};
    }
  }

  const StereoRig& rig() const { return rig_; }
  double inverse_depth() const { return 1 / depth_; }

  // World is the first camera; the plane is z = depth there. The camera must look at it.
  cv::Mat render(const SE3& camera_from_world, double eye = 0) const {
    const SE3 world_from_camera = camera_from_world.inverse();
    const Eigen::Vector3d centre = world_from_camera * Eigen::Vector3d(eye, 0, 0);
    cv::Mat image(rig_.height, rig_.width, CV_8UC1);
    for (int y = 0; y < rig_.height; ++y)
      for (int x = 0; x < rig_.width; ++x) {
        const Eigen::Vector3d ray = world_from_camera.rotation * rig_.bearing(x, y);
        const Eigen::Vector3d p = centre + (depth_ - centre.z()) / ray.z() * ray;
        image.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(texture(p.x(), p.y()));
      }
    return image;
  }
  StereoFrame pair(double timestamp, const SE3& camera_from_world) const {
    return {timestamp, render(camera_from_world), render(camera_from_world, rig_.baseline), ""};
  }
  // Without features and regions.
  Frame frame(const SE3& camera_from_world, int levels = 4) const {
    const StereoFrame images = pair(0, camera_from_world);
    Frame out;
    out.left = AlignmentPyramid(images.left, levels);
    out.right = AlignmentPyramid(images.right, levels);
    return out;
  }

 private:
  struct Wave {
    double kx = 0, ky = 0, phase = 0;
  };
  double texture(double x, double y) const {
    double sum = 0;
    for (const Wave& w : waves_) sum += std::cos(w.kx * x + w.ky * y + w.phase);
    return 128 + 11 * sum;
  }
  StereoRig rig_;
  double depth_;
  Wave waves_[20];
};

}  // namespace spslam::test
