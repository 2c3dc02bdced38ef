// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/odometry/follow.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <numeric>
#include <opencv2/imgproc.hpp>

#include "odometry/plane_scene.h"

namespace spslam {
namespace {

constexpr double kPositionError = 0.1, kDisparityError = 0.1;  // px, root mean square

const SE3 kMoved{so3_exp({0.015, -0.02, 0.03}), {0.06, -0.03, -0.15}};  // camera_from_world of the new frame

// A grid of landmarks on the plane, hosted by a keyframe at the origin.
ActiveMap grid_map(const test::PlaneScene& scene, int spacing = 16) {
  ActiveMap map;
  map.rig = scene.rig();
  map.hosts[{0}] = {{0}, {0}, 0, SE3{}, scene.frame(SE3{}).left, {}};
  for (int y = 40; y < map.rig.height - 40; y += spacing)
    for (int x = 40; x < map.rig.width - 40; x += spacing) {
      Landmark landmark;
      landmark.id = {static_cast<std::int64_t>(map.landmarks.size())};
      landmark.host = {0};
      landmark.pixel = {static_cast<float>(x), static_cast<float>(y)};
      landmark.bearing = map.rig.bearing(x, y);
      landmark.inverse_depth = scene.inverse_depth();
      map.landmarks.push_back({landmark, 0, 0, 0});
    }
  return map;
}

std::vector<int> all_of(const ActiveMap& map) {
  std::vector<int> indices(map.landmarks.size());
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

// Root mean square of the errors of u, v and disparity; disparities where they were measured.
Eigen::Vector3d errors_of(const ActiveMap& map, const SE3& pose, const std::vector<Sighting>& sightings) {
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  double disparities = 0;
  for (const Sighting& s : sightings) {
    const Landmark& l = map.landmarks[map.index_of(s.landmark)].landmark;
    Eigen::Vector3d error = linearize(map.rig, pose, l.bearing, l.inverse_depth, s.measured).residual;
    if (s.inverse_sigma.z() > 0)
      ++disparities;
    else
      error.z() = 0;
    squares += error.cwiseAbs2();
  }
  const auto count = static_cast<double>(sightings.size());
  return Eigen::Vector3d(squares.x() / count, squares.y() / count, squares.z() / disparities).cwiseSqrt();
}

TEST(Predict, IsTheProjectionAndItsDerivative) {
  const test::PlaneScene scene(1);
  const ActiveMap map = grid_map(scene, 40);
  for (const ActiveLandmark& active : map.landmarks) {
    const Landmark& landmark = active.landmark;
    const auto at = predict(map, landmark, kMoved);
    ASSERT_TRUE(at);
    const auto projected = [&](double dx, double dy) -> Eigen::Vector2d {
      const Eigen::Vector3d bearing = map.rig.bearing(landmark.pixel.x() + dx, landmark.pixel.y() + dy);
      return map.rig.project(kMoved * Eigen::Vector3d(bearing / landmark.inverse_depth));
    };
    EXPECT_LT((at->position - projected(0, 0)).norm(), 1e-9);
    Eigen::Matrix2d warp;
    warp << (projected(0.5, 0) - projected(-0.5, 0)), (projected(0, 0.5) - projected(0, -0.5));
    EXPECT_LT((at->camera_from_host.cast<double>() - warp).norm(), 0.01);
    const Eigen::Vector3d point = kMoved * Eigen::Vector3d(landmark.bearing / landmark.inverse_depth);
    EXPECT_NEAR(at->disparity, map.rig.disparity_per_inverse_depth() / point.z(), 1e-9);
  }
}

TEST(Predict, NothingBehindOrOutside) {
  const test::PlaneScene scene(1);
  const ActiveMap map = grid_map(scene, 40);
  const Landmark& landmark = map.landmarks[0].landmark;
  EXPECT_FALSE(predict(map, landmark, SE3{so3_exp({0, M_PI, 0}), {0, 0, 0}}));
  EXPECT_FALSE(predict(map, landmark, SE3{so3_exp({0, 1, 0}), {0, 0, 0}}));
  EXPECT_FALSE(predict(map, landmark, SE3{Eigen::Matrix3d::Identity(), {0, 0, -4}}));
}

TEST(FollowPatches, PositionsAreWithinATenthOfAPixel) {
  const test::PlaneScene scene(2);
  const ActiveMap map = grid_map(scene);
  const Frame frame = scene.frame(kMoved);
  const SE3 predicted = SE3{so3_exp({0.006, -0.004, 0.005}), {0.01, 0, 0}} * kMoved;  // 2 to 3 px off
  const std::vector<Sighting> found = follow_patches(map, all_of(map), frame, predicted, 2, {});
  EXPECT_GT(found.size(), 0.9 * static_cast<double>(map.landmarks.size()));
  const Eigen::Vector3d errors = errors_of(map, kMoved, found);
  EXPECT_LT(errors.x(), kPositionError);
  EXPECT_LT(errors.y(), kPositionError);
  EXPECT_LT(errors.z(), kDisparityError);
  const auto with_disparity =
      std::count_if(found.begin(), found.end(), [](const Sighting& s) { return s.inverse_sigma.z() > 0; });
  EXPECT_GT(static_cast<double>(with_disparity), 0.9 * static_cast<double>(found.size()));
}

TEST(FollowPatches, ScoutsFindTheirWayFromFarOff) {
  const test::PlaneScene scene(3);
  const ActiveMap map = grid_map(scene, 32);
  const Frame frame = scene.frame(kMoved);
  const SE3 predicted = SE3{so3_exp({0.03, -0.02, 0}), {0, 0, 0}} * kMoved;  // 10 px off
  const TrackerOptions options;
  const std::vector<Sighting> found =
      follow_patches(map, all_of(map), frame, predicted, options.follow.scout_levels, options);
  EXPECT_GT(found.size(), 0.6 * static_cast<double>(map.landmarks.size()));
  std::vector<double> errors;
  for (const Sighting& s : found) {
    const Landmark& l = map.landmarks[map.index_of(s.landmark)].landmark;
    errors.push_back(
        linearize(map.rig, kMoved, l.bearing, l.inverse_depth, s.measured).residual.head<2>().norm());
  }
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2),
                   errors.end());
  EXPECT_LT(errors[errors.size() / 2], kPositionError);
}

TEST(FollowPatches, NothingIsFoundWhereThereIsNothing) {
  const test::PlaneScene scene(4), other(5);
  const ActiveMap map = grid_map(scene);
  const std::vector<Sighting> strange = follow_patches(map, all_of(map), other.frame(SE3{}), SE3{}, 2, {});
  EXPECT_LT(static_cast<double>(strange.size()), 0.1 * static_cast<double>(map.landmarks.size()));
  Frame blank;
  blank.left = blank.right = AlignmentPyramid(cv::Mat(240, 320, CV_8UC1, cv::Scalar(120)), 4);
  EXPECT_TRUE(follow_patches(map, all_of(map), blank, SE3{}, 2, {}).empty());
}

TEST(FollowPatches, SameSightingsAtAnyNumberOfThreadsInTheOrderGiven) {
  const test::PlaneScene scene(2);
  const ActiveMap map = grid_map(scene);
  const Frame frame = scene.frame(kMoved);
  const auto run = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return follow_patches(map, all_of(map), frame, kMoved, 2, {});
  };
  const std::vector<Sighting> one = run(1), two = run(2);
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].landmark, two[i].landmark);
    EXPECT_EQ(one[i].measured, two[i].measured);
    if (i > 0) {
      EXPECT_LT(one[i - 1].landmark, one[i].landmark);
    }
  }
}

