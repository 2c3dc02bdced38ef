// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Images, depth and poses must tell of one and the same world.

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "sim/small_scene.h"

namespace spslam::sim {
namespace {

struct Shot {
  SimulatedFrame frame;
  FrameTruth truth;
};

// Frames 0 to 5 of the small scene, rendered once, without noise.
struct Recording {
  Recording() : simulator(scene(), 3) {
    for (int i = 0; i <= 5; ++i) {
      SimulatedFrame frame = *simulator.next();
      FrameTruth truth = simulator.truth(frame.time);
      shots.push_back({std::move(frame), std::move(truth)});
    }
  }
  static SceneDescription scene() {
    SceneDescription scene = small_scene();
    scene.sensor.read_noise = 0;
    scene.sensor.full_well = 1e6;
    scene.sensor.gain_difference = 0;
    scene.sensor.exposure_delay = 10;
    scene.render.samples = 16;
    return scene;
  }
  static Recording& shared() {
    static Recording recording;
    return recording;
  }
  Simulator simulator;
  std::vector<Shot> shots;
};

SE3 right_of(const SE3& world_from_left, const StereoRig& rig) {
  return world_from_left * SE3{Eigen::Matrix3d::Identity(), {rig.baseline, 0, 0}};
}

bool is_rigid(const FrameTruth& truth, int x, int y) {
  return truth.sky.at<std::uint8_t>(y, x) == 0 && truth.water.at<std::uint8_t>(y, x) == 0 &&
         truth.moving.at<std::uint8_t>(y, x) == 0;
}

// A wide even face around the pixel: inverse depth is linear in the image there.
bool is_plane(const FrameTruth& truth, int x, int y) {
  if (x < 2 || y < 2 || x + 2 >= truth.depth.cols || y + 2 >= truth.depth.rows) return false;
  const auto inverse = [&](int i, int j) { return 1 / truth.depth.at<float>(j, i); };
  for (int j = y - 1; j <= y + 1; ++j)
    for (int i = x - 1; i <= x + 1; ++i)
      if (truth.depth.at<float>(j, i) <= 0) return false;
  const float middle = inverse(x, y);
  for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}, {1, 1}, {1, -1}})
    if (std::abs(inverse(x + dx, y + dy) + inverse(x - dx, y - dy) - 2 * middle) > 1e-4F * middle)
      return false;
  return true;
}

double interpolated_inverse(const cv::Mat& depth, const Eigen::Vector2d& at) {
  const int x = static_cast<int>(at.x()), y = static_cast<int>(at.y());
  const double a = at.x() - x, b = at.y() - y;
  const auto inverse = [&](int i, int j) { return 1 / static_cast<double>(depth.at<float>(j, i)); };
  return (1 - b) * ((1 - a) * inverse(x, y) + a * inverse(x + 1, y)) +
         b * ((1 - a) * inverse(x, y + 1) + a * inverse(x + 1, y + 1));
}

// Pixels of `from` are carried to the other view by its depth, and back by the depth found there: the way
// they miss their start by, px, sorted.
std::vector<double> round_trip_errors(const FrameTruth& from, const SE3& world_from_first,
                                      const FrameTruth& to, const SE3& world_from_second,
                                      const StereoRig& rig) {
  std::vector<double> errors;
  const SE3 second_from_first = world_from_second.inverse() * world_from_first;
  for (int y = 0; y < rig.height; ++y)
    for (int x = 0; x < rig.width; ++x) {
      if (!is_rigid(from, x, y) || !is_plane(from, x, y)) continue;
      const Eigen::Vector3d point =
          second_from_first * (rig.bearing(x, y) * static_cast<double>(from.depth.at<float>(y, x)));
      if (point.z() < 0.1) continue;
      const Eigen::Vector2d there = rig.project(point);
      if (there.x() < 2 || there.y() < 2 || there.x() > rig.width - 3 || there.y() > rig.height - 3) continue;
      const int i = static_cast<int>(there.x() + 0.5), j = static_cast<int>(there.y() + 0.5);
      if (!is_rigid(to, i, j) || !is_plane(to, i, j)) continue;
      const double depth = 1 / interpolated_inverse(to.depth, there);
      if (std::abs(depth - point.z()) > 0.05 * depth) continue;  // something else stands before it
      const Eigen::Vector3d back = second_from_first.inverse() * (rig.bearing(there.x(), there.y()) * depth);
      errors.push_back((rig.project(back) - Eigen::Vector2d(x, y)).norm());
    }
  std::sort(errors.begin(), errors.end());
  return errors;
}

TEST(Geometry, DepthOfFrameFitsFrameFiveLater) {
  const Recording& r = Recording::shared();
  const auto errors = round_trip_errors(r.shots[0].truth, r.shots[0].frame.world_from_left, r.shots[5].truth,
                                        r.shots[5].frame.world_from_left, r.simulator.rig());
  ASSERT_GT(errors.size(), 500U);
  EXPECT_LT(errors[errors.size() * 99 / 100], 0.05);
}

TEST(Geometry, DepthFitsTheRightEye) {
  const Recording& r = Recording::shared();
  const SE3& left = r.shots[0].frame.world_from_left;
  const SE3 right = right_of(left, r.simulator.rig());
  const auto errors =
      round_trip_errors(r.shots[0].truth, left, r.simulator.truth(0, right), right, r.simulator.rig());
  ASSERT_GT(errors.size(), 500U);
  EXPECT_LT(errors[errors.size() * 99 / 100], 0.05);
}

