// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/mapping/triangulate.h"

#include <gmock/gmock.h>

#include <opencv2/imgproc.hpp>

#include "mapping/feature_world.h"

namespace spslam {
namespace {

using test::FeatureWorld;
using test::FeatureWorldOptions;
using test::make_feature_world;

constexpr LandmarkId kFirst{1000};

// As the world's noise is: 0.8 px in each view.
TriangulationOptions exact_motion() {
  TriangulationOptions options;
  options.enabled = true;
  options.motion_sigma = 0;
  options.least_shared = 5;
  return options;
}

DepthView view_of(const StereoRig& rig, const SE3& motion, const Eigen::Vector3d& point, double sigma,
                  double disparity_sigma, Random& random) {
  const Eigen::Vector3d x = motion * point;
  const Eigen::Vector2d p = rig.project(x);
  const double inverse = disparity_sigma > 0 ? 1 / disparity_sigma : 0;
  return {motion,
          {p.x() + sigma * random.normal(), p.y() + sigma * random.normal(),
           rig.disparity_per_inverse_depth() / x.z() + disparity_sigma * random.normal()},
          {1 / sigma, 1 / sigma, inverse}};
}

// Mean of 6000 squares of standard normal numbers: within 1 +- 1.96 sqrt(2 / 6000) in 95 % of all cases.
TEST(TriangulateDepth, ErrorsAreAsLargeAsTheySay) {
  const StereoRig rig = test::feature_rig();
  Random random(11);
  constexpr int kCount = 6000;
  double sum = 0;
  for (int i = 0; i < kCount; ++i) {
    const Eigen::Vector3d bearing = rig.bearing(random.uniform(150, 500), random.uniform(50, 300));
    const double depth = random.uniform(2, 12);
    const SE3 motion{so3_exp({0.01, -0.02, 0.015}),
                     {-random.uniform(0.2, 0.6), 0.05, -random.uniform(0, 0.5)}};
    const double disparity_sigma = i % 2 == 0 ? 0.12 : 0;
    const std::vector<DepthView> views = {view_of(rig, motion, depth * bearing, 0.5, disparity_sigma, random),
                                          view_of(rig, motion * motion, depth * bearing, 0.5, 0, random)};
    const auto found = triangulate(rig, bearing, views);
    ASSERT_TRUE(found) << i;
    sum += std::pow(found->inverse_depth - 1 / depth, 2) * found->information;
  }
  EXPECT_NEAR(sum / kCount, 1, 1.96 * std::sqrt(2.0 / kCount));
}

TEST(TriangulateDepth, OfTheDisparityAlone) {
  const StereoRig rig = test::feature_rig();
  DepthView view;
  view.measured.z() = 4, view.inverse_sigma.z() = 10;
  const auto found = triangulate(rig, rig.bearing(300, 200), {&view, 1});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->inverse_depth, 4 / rig.disparity_per_inverse_depth(), 1e-12);
}

TEST(TriangulateDepth, NothingWithoutParallaxBehindOrOutOfNumbers) {
  const StereoRig rig = test::feature_rig();
  const Eigen::Vector3d bearing = rig.bearing(400, 100);
  const double nan = std::nan("");
  const DepthView turned{{so3_exp({0.01, 0.02, 0}), {0, 0, 0}}, {390, 110, 0}, {1, 1, 0}};
  const DepthView behind{{so3_exp({0, 3.1, 0}), {0.3, 0, 0}}, {390, 110, 0}, {1, 1, 0}};
  const DepthView no_number{{Eigen::Matrix3d::Identity(), {-0.3, 0, 0}}, {nan, 110, 0}, {1, 1, 0}};
  const DepthView no_motion{{Eigen::Matrix3d::Identity(), {nan, 0, 0}}, {390, 110, 0}, {1, 1, 0}};
  for (const DepthView& view : {turned, behind, no_number, no_motion})
    EXPECT_FALSE(triangulate(rig, bearing, {&view, 1}));
  EXPECT_FALSE(triangulate(rig, bearing, {}));
}

TEST(EpipolarMatching, FindsWhatIsTheSameAndNothingElse) {
  FeatureWorldOptions options;
  options.noise = 0.3;
  const FeatureWorld world = make_feature_world(options);
  const Keyframe &a = *world.map.find(KeyframeId{0}), &b = *world.map.find(KeyframeId{1});
  std::vector<int> of_a(a.features->size()), of_b(b.features->size());
  for (std::size_t i = 0; i < of_a.size(); ++i) of_a[i] = static_cast<int>(i);
  for (std::size_t i = 0; i < of_b.size(); ++i) of_b[i] = static_cast<int>(i);
  const SE3 motion = b.camera_from_world * a.camera_from_world.inverse();
  const auto matches =
      match_along_epipolar_lines(world.rig, *a.features, of_a, *b.features, of_b, motion, 1.2, {});
  EXPECT_GT(matches.size(), 80U);
  const auto point = [&](int k, const KeyframeFeatures& features, int i) {
    const Keypoint& at = features.keypoints[static_cast<std::size_t>(i)];
    return world.point_at[k].at({at.x, at.y});
  };
  for (const EpipolarMatch& match : matches)
    EXPECT_EQ(point(0, *a.features, match.first), point(1, *b.features, match.second));
  const SE3 still{motion.rotation, {0, 0, 0}};
  EXPECT_TRUE(
      match_along_epipolar_lines(world.rig, *a.features, of_a, *b.features, of_b, still, 1.2, {}).empty());
}

// Two features that look alike on one line: neither is taken. Off the line the other one does no harm.
TEST(EpipolarMatching, AmbiguousOnesAreLeft) {
  const StereoRig rig = test::feature_rig();
  Random random(3);
  const Descriptor descriptor = test::random_descriptor(random);
  KeyframeFeatures first, second;
  first.keypoints = {{300, 100, 0, 0, 0}};
  first.descriptors = {descriptor};
  second.keypoints = {{280, 100.5, 0, 0, 0}, {250, 99.5, 0, 0, 0}};
  second.descriptors = {test::flip_bits(descriptor, 9, random), test::flip_bits(descriptor, 10, random)};
  const SE3 sideways{Eigen::Matrix3d::Identity(), {-0.3, 0, 0}};
  EXPECT_TRUE(match_along_epipolar_lines(rig, first, {0}, second, {0, 1}, sideways, 1.2, {}).empty());
  second.keypoints[1].y = 140;
  EXPECT_THAT(match_along_epipolar_lines(rig, first, {0}, second, {0, 1}, sideways, 1.2, {}),
              testing::ElementsAre(testing::Field(&EpipolarMatch::second, 0)));
}

// The truth of a landmark that was made: the point of the feature that its host has at its pixel.
const Eigen::Vector3d& true_point(const FeatureWorld& world, const Landmark& landmark) {
  const auto host = static_cast<std::size_t>(landmark.host.value);
  return world
      .points[static_cast<std::size_t>(world.point_at[host].at({landmark.pixel.x(), landmark.pixel.y()}))];
}

// 95 % of the means of so many squares lie nearer to 1 than 1.96 sqrt(2 / n). The inliers of a chi-square
// test at 95 % have a little less than 1: 0.88 at worst, if its whole power fell on the depth.
TEST(AddLandmarksBetween, DepthsAreWithinTheirOwnSigma) {
  double sum = 0;
  int made = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    FeatureWorldOptions options;
    options.seed = seed;
    options.noise = 0.7;
    FeatureWorld world = make_feature_world(options);
    LandmarkId next = kFirst;
    made += add_landmarks_between(world.map, world.rig, {2}, 1.2, exact_motion(), next);
    for (const auto& [id, landmark] : world.map.landmarks()) {
      if (id < kFirst) continue;
      const Keyframe& host = *world.map.find(landmark.host);
      const double truth = 1 / (host.camera_from_world * true_point(world, landmark)).z();
      sum += std::pow(landmark.inverse_depth - truth, 2) * landmark.information;
      EXPECT_LT(std::abs(landmark.inverse_depth - truth) * std::sqrt(landmark.information), 5);
    }
  }
  ASSERT_GT(made, 200);
  const double band = 1.96 * std::sqrt(2.0 / made);
  EXPECT_GT(sum / made, 0.77 * 0.88 - band);  // 0.77: the noise is 0.7 px, not the 0.8 that is assumed
  EXPECT_LT(sum / made, 1 + band);
}