TEST(AlignDisparity, MeasuresThePlane) {
  const test::PlaneScene scene(6);
  const Frame frame = scene.frame(SE3{});
  const double truth = scene.rig().disparity_per_inverse_depth() * scene.inverse_depth();
  double squares = 0;
  int count = 0, asked = 0;
  for (int y = 40; y < 200; y += 20)
    for (int x = 60; x < 280; x += 20, ++asked)
      if (const auto disparity =
              align_disparity(frame, {static_cast<float>(x), static_cast<float>(y)}, truth + 1.2, 1, {}))
        squares += (*disparity - truth) * (*disparity - truth), ++count;
  EXPECT_GT(count, 0.9 * asked);
  EXPECT_LT(std::sqrt(squares / count), kDisparityError);
}

// The frame's features: one at each landmark's true place with its descriptor, so that each has one match.
Frame frame_with_features(const test::PlaneScene& scene, ActiveMap& map, Random& random) {
  Frame frame = scene.frame(kMoved);
  for (ActiveLandmark& active : map.landmarks) {
    for (std::uint64_t& word : active.landmark.descriptor)
      word = (static_cast<std::uint64_t>(random.next()) << 32U) | random.next();
    const auto at = predict(map, active.landmark, kMoved);
    if (!at) continue;
    Keypoint keypoint;
    keypoint.x = static_cast<float>(at->position.x() + 0.5 * random.normal());
    keypoint.y = static_cast<float>(at->position.y() + 0.5 * random.normal());
    frame.features.keypoints.push_back(keypoint);
    frame.features.descriptors.push_back(active.landmark.descriptor);
  }
  frame.stereo.resize(frame.features.keypoints.size());
  return frame;
}