TEST(Geometry, WaterIsThePlaneZeroOfTheWorld) {
  const Recording& r = Recording::shared();
  const StereoRig rig = r.simulator.rig();
  int pixels = 0;
  for (const Shot& shot : r.shots)
    for (int y = 0; y < rig.height; ++y)
      for (int x = 0; x < rig.width; ++x) {
        if (shot.truth.water.at<std::uint8_t>(y, x) == 0) continue;
        // Where the ray meets z = 0, worked out by hand; compared as disparity, in px.
        const Eigen::Vector3d ray = shot.frame.world_from_left.rotation * rig.bearing(x, y);
        const double depth = -shot.frame.world_from_left.translation.z() / ray.z();
        const double measured = static_cast<double>(shot.truth.depth.at<float>(y, x));
        ASSERT_NEAR(rig.disparity_per_inverse_depth() / measured, rig.disparity_per_inverse_depth() / depth,
                    0.01);
        ++pixels;
      }
  EXPECT_GT(pixels, 10000);
}

// Median difference of grey values between an image and another one carried over to it, where rigid.
double photometric_error(const Shot& from, const cv::Mat& image, const cv::Mat& other,
                         const SE3& other_from_first, const StereoRig& rig, double shift) {
  std::vector<double> differences;
  for (int y = 2; y < rig.height - 2; ++y)
    for (int x = 2; x < rig.width - 2; ++x) {
      if (!is_rigid(from.truth, x, y) || !is_plane(from.truth, x, y)) continue;
      const Eigen::Vector3d point =
          other_from_first * (rig.bearing(x, y) * static_cast<double>(from.truth.depth.at<float>(y, x)));
      const Eigen::Vector2d there = rig.project(point) + Eigen::Vector2d(shift, 0);
      if (there.x() < 1 || there.y() < 1 || there.x() > rig.width - 2 || there.y() > rig.height - 2) continue;
      cv::Mat patch;
      cv::getRectSubPix(other, cv::Size(1, 1),
                        cv::Point2f(static_cast<float>(there.x()), static_cast<float>(there.y())), patch);
      differences.push_back(
          std::abs(static_cast<double>(patch.at<std::uint8_t>(0, 0)) - image.at<std::uint8_t>(y, x)));
    }
  EXPECT_GT(differences.size(), 500U);
  std::sort(differences.begin(), differences.end());
  return differences.empty() ? 255 : differences[differences.size() / 2];
}

TEST(Geometry, RigidSurfacesLookTheSameInTheRightEye) {
  const Recording& r = Recording::shared();
  const Shot& shot = r.shots[0];
  const SE3 right_from_left{Eigen::Matrix3d::Identity(), {-r.simulator.rig().baseline, 0, 0}};
  const auto error = [&](double shift) {
    return photometric_error(shot, shot.frame.images.left, shot.frame.images.right, right_from_left,
                             r.simulator.rig(), shift);
  };
  EXPECT_LE(error(0), 3);
  EXPECT_GT(error(2), 1.5 * error(0));
}

TEST(Geometry, RigidSurfacesLookTheSameFiveFramesLater) {
  const Recording& r = Recording::shared();
  const Shot &first = r.shots[0], &last = r.shots[5];
  const SE3 last_from_first = last.frame.world_from_left.inverse() * first.frame.world_from_left;
  const auto error = [&](double shift) {
    return photometric_error(first, first.frame.images.left, last.frame.images.left, last_from_first,
                             r.simulator.rig(), shift);
  };
  EXPECT_LE(error(0), 5);
  EXPECT_GT(error(2), 1.3 * error(0));
}

TEST(Geometry, MasksAgreeWithDepth) {
  const Recording& r = Recording::shared();
  const FrameTruth& truth = r.shots[2].truth;
  for (int y = 0; y < truth.depth.rows; ++y)
    for (int x = 0; x < truth.depth.cols; ++x) {
      const float depth = truth.depth.at<float>(y, x);
      const bool sky = truth.sky.at<std::uint8_t>(y, x) != 0, water = truth.water.at<std::uint8_t>(y, x) != 0;
      ASSERT_EQ(sky, depth == 0);
      ASSERT_FALSE(sky && water);
      ASSERT_EQ(truth.far.at<std::uint8_t>(y, x) != 0, sky || depth > 40);
    }
  EXPECT_GT(cv::countNonZero(truth.sky), 1000);
  EXPECT_GT(cv::countNonZero(truth.water), 1000);
}

TEST(Geometry, TheSameBitsAtAnyNumberOfThreads) {
  const auto images = [](std::size_t threads) {
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
    SceneDescription scene = small_scene();
    scene.traffic.boats = 2;
    scene.rain.intensity = 0.5;
    scene.rain.lens_drops = 2;
    Simulator simulator(scene, 11);
    simulator.next();
    return simulator.next()->images;
  };
  const StereoFrame one = images(1), four = images(4);
  EXPECT_EQ(cv::norm(one.left, four.left, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(one.right, four.right, cv::NORM_INF), 0);
}

}  // namespace
}  // namespace spslam::sim
