// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "spslam/segmentation/regions.h"

#include <gtest/gtest.h>

#include "segmentation/test_scenes.h"

namespace spslam {
namespace {

using test::kSceneSize;

// Every pixel, not dilated by much, so that the regions themselves are seen.
SegmentationOptions fine() {
  SegmentationOptions options;
  options.element = StructuringElement::kDisc15;
  options.downscale = 1;
  return options;
}

cv::Mat dark() {
  return cv::Mat(kSceneSize, CV_8UC1, cv::Scalar(20));
}

TEST(FindRegions, KeepsTheTwoLargest) {
  cv::Mat image = dark();
  image(cv::Rect(0, 0, 640, 100)).setTo(220);     // sky
  image(cv::Rect(200, 280, 200, 60)).setTo(200);  // mirror image
  image(cv::Rect(500, 180, 60, 60)).setTo(240);   // a white wall
  const RegionMap regions = find_regions(image, 128, fine(), kSceneSize);
  EXPECT_EQ(regions.at(320, 50), Region::kFar);
  EXPECT_EQ(regions.at(300, 310), Region::kMirror);
  EXPECT_EQ(regions.at(530, 210), Region::kNear);
  EXPECT_EQ(regions.at(20, 200), Region::kNear);
  EXPECT_EQ(regions.at(320, 114), Region::kFar) << "15 px below the sky";
  EXPECT_EQ(regions.at(320, 115), Region::kNear) << "16 px below the sky";

  SegmentationOptions options = fine();
  options.regions = 1;
  EXPECT_EQ(find_regions(image, 128, options, kSceneSize).at(300, 310), Region::kNear);
  options.regions = 3;
  EXPECT_EQ(find_regions(image, 128, options, kSceneSize).at(530, 210), Region::kMirror);
}

TEST(FindRegions, TakesASkyDividedByATreeForFar) {
  cv::Mat image = dark();
  image(cv::Rect(0, 0, 300, 120)).setTo(220);
  image(cv::Rect(380, 0, 260, 100)).setTo(220);
  const RegionMap regions = find_regions(image, 128, fine(), kSceneSize);
  EXPECT_EQ(regions.at(100, 50), Region::kFar);
  EXPECT_EQ(regions.at(500, 50), Region::kFar);
  EXPECT_EQ(regions.at(340, 50), Region::kNear);
}

TEST(FindRegions, KnowsAMirrorImageWithoutItsSky) {
  cv::Mat image = dark();
  image(cv::Rect(200, 250, 200, 80)).setTo(200);
  const RegionMap regions = find_regions(image, 128, fine(), kSceneSize);
  EXPECT_EQ(regions.at(300, 300), Region::kMirror);
  EXPECT_EQ(cv::countNonZero(regions.labels() == static_cast<int>(Region::kFar)), 0);
}

TEST(FindRegions, GivesTheShoreBetweenSkyAndMirrorToTheSky) {
  cv::Mat image = dark();
  image.rowRange(0, 150).setTo(220);
  image.rowRange(170, 360).setTo(200);
  const RegionMap regions = find_regions(image, 128, fine(), kSceneSize);
  EXPECT_EQ(regions.at(320, 160), Region::kFar);
  EXPECT_EQ(regions.at(320, 300), Region::kMirror);
}

TEST(FindRegions, IgnoresSpecks) {
  cv::Mat image = dark();
  image(cv::Rect(10, 10, 30, 30)).setTo(255);  // 0.4 % of the image
  EXPECT_TRUE(find_regions(image, 128, fine(), kSceneSize).empty());
  SegmentationOptions options = fine();
  options.minimum_region = 0.003;
  EXPECT_FALSE(find_regions(image, 128, options, kSceneSize).empty());
}

TEST(FindRegions, IsNearlyTheSameFromAQuarterOfTheSize) {
  const cv::Mat image = test::Scene{}.draw(kSceneSize, 1);
  SegmentationOptions options;
  const RegionMap small = find_regions(shrink(image, 4), 128, options, kSceneSize);
  const RegionMap full = find_regions(image, 128, options, kSceneSize);
  for (const Region region : {Region::kFar, Region::kMirror}) {
    const int value = static_cast<int>(region);
    EXPECT_GT(test::overlap(small.labels() == value, full.labels() == value), 0.96) << value;
  }
}

TEST(RegionMap, IsNearOutsideOfTheImage) {
  const RegionMap regions =
      find_regions(cv::Mat(kSceneSize, CV_8UC1, cv::Scalar(255)), 128, fine(), kSceneSize);
  EXPECT_EQ(regions.at(0, 0), Region::kFar);
  EXPECT_EQ(regions.at(639.4F, 359.4F), Region::kFar);
  EXPECT_EQ(regions.at(-1, 0), Region::kNear);
  EXPECT_EQ(regions.at(640, 10), Region::kNear);
  EXPECT_EQ(regions.at(10, 360), Region::kNear);
}

TEST(RegionMap, DrawsWhatItAnswers) {
  const cv::Size size(203, 101);  // not a multiple of the factor
  const cv::Mat image = test::Scene{}.draw(size, 3);
  const RegionMap regions = find_regions(shrink(image, 4), 128, {}, size);
  const cv::Mat labels = regions.labels(), mask = regions.mask();
  ASSERT_EQ(labels.size(), size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const Region region = regions.at(static_cast<float>(x), static_cast<float>(y));
      EXPECT_EQ(labels.at<std::uint8_t>(y, x), static_cast<int>(region));
      EXPECT_EQ(mask.at<std::uint8_t>(y, x), region == Region::kNear ? 0 : 255);
    }
  }
}

TEST(Shrink, LeavesImagesThatAreTooSmall) {
  const cv::Mat tiny(2, 3, CV_8UC1, cv::Scalar(9));
  EXPECT_EQ(shrink(tiny, 4).size(), tiny.size());
  EXPECT_EQ(shrink(cv::Mat(90, 161, CV_8UC1, cv::Scalar(9)), 4).size(), cv::Size(40, 22));
}

}  // namespace
}  // namespace spslam