TEST(FollowDescriptors, FindsTheIdentityAndAlignsThePosition) {
  const test::PlaneScene scene(7);
  ActiveMap map = grid_map(scene);
  Random random(7);
  const Frame frame = frame_with_features(scene, map, random);
  const SE3 predicted = SE3{so3_exp({0.02, -0.015, 0}), {0, 0, 0}} * kMoved;  // 7 px off
  const std::vector<Sighting> found = follow_descriptors(map, all_of(map), frame, predicted, {});
  EXPECT_GT(found.size(), 0.85 * static_cast<double>(map.landmarks.size()));
  const Eigen::Vector3d errors = errors_of(map, kMoved, found);
  EXPECT_LT(errors.head<2>().maxCoeff(), kPositionError);
}

TEST(FollowDescriptors, AmbiguousMatchesAreDropped) {
  const test::PlaneScene scene(7);
  ActiveMap map = grid_map(scene);
  Random random(7);
  Frame frame = frame_with_features(scene, map, random);
  const std::size_t features = frame.features.keypoints.size();
  for (std::size_t i = 0; i < features; ++i) {  // each once more, 3 px beside
    Keypoint twin = frame.features.keypoints[i];
    twin.x += 3;
    frame.features.keypoints.push_back(twin);
    frame.features.descriptors.push_back(frame.features.descriptors[i]);
  }
  frame.stereo.resize(frame.features.keypoints.size());
  // Equal descriptors: a distance of one bit, so that the ratio is not 0 / 0.
  for (ActiveLandmark& active : map.landmarks) active.landmark.descriptor[0] ^= 1U;
  EXPECT_TRUE(follow_descriptors(map, all_of(map), frame, kMoved, {}).empty());
}

// A texture seen through pixels that are too few for it: much of it is folded back below the sampling rate
// and moves the wrong way. `shift` in quarters of a pixel to the left.
cv::Mat aliased_image(int shift) {
  constexpr int kFine = 4, kWidth = 320, kHeight = 240;
  Random random(5);
  cv::Mat fine(kFine * kHeight, kFine * (kWidth + 2), CV_32F);
  for (int y = 0; y < fine.rows; ++y)
    for (int x = 0; x < fine.cols; ++x) fine.at<float>(y, x) = static_cast<float>(random.normal());
  cv::GaussianBlur(fine, fine, {}, 1.6);
  cv::Mat image(kHeight, kWidth, CV_8U);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      image.at<unsigned char>(y, x) =
          cv::saturate_cast<unsigned char>(128 + 150 * fine.at<float>(kFine * y, kFine * x + shift));
  return image;
}

// A pair of them, a quarter of a pixel apart; sigma: of the blur of its softened images.
Frame aliased_pair(double sigma) {
  Frame frame;
  frame.left = AlignmentPyramid(aliased_image(0), 4);
  frame.right = AlignmentPyramid(aliased_image(1), 4);
  if (sigma > 0) frame.soft_left = frame.left.softened(sigma);
  if (sigma > 0) frame.soft_right = frame.right.softened(sigma);
  return frame;
}

// The mean disparity of the points of a grid, by the fraction of a pixel at which they lie in the left image.
std::vector<double> mean_disparities(const Frame& frame, const TrackerOptions& options) {
  std::vector<double> means;
  for (const float fraction : {0.0F, 0.25F, 0.5F, 0.75F}) {
    double sum = 0;
    int count = 0;
    for (int y = 20; y < 220; y += 5)
      for (int x = 20; x < 300; x += 5) {
        const Eigen::Vector2f at(static_cast<float>(x) + fraction, static_cast<float>(y));
        if (const auto d = align_disparity(frame, at, 0, 0, options)) sum += *d, ++count;
      }
    EXPECT_GT(count, 200);
    means.push_back(sum / count);
  }
  return means;
}

TEST(AlignDisparity, ABlurTakesPartOfTheBiasByAliasingAway) {
  constexpr double kTrue = 0.25;  // px
  const std::vector<double> sharp = mean_disparities(aliased_pair(0), {});
  const std::vector<double> soft = mean_disparities(aliased_pair(0.7), {});
  const auto bias = [&](const std::vector<double>& all) {
    return std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size()) - kTrue;
  };
  const auto spread = [](const std::vector<double>& all) {
    const auto [low, high] = std::ranges::minmax(all);
    return high - low;
  };
  EXPECT_LT(bias(sharp), -0.01);  // too small
  EXPECT_LT(std::abs(bias(soft)), 0.8 * std::abs(bias(sharp)));
  EXPECT_LT(spread(soft), 0.8 * spread(sharp));
}

TEST(AlignDisparity, LargeDisparitiesAreMeasuredInTheImagesAsTheyAre) {
  TrackerOptions options;
  options.follow.soft_disparity = 0;  // none is below it
  EXPECT_EQ(mean_disparities(aliased_pair(0.7), options), mean_disparities(aliased_pair(0), options));
}

}  // namespace
}  // namespace spslam
