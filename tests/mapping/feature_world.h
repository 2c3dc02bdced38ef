// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Keyframes with features of points whose truth is known, without images: most points are nobody's landmark,
// a few are everybody's, so that the keyframes are covisible.
#pragma once

#include <opencv2/imgproc.hpp>

#include "features/made_up_descriptors.h"
#include "spslam/base/random.h"
#include "spslam/map/map.h"
#include "spslam/optimize/problem.h"

namespace spslam::test {

struct FeatureWorldOptions {
  int cameras = 3;
  int points = 150, shared = 25;  // nobody's landmarks, everybody's
  Eigen::Vector3d step{0.4, 0, 0.15};
  double nearest = 2.5, farthest = 15;  // m
  double noise = 0.8;                   // px, of the features' positions on full size
  int octave = 0;
  int flipped = 8;  // bits of a descriptor that each view changes
  std::uint64_t seed = 5;
};

struct FeatureWorld {
  StereoRig rig;
  Map map;
  std::vector<Eigen::Vector3d> points;                 // in the world
  std::map<std::pair<float, float>, int> point_at[8];  // of a keyframe's features, by their position
};

inline StereoRig feature_rig() {
  StereoRig rig;
  rig.fx = rig.fy = 380;
  rig.cx = 319.5, rig.cy = 179.5;
  rig.baseline = 0.08;
  rig.width = 640, rig.height = 360;
  return rig;
}

// An image full of corners.
inline cv::Mat textured_wall(const StereoRig& rig) {
  Random random(9);
  cv::Mat noise(rig.height, rig.width, CV_8UC1), wall;
  for (int y = 0; y < noise.rows; ++y)
    for (int x = 0; x < noise.cols; ++x)
      noise.at<unsigned char>(y, x) = static_cast<unsigned char>(random.below(256));
  cv::GaussianBlur(noise, wall, {}, 2.5);
  cv::normalize(wall, wall, 20, 235, cv::NORM_MINMAX);
  return wall;
}

inline bool is_in_image(const StereoRig& rig, const Eigen::Vector3d& x) {
  if (x.z() < 0.5) return false;
  const Eigen::Vector2d p = rig.project(x);
  return p.x() > 8 && p.y() > 8 && p.x() < rig.width - 8 && p.y() < rig.height - 8;
}

inline FeatureWorld make_feature_world(const FeatureWorldOptions& options) {
  FeatureWorld out;
  out.rig = feature_rig();
  Random random(options.seed);
  std::vector<Descriptor> descriptors;
  for (int i = 0; i < options.points + options.shared; ++i) {
    const double z = 1 / random.uniform(1 / options.farthest, 1 / options.nearest);
    out.points.push_back(z * out.rig.bearing(random.uniform(120, 630), random.uniform(10, 350)));
    descriptors.push_back(random_descriptor(random));
  }
  for (int l = 0; l < options.shared; ++l) {
    Landmark landmark;
    landmark.id = {l};
    landmark.host = {0};
    const Eigen::Vector3d& x = out.points[static_cast<std::size_t>(options.points + l)];
    landmark.bearing = x / x.z();
    landmark.inverse_depth = 1 / x.z();
    landmark.information = 1e4;
    landmark.pixel = out.rig.project(x).cast<float>();
    landmark.descriptor = descriptors[static_cast<std::size_t>(options.points + l)];
    out.map.add(landmark);
  }
  for (int k = 0; k < options.cameras; ++k) {
    Keyframe keyframe;
    keyframe.id = {k};
    keyframe.timestamp = k;
    const SE3 world_from_camera{so3_exp({0.004 * k, -0.01 * k, 0.006 * k}), k * options.step};
    keyframe.camera_from_world = world_from_camera.inverse();
    auto features = std::make_shared<KeyframeFeatures>();
    for (int p = 0; p < options.points + options.shared; ++p) {
      const auto i = static_cast<std::size_t>(p);
      const Eigen::Vector3d x = keyframe.camera_from_world * out.points[i];
      if (!is_in_image(out.rig, x)) continue;
      const Eigen::Vector2d noise(random.normal(), random.normal());
      const Eigen::Vector2d at = out.rig.project(x);
      if (p >= options.points) {
        keyframe.sightings.push_back({{p - options.points}, {at.x(), at.y(), 0}, {2, 2, 0}, 1});
        continue;
      }
      const Eigen::Vector2f seen = (at + options.noise * noise).cast<float>();
      features->keypoints.push_back({seen.x(), seen.y(), 0, 0, static_cast<std::uint8_t>(options.octave)});
      features->descriptors.push_back(flip_bits(descriptors[i], options.flipped, random));
      features->inverse_depths.push_back(0);
      features->information.push_back(0);
      out.point_at[k][{seen.x(), seen.y()}] = p;
    }
    keyframe.features = std::move(features);
    out.map.add(std::move(keyframe));
  }
  return out;
}

}  // namespace spslam::test