TEST(AddLandmarksBetween, EachIsHostedByAnOlderKeyframeAndSeenWhereItIs) {
  FeatureWorld world = make_feature_world({});
  const std::size_t before = world.map.landmarks().size();
  LandmarkId next = kFirst;
  const int made = add_landmarks_between(world.map, world.rig, {2}, 1.2, exact_motion(), next);
  EXPECT_GT(made, 30);
  EXPECT_EQ(next.value, kFirst.value + made);
  EXPECT_EQ(world.map.landmarks().size(), before + static_cast<std::size_t>(made));
  for (const auto& [id, landmark] : world.map.landmarks()) {
    if (id < kFirst) continue;
    EXPECT_LT(landmark.host, KeyframeId{2});
    EXPECT_GT(landmark.inverse_depth, 0);
    EXPECT_EQ(landmark.region, Region::kNear);
    const std::vector<KeyframeId>& observers = world.map.observers(id);
    EXPECT_THAT(observers, testing::Contains(landmark.host));
    EXPECT_THAT(observers, testing::Contains(KeyframeId{2}));
    for (const KeyframeId observer : observers) {
      const Keyframe& keyframe = *world.map.find(observer);
      const Eigen::Vector2d truth =
          world.rig.project(keyframe.camera_from_world * true_point(world, landmark));
      EXPECT_LT((find_sighting(keyframe, id)->measured.head<2>() - truth).norm(), 5 * 0.8);
    }
  }
  EXPECT_EQ(add_landmarks_between(world.map, world.rig, {2}, 1.2, exact_motion(), next), 0);  // all belong
}

