// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/loop/patch_pose.h"

#include <gmock/gmock.h>

#include <cmath>

#include "odometry/plane_scene.h"
#include "spslam/map/keyframe_image.h"

namespace spslam {
namespace {

constexpr int kLevels = 4;
const std::vector<KeyframeId> kBoth = {{0}, {1}};

// Two keyframes before a plane, each the host of a grid of landmarks whose depths are right.
Map plane_map(const test::PlaneScene& scene, bool with_images = true) {
  Map map;
  for (const int k : {0, 1}) {
    Keyframe keyframe;
    keyframe.id = {k};
    if (k > 0) keyframe.parent = {0};
    keyframe.camera_from_world.translation.x() = -0.3 * k;
    if (with_images) keyframe.image = compress(scene.render(keyframe.camera_from_world), 90);
    for (int i = 0; i < 48; ++i) {
      Landmark landmark;
      landmark.id = {100 * k + i};
      landmark.host = keyframe.id;
      landmark.pixel = {40.0F + 30 * static_cast<float>(i % 8), 40.0F + 30 * static_cast<float>(i / 8)};
      landmark.bearing = scene.rig().bearing(landmark.pixel.x(), landmark.pixel.y());
      landmark.inverse_depth = scene.inverse_depth();
      landmark.information = 1e6;
      map.add(landmark);
      keyframe.sightings.push_back({landmark.id});
    }
    map.add(std::move(keyframe));
  }
  return map;
}

const SE3 kTruth{so3_exp({0.01, -0.02, 0.03}), {-0.2, 0.05, 0.1}};

double position_error(const SE3& pose) {
  return distance_of_centres(pose, kTruth);
}

// What features leave open: a few pixels.
SE3 near_the_truth() {
  return SE3::exp((Vector6d() << 0.06, -0.05, 0.04, 0.01, -0.008, 0.01).finished()) * kTruth;
}

AlignmentPyramid seen(const cv::Mat& image) {
  return {image, kLevels, true};
}

TEST(PatchPose, FindsTheTruthFromWhatFeaturesLeaveOpen) {
  const test::PlaneScene scene(11);
  const Map map = plane_map(scene);
  const SE3 start = near_the_truth();
  EXPECT_GT(position_error(start), 0.05);
  const auto found = pose_by_patches(map, scene.rig(), seen(scene.render(kTruth)), start, kBoth, {});
  ASSERT_TRUE(found);
  EXPECT_LT(position_error(found->camera_from_world), 0.003);
  EXPECT_LT(found->position_sigma(), 0.02);
  EXPECT_LT(squared_distance(*found, {kTruth, Matrix6d::Identity() * 1e-12}), kPoseGate);
}

// Gain and offset of brightness do not count: another exposure, another sun.
TEST(PatchPose, AnotherLightIsNoOtherPlace) {
  const test::PlaneScene scene(11);
  cv::Mat image;
  scene.render(kTruth).convertTo(image, CV_8UC1, 0.5, 70);
  const auto found = pose_by_patches(plane_map(scene), scene.rig(), seen(image), near_the_truth(), kBoth, {});
  ASSERT_TRUE(found);
  EXPECT_LT(position_error(found->camera_from_world), 0.003);
}

TEST(PatchPose, WhatIsInTheWayIsLeftOut) {
  const test::PlaneScene scene(11), other(21);
  cv::Mat image = scene.render(kTruth);
  const cv::Rect boat(0, 0, 130, 240);
  other.render(kTruth)(boat).copyTo(image(boat));
  const auto found = pose_by_patches(plane_map(scene), scene.rig(), seen(image), near_the_truth(), kBoth, {});
  ASSERT_TRUE(found);
  EXPECT_LT(position_error(found->camera_from_world), 0.01);
}

TEST(PatchPose, NothingFromAnotherPlace) {
  const test::PlaneScene scene(11), other(21);
  EXPECT_FALSE(pose_by_patches(plane_map(scene), scene.rig(), seen(other.render(kTruth)), near_the_truth(),
                               kBoth, {}));
}

TEST(PatchPose, NothingWithoutImages) {
  const test::PlaneScene scene(11);
  const AlignmentPyramid image = seen(scene.render(kTruth));
  EXPECT_FALSE(pose_by_patches(plane_map(scene, false), scene.rig(), image, kTruth, kBoth, {}));
  EXPECT_FALSE(pose_by_patches({}, scene.rig(), image, kTruth, kBoth, {}));
  EXPECT_FALSE(pose_by_patches(plane_map(scene), scene.rig(), {}, kTruth, kBoth, {}));
  PatchPoseOptions off;
  off.enabled = false;
  EXPECT_FALSE(pose_by_patches(plane_map(scene), scene.rig(), image, kTruth, kBoth, off));
}

TEST(PatchPose, NumbersThatAreNotFiniteAreNothing) {
  const test::PlaneScene scene(11);
  const AlignmentPyramid image = seen(scene.render(kTruth));
  const SE3 nowhere{Eigen::Matrix3d::Identity(), {std::nan(""), 0, 0}};
  EXPECT_FALSE(pose_by_patches(plane_map(scene), scene.rig(), image, nowhere, kBoth, {}));
}

TEST(KeyframeImage, IsWhatItWasToAFewGreyValues) {
  const cv::Mat grey = test::PlaneScene(11).render({});
  const auto bytes = compress(grey, 90);
  ASSERT_TRUE(bytes);
  EXPECT_LT(bytes->size(), grey.total() / 2);
  const cv::Mat again = decompress(*bytes, grey.cols, grey.rows);
  ASSERT_EQ(again.size(), grey.size());
  EXPECT_LT(cv::norm(grey, again, cv::NORM_L2) / std::sqrt(static_cast<double>(grey.total())), 2);
}

TEST(KeyframeImage, OtherBytesAreNone) {
  const cv::Mat grey = test::PlaneScene(11).render({});
  ImageBytes bytes = *compress(grey, 90);
  EXPECT_TRUE(decompress(bytes, grey.cols + 1, grey.rows).empty());
  EXPECT_TRUE(decompress({}, grey.cols, grey.rows).empty());
  EXPECT_TRUE(decompress({0x89, 'P', 'N', 'G'}, grey.cols, grey.rows).empty());
  bytes.resize(20);
  EXPECT_TRUE(decompress(bytes, grey.cols, grey.rows).empty());
  EXPECT_FALSE(compress({}, 90));
}

TEST(KeyframesOfPlace, ThoseThatShareMostAndNotTheExcludedOnes) {
  Map map;
  for (int i = 0; i < 4; ++i) {
    Landmark landmark;
    landmark.id = {i}, landmark.host = {0};
    map.add(landmark);
  }
  for (int k = 0; k < 4; ++k) {  // keyframe k shares 4 - k landmarks with the first
    Keyframe keyframe;
    keyframe.id = {k};
    for (int i = k; i < 4; ++i) keyframe.sightings.push_back({{i}});
    map.add(std::move(keyframe));
  }
  const auto of = [&](int count, const std::set<KeyframeId>& exclude) {
    return keyframes_of_place(map, {0}, count, exclude);
  };
  EXPECT_THAT(of(3, {}), testing::ElementsAre(KeyframeId{0}, KeyframeId{1}, KeyframeId{2}));
  EXPECT_THAT(of(9, {{1}}), testing::ElementsAre(KeyframeId{0}, KeyframeId{2}, KeyframeId{3}));
}

}  // namespace
}  // namespace spslam
