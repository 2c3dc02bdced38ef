// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "spslam/segmentation/distance_segmenter.h"

#include <gtest/gtest.h>

#include "segmentation/test_scenes.h"
#include "spslam/base/error.h"

namespace spslam {
namespace {

using test::kSceneSize;
using test::Scene;

TEST(DistanceSegmenter, FindsTheSkyAndItsMirrorImage) {
  DistanceSegmenter segmenter;
  const SegmentationResult result = segmenter.update(Scene{}.draw(kSceneSize, 1));
  EXPECT_TRUE(result.has_far);
  EXPECT_FALSE(result.held);
  EXPECT_GT(result.threshold, 65);
  EXPECT_LT(result.threshold, 165);
  EXPECT_GT(result.bimodality, 0.8);
  EXPECT_EQ(result.regions.at(320, 30), Region::kFar);
  EXPECT_EQ(result.regions.at(320, 290), Region::kMirror);
  EXPECT_EQ(result.regions.at(320, 200), Region::kNear);
  // The outline grows by 25 px and no more than a pixel or two else.
  for (int x = 40; x < 600; x += 20) {
    const int y = Scene::outline(kSceneSize, x);
    EXPECT_EQ(result.regions.at(static_cast<float>(x), static_cast<float>(y + 20)), Region::kFar) << x;
    EXPECT_EQ(result.regions.at(static_cast<float>(x), static_cast<float>(y + 36)), Region::kNear) << x;
  }
}

TEST(DistanceSegmenter, LabelsKeypointsByTheirPixel) {
  DistanceSegmenter segmenter;
  const SegmentationResult result = segmenter.update(Scene{}.draw(kSceneSize, 1));
  const std::vector<Keypoint> keypoints = {{320, 30}, {320, 200}, {320, 290}, {-5, 10}};
  const std::vector<Region> expected = {Region::kFar, Region::kNear, Region::kMirror, Region::kNear};
  EXPECT_EQ(label_keypoints(result.regions, keypoints), expected);
}

TEST(DistanceSegmenter, LeavesUnimodalFramesNear) {
  const Scene no_sky{.sky = 0, .land = 90, .water = 90, .mirror = 0, .noise = 25};
  const Scene low_contrast{.sky = 80, .land = 62, .water = 60, .mirror = 80, .noise = 1};
  const Scene speck{.sky = 0, .land = 60, .water = 60, .mirror = 0};
  for (const Scene& scene : {no_sky, low_contrast, speck}) {
    DistanceSegmenter segmenter;
    cv::Mat image = scene.draw(kSceneSize, 2);
    image(cv::Rect(30, 30, 40, 40)).setTo(250);
    const SegmentationResult result = segmenter.update(image);
    EXPECT_FALSE(result.has_far);
    EXPECT_EQ(result.regions.size, kSceneSize);
    EXPECT_EQ(cv::countNonZero(result.regions.mask()), 0);
  }
}

TEST(DistanceSegmenter, AcceptsAnyImage) {
  DistanceSegmenter segmenter;
  EXPECT_FALSE(segmenter.update(cv::Mat()).has_far);
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(3, 2), cv::Size(640, 1), cv::Size(1242, 375)}) {
    for (const int grey : {0, 128, 255})
      EXPECT_FALSE(segmenter.update(cv::Mat(size, CV_8UC1, cv::Scalar(grey))).has_far);
  }
  EXPECT_THROW(segmenter.update(cv::Mat(8, 8, CV_8UC3)), InputError);
  SegmentationOptions options;
  options.window = 0;
  EXPECT_THROW(DistanceSegmenter{options}, OptionError);
}

// The exposure jumps: the sky saturates and all else is as bright as the sky was.
TEST(DistanceSegmenter, DoesNotFlipOnSuddenOverexposure) {
  DistanceSegmenter segmenter;
  SegmentationResult before;
  for (int i = 0; i < 15; ++i) before = segmenter.update(Scene{}.draw(kSceneSize, i));
  ASSERT_TRUE(before.has_far);
  const cv::Mat mask = before.regions.mask();
  double threshold = before.threshold;
  for (int i = 0; i < 5; ++i) {
    const SegmentationResult result =
        segmenter.update(Scene{.gain = 2, .offset = 60}.draw(kSceneSize, 100 + i));
    EXPECT_TRUE(result.held) << i;
    EXPECT_TRUE(result.has_far) << i;
    EXPECT_GT(test::overlap(result.regions.mask(), mask), 0.95) << i;
    EXPECT_LE(std::abs(result.threshold - threshold), segmenter.options().rate_limit + 1e-9) << i;
    threshold = result.threshold;
  }
  for (int i = 0; i < 5; ++i) {
    const SegmentationResult after = segmenter.update(Scene{}.draw(kSceneSize, 200 + i));
    EXPECT_GT(test::overlap(after.regions.mask(), mask), 0.9) << i;
  }
}