TEST(AddLandmarksBetween, TheSameBitsEveryTime) {
  FeatureWorld a = make_feature_world({}), b = make_feature_world({});
  LandmarkId first = kFirst, second = kFirst;
  EXPECT_EQ(add_landmarks_between(a.map, a.rig, {2}, 1.2, exact_motion(), first),
            add_landmarks_between(b.map, b.rig, {2}, 1.2, exact_motion(), second));
  for (const auto& [id, landmark] : a.map.landmarks())
    EXPECT_EQ(landmark.inverse_depth, b.map.find(id)->inverse_depth);
}

int made_in(FeatureWorld& world, const TriangulationOptions& options = exact_motion()) {
  LandmarkId next = kFirst;
  return add_landmarks_between(world.map, world.rig, {2}, 1.2, options, next);
}

template <class Change>
void change_features(FeatureWorld& world, KeyframeId id, Change change) {
  auto features = std::make_shared<KeyframeFeatures>(*world.map.find(id)->features);
  change(*features);
  world.map.set_features(id, features);
}

// Descriptors handed on from feature to feature: whatever matches now is wrong, and the few that lie on a
// line by chance are off in what else is asked.
TEST(AddLandmarksBetween, NoLandmarkFromWrongMatches) {
  FeatureWorldOptions options;
  options.cameras = 3;
  FeatureWorld world = make_feature_world(options);
  const int right = made_in(world);
  FeatureWorld wrong = make_feature_world(options);
  change_features(wrong, {2}, [](KeyframeFeatures& features) {
    std::rotate(features.descriptors.begin(), features.descriptors.begin() + 7, features.descriptors.end());
  });
  EXPECT_LE(made_in(wrong), right / 25);
  FeatureWorld unlike = make_feature_world(options);
  change_features(unlike, {2}, [](KeyframeFeatures& features) {
    Random random(77);
    for (Descriptor& d : features.descriptors) d = test::random_descriptor(random);
  });
  EXPECT_EQ(made_in(unlike), 0);
}

TEST(AddLandmarksBetween, TooLittleParallaxMakesNone) {
  FeatureWorldOptions options;
  options.step = {0.01, 0, 0.005};
  FeatureWorld world = make_feature_world(options);
  EXPECT_EQ(made_in(world), 0);
  options.step = {0, 0, 0};
  FeatureWorld still = make_feature_world(options);
  EXPECT_EQ(made_in(still), 0);
}

