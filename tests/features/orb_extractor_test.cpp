// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "spslam/features/orb_extractor.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <set>

#include "features/test_images.h"
#include "spslam/base/error.h"

namespace spslam {
namespace {

const cv::Size kSize(640, 360);

void expect_same(const Features& a, const Features& b) {
  ASSERT_EQ(a.keypoints.size(), b.keypoints.size());
  for (std::size_t i = 0; i < a.keypoints.size(); ++i) {
    const Keypoint &p = a.keypoints[i], &q = b.keypoints[i];
    EXPECT_TRUE(p.x == q.x && p.y == q.y && p.angle == q.angle && p.response == q.response &&
                p.octave == q.octave)
        << i;
  }
  EXPECT_EQ(a.descriptors, b.descriptors);
}

TEST(OrbExtractor, FindsAsManyAsAskedFor) {
  OrbExtractor extractor;
  const cv::Mat image = test::with_noise(test::shapes_image(kSize, 1, 1500), 4, 1);
  const Features features = extractor.extract(image);
  EXPECT_EQ(features.keypoints.size(), 1500U);
  EXPECT_EQ(features.descriptors.size(), 1500U);
  std::set<int> octaves;
  for (const Keypoint& keypoint : features.keypoints) {
    octaves.insert(keypoint.octave);
    EXPECT_TRUE(keypoint.x > 15 && keypoint.x < 624 && keypoint.y > 15 && keypoint.y < 344);
    EXPECT_GT(keypoint.response, 7);
    EXPECT_LE(std::abs(keypoint.angle), 3.1416F);
  }
  EXPECT_EQ(octaves.size(), 8U);
  OrbRequest request;
  request.count = 200;
  EXPECT_EQ(extractor.extract(image, request).keypoints.size(), 200U);
}

TEST(OrbExtractor, GivesTheSameBitsEveryTime) {
  const cv::Mat image = test::with_noise(test::shapes_image(kSize, 2, 1500), 4, 1);
  const cv::Mat other = test::shapes_image({320, 500}, 3);
  OrbExtractor extractor;
  const Features first = extractor.extract(image);
  extractor.extract(other);
  expect_same(first, extractor.extract(image));
  expect_same(first, OrbExtractor().extract(image));
  for (const int threads : {1, 2, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    expect_same(first, extractor.extract(image));
  }
}

// One half has contrast, the other a tenth of it: both are covered.
TEST(OrbExtractor, CoversPoorRegionsToo) {
  cv::Mat image = test::shapes_image(kSize, 4, 1500);
  cv::Mat right = image.colRange(320, 640);
  right.convertTo(right, -1, 0.12, 110);
  const std::vector<Keypoint> keypoints = OrbExtractor().extract(image).keypoints;
  std::set<std::pair<int, int>> cells;
  int poor = 0;
  for (const Keypoint& keypoint : keypoints) {
    cells.insert({static_cast<int>(keypoint.x / 40), static_cast<int>(keypoint.y / 40)});
    poor += keypoint.x > 320 ? 1 : 0;
  }
  EXPECT_GE(cells.size(), 16U * 9U - 8U);
  EXPECT_GT(poor, static_cast<int>(keypoints.size()) / 4);
}

// Fog: nothing passes the starting threshold.
TEST(OrbExtractor, FindsFeaturesInFog) {
  cv::Mat fog;
  test::shapes_image(kSize, 5, 1500).convertTo(fog, -1, 0.08, 150);
  EXPECT_GT(OrbExtractor().extract(fog).keypoints.size(), 800U);
}

TEST(OrbExtractor, FindsNothingWithoutTexture) {
  OrbExtractor extractor;
  EXPECT_TRUE(extractor.extract(cv::Mat()).keypoints.empty());
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(1, 400), cv::Size(33, 20), cv::Size(64, 64), kSize}) {
    for (const int grey : {0, 77, 255}) {
      const Features features = extractor.extract(cv::Mat(size, CV_8UC1, cv::Scalar(grey)));
      EXPECT_TRUE(features.keypoints.empty() && features.descriptors.empty()) << size;
    }
    EXPECT_NO_THROW(extractor.extract(test::with_noise(cv::Mat(size, CV_8UC1, cv::Scalar(100)), 60, 1)));
  }
}

TEST(OrbExtractor, KeepsAwayFromOccupiedPlacesAndTheMask) {
  const cv::Mat image = test::with_noise(test::shapes_image(kSize, 6, 1500), 4, 1);
  OrbExtractor extractor;
  std::vector<cv::Point2f> occupied;
  for (const Keypoint& keypoint : extractor.extract(image).keypoints) {
    if (occupied.size() < 300) occupied.emplace_back(keypoint.x, keypoint.y);
  }
  OrbRequest request;
  request.occupied = occupied;
  request.radius = 12;
  request.allowed = cv::Mat(kSize, CV_8UC1, cv::Scalar(1));
  request.allowed.rowRange(0, 100).setTo(0);
  const std::vector<Keypoint> keypoints = extractor.extract(image, request).keypoints;
  EXPECT_GT(keypoints.size(), 300U);
  for (const Keypoint& keypoint : keypoints) {
    // Whole pixels of its level are tested before the sub-pixel step of up to half of one.
    const double slack = 0.71 * std::pow(1.2, keypoint.octave) + 0.71;
    EXPECT_GT(keypoint.y, 100 - slack);
    for (const cv::Point2f& at : occupied)
      EXPECT_GT(std::hypot(keypoint.x - at.x, keypoint.y - at.y), 12 - slack);
  }
}

TEST(OrbExtractor, WorksInSteps) {
  const cv::Mat image = test::with_noise(test::shapes_image(kSize, 7, 1500), 4, 1);
  OrbExtractor extractor;
  const Features whole = extractor.extract(image);
  extractor.set_image(image);
  Features steps;
  steps.keypoints = extractor.detect();
  std::vector<Keypoint> turned = steps.keypoints;
  for (Keypoint& keypoint : turned) keypoint.angle = 9;
  extractor.orient(turned);
  for (std::size_t i = 0; i < turned.size(); ++i) EXPECT_EQ(turned[i].angle, steps.keypoints[i].angle) << i;
  steps.descriptors = extractor.describe(steps.keypoints);
  expect_same(whole, steps);
}

TEST(OrbExtractor, DescribesUpToTheEdge) {
  const cv::Mat image = test::shapes_image(kSize, 8);
  OrbExtractor extractor;
  extractor.set_image(image);
  std::vector<Keypoint> corners;
  for (const std::uint8_t octave : {0, 3, 7}) {
    for (const float x : {0.0F, 639.0F}) {
      for (const float y : {0.0F, 359.0F}) corners.push_back({x, y, 0, 0, octave});
    }
  }
  extractor.orient(corners);
  EXPECT_EQ(extractor.describe(corners).size(), corners.size());
}

TEST(OrbExtractor, RefusesWhatItCannotUse) {
  OrbExtractor extractor;
  EXPECT_THROW(extractor.extract(cv::Mat(20, 20, CV_8UC3)), InputError);
  EXPECT_THROW(extractor.extract(cv::Mat(20, 20, CV_16UC1)), InputError);
  const cv::Mat image = test::shapes_image({100, 100}, 1);
  OrbRequest request;
  request.allowed = cv::Mat(50, 100, CV_8UC1, cv::Scalar(255));
  EXPECT_THROW(extractor.extract(image, request), InputError);
  extractor.set_image(image);
  const std::vector<Keypoint> outside = {{150, 20, 0, 0, 0}}, too_high = {{50, 50, 0, 0, 8}};
  const std::vector<Keypoint> not_a_number = {{NAN, 20, 0, 0, 0}};
  EXPECT_THROW(extractor.describe(outside), InputError);
  EXPECT_THROW(extractor.describe(too_high), InputError);
  EXPECT_THROW(extractor.describe(not_a_number), InputError);
  OrbOptions options;
  options.scale = 0.9;
  EXPECT_THROW(OrbExtractor{options}, OptionError);
}

}  // namespace
}  // namespace spslam