TEST(DistanceSegmenter, DoesNotFlipInTheDarkUnderABridge) {
  DistanceSegmenter segmenter;
  cv::Mat mask;
  for (int i = 0; i < 15; ++i) mask = segmenter.update(Scene{}.draw(kSceneSize, i)).regions.mask();
  for (int i = 0; i < 5; ++i) {
    const SegmentationResult result = segmenter.update(Scene{.gain = 0.4}.draw(kSceneSize, 100 + i));
    EXPECT_GT(test::overlap(result.regions.mask(), mask), 0.95) << i;
  }
}

// A change that stays is believed in the end.
TEST(DistanceSegmenter, FollowsALastingChange) {
  SegmentationOptions options;
  DistanceSegmenter segmenter(options);
  cv::Mat mask;
  for (int i = 0; i < 15; ++i) mask = segmenter.update(Scene{}.draw(kSceneSize, i)).regions.mask();
  SegmentationResult result;
  const Scene darker{.gain = 0.55};
  for (int i = 0; i < 40; ++i) result = segmenter.update(darker.draw(kSceneSize, 100 + i));
  EXPECT_FALSE(result.held);
  EXPECT_TRUE(result.has_far);
  EXPECT_GT(test::overlap(result.regions.mask(), mask), 0.95);
  for (int i = 0; i < 40; ++i)
    result = segmenter.update(Scene{.sky = 0, .mirror = 0}.draw(kSceneSize, 200 + i));
  EXPECT_FALSE(result.has_far);
}

TEST(DistanceSegmenter, LimitsTheThresholdsRate) {
  SegmentationOptions options;
  options.rate_limit = 1.5;
  options.window = 1;
  DistanceSegmenter segmenter(options);
  double last = segmenter.update(Scene{}.draw(kSceneSize, 0)).threshold;
  for (int i = 1; i < 30; ++i) {
    const Scene brighter{.offset = i > 3 ? 30.0 : 0.0};
    const double threshold = segmenter.update(brighter.draw(kSceneSize, i)).threshold;
    EXPECT_LE(std::abs(threshold - last), 1.5 + 1e-9);
    last = threshold;
  }
  const double free = DistanceSegmenter().update(Scene{.offset = 30}.draw(kSceneSize, 29)).threshold;
  EXPECT_NEAR(last, free, 1);
}

TEST(DistanceSegmenter, AveragesTheWindow) {
  SegmentationOptions options;
  options.window = 4;
  options.rate_limit = 255;
  DistanceSegmenter segmenter(options);
  const cv::Mat first = Scene{}.draw(kSceneSize, 0), second = Scene{.offset = 20}.draw(kSceneSize, 1);
  const double start = segmenter.update(first).threshold;
  for (int i = 0; i < 3; ++i) segmenter.update(first);
  const double mixed = segmenter.update(second).threshold;
  for (int i = 0; i < 3; ++i) segmenter.update(second);
  const double end = segmenter.update(second).threshold;
  EXPECT_NEAR(end - start, 20, 2);
  EXPECT_GT(mixed, start + 2);
  EXPECT_LT(mixed, start + 10);
}

TEST(DistanceSegmenter, StartsAnewForAnotherSize) {
  DistanceSegmenter segmenter;
  segmenter.update(Scene{}.draw(kSceneSize, 0));
  const cv::Mat other = Scene{.offset = -40}.draw({320, 240}, 1);
  const SegmentationResult result = segmenter.update(other);
  EXPECT_EQ(result.regions.size, other.size());
  EXPECT_EQ(result.threshold, DistanceSegmenter().update(other).threshold);
}

// The element's size follows the image's width.
TEST(DistanceSegmenter, ScalesWithTheWidth) {
  const auto grown = [](cv::Size size) {
    const SegmentationResult result = DistanceSegmenter().update(Scene{}.draw(size, 4));
    const int x = size.width / 2;
    int y = Scene::outline(size, x);
    while (result.regions.at(static_cast<float>(x), static_cast<float>(y)) == Region::kFar) ++y;
    return y - Scene::outline(size, x);
  };
  EXPECT_NEAR(grown({640, 360}), 26, 4);
  EXPECT_NEAR(grown({1280, 720}), 52, 7);
  EXPECT_NEAR(grown({320, 180}), 13, 4);
}

TEST(DistanceSegmenter, IsTheSameEveryTime) {
  DistanceSegmenter a, b;
  for (int i = 0; i < 5; ++i) {
    const cv::Mat image = Scene{.offset = 3.0 * i}.draw(kSceneSize, i);
    const SegmentationResult p = a.update(image), q = b.update(image);
    EXPECT_EQ(p.threshold, q.threshold);
    EXPECT_EQ(cv::countNonZero(p.regions.labels() != q.regions.labels()), 0);
  }
}

}  // namespace
}  // namespace spslam