TEST(AddLandmarksBetween, SizesThatDoNotFitTheDistancesAreRefused) {
  FeatureWorld world = make_feature_world({});
  change_features(world, {2}, [](KeyframeFeatures& features) {
    for (Keypoint& keypoint : features.keypoints) keypoint.octave = 5;  // 2.5 times as large
  });
  EXPECT_EQ(made_in(world), 0);
}

TEST(AddLandmarksBetween, NumbersThatAreNotFiniteMakeNone) {
  FeatureWorld features = make_feature_world({});
  change_features(features, {2}, [](KeyframeFeatures& f) {
    for (Keypoint& keypoint : f.keypoints) keypoint.y = std::nanf("");
  });
  EXPECT_EQ(made_in(features), 0);
  FeatureWorld pose = make_feature_world({});
  SE3 nowhere = pose.map.find(KeyframeId{2})->camera_from_world;
  nowhere.translation.x() = std::nan("");
  pose.map.set_pose({2}, nowhere);
  EXPECT_EQ(made_in(pose), 0);
  FeatureWorld others = make_feature_world({});
  for (const KeyframeId id : {KeyframeId{0}, KeyframeId{1}}) others.map.set_pose(id, nowhere);
  EXPECT_EQ(made_in(others), 0);
}

TEST(AddLandmarksBetween, WhatTheMirrorShowsIsLeft) {
  FeatureWorld world = make_feature_world({});
  for (const auto& [id, landmark] : std::map(world.map.landmarks())) {
    Landmark mirrored = landmark;
    mirrored.region = Region::kMirror;
    world.map.erase(id);
    world.map.add(mirrored);
  }
  // Their sightings are gone with them: seen again, so that the keyframes are covisible.
  const FeatureWorld same = make_feature_world({});
  for (const auto& [id, keyframe] : same.map.keyframes())
    for (const Sighting& sighting : keyframe.sightings) world.map.set_sighting(id, sighting);
  EXPECT_EQ(made_in(world), 0);
}

TEST(AddLandmarksBetween, SwitchedOffOrWithoutFeaturesNothingHappens) {
  FeatureWorld world = make_feature_world({});
  TriangulationOptions off;
  off.enabled = false;
  EXPECT_EQ(made_in(world, off), 0);
  world.map.set_features({2}, nullptr);
  EXPECT_EQ(made_in(world), 0);
  LandmarkId next = kFirst;
  EXPECT_EQ(add_landmarks_between(world.map, world.rig, {77}, 1.2, exact_motion(), next), 0);
  EXPECT_EQ(next, kFirst);
}

// A wall 4 m away that fills the image; the camera steps to the right.
TEST(FindPatch, FindsThePointOfTheHostToATenthOfAPixel) {
  const StereoRig rig = test::feature_rig();
  const cv::Mat wall = test::textured_wall(rig);
  cv::Mat moved;
  const double step = 0.12, depth = 4, shift = rig.fx * step / depth;  // 11.4 px
  cv::warpAffine(wall, moved, cv::Matx23d(1, 0, -shift, 0, 1, 0), wall.size(), cv::INTER_CUBIC);
  Keyframe host, camera;
  host.id = {0}, camera.id = {1};
  host.left = AlignmentPyramid(wall, 3), camera.left = AlignmentPyramid(moved, 3);
  camera.camera_from_world.translation.x() = -step;
  Landmark landmark;
  landmark.host = {0};
  landmark.pixel = {300, 150};
  landmark.bearing = rig.bearing(300, 150);
  landmark.inverse_depth = 1 / depth;
  const Eigen::Vector2d truth(300 - shift, 150);
  const auto found = find_patch(rig, host, landmark, camera, truth + Eigen::Vector2d(1.2, -0.8), 3, {});
  ASSERT_TRUE(found);
  EXPECT_LT((*found - truth).norm(), 0.1);
  EXPECT_FALSE(find_patch(rig, host, landmark, camera, truth + Eigen::Vector2d(1.2, -0.8), 0.5, {}));
  const double nan = std::nan("");
  EXPECT_FALSE(find_patch(rig, host, landmark, camera, {nan, nan}, 3, {}));
  camera.left = {};
  EXPECT_FALSE(find_patch(rig, host, landmark, camera, truth, 3, {}));
}

}  // namespace
}  // namespace spslam
