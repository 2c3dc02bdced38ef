// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "spslam/features/fast.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/features2d.hpp>

#include "features/test_images.h"
#include "spslam/features/pyramid.h"

namespace spslam {
namespace {

// Widths that end within, at and after a vector, and less than one.
class FastWidth : public testing::TestWithParam<int> {};

TEST_P(FastWidth, FindsTheCornersOfOpenCvWithTheirScores) {
  const cv::Mat image = test::with_noise(test::shapes_image({GetParam(), 90}, 3), 3, 5);
  for (const int threshold : {5, 20, 60}) {
    cv::Mat scores;
    fast_scores(image, threshold, scores);
    std::vector<cv::KeyPoint> reference;
    cv::FAST(image, reference, threshold, false);
    EXPECT_EQ(cv::countNonZero(scores), static_cast<int>(reference.size())) << "at threshold " << threshold;
    for (const cv::KeyPoint& corner : reference) EXPECT_GT(scores.at<std::uint8_t>(corner.pt), threshold);

    cv::FAST(image, reference, threshold, true);
    for (const cv::KeyPoint& corner : reference) {
      EXPECT_EQ(scores.at<std::uint8_t>(corner.pt), static_cast<int>(corner.response) + 1);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Widths, FastWidth, testing::Values(7, 8, 20, 37, 38, 39, 64, 70, 133, 320));

TEST(Fast, KeepsEachLocalMaximumOnce) {
  const cv::Mat image = test::with_noise(test::shapes_image({200, 100}, 1), 4, 2);
  cv::Mat scores;
  fast_scores(image, 10, scores);
  std::vector<Corner> corners;
  collect_corners(scores, 5, corners);
  ASSERT_GT(corners.size(), 50U);
  cv::Mat highest, kept(scores.size(), CV_8UC1, cv::Scalar(0));
  cv::dilate(scores, highest, cv::Mat::ones(3, 3, CV_8U));
  for (const Corner& corner : corners) {
    EXPECT_TRUE(corner.x >= 5 && corner.x < 195 && corner.y >= 5 && corner.y < 95);
    EXPECT_EQ(corner.score, scores.at<std::uint8_t>(corner.y, corner.x));
    EXPECT_EQ(corner.score, highest.at<std::uint8_t>(corner.y, corner.x));
    kept.at<std::uint8_t>(corner.y, corner.x) = 1;
  }
  cv::Mat around;
  cv::filter2D(kept, around, CV_8U, cv::Mat::ones(3, 3, CV_8U));
  for (const Corner& corner : corners) EXPECT_EQ(around.at<std::uint8_t>(corner.y, corner.x), 1);
}

TEST(Fast, KeepsOneOfTwoEqualNeighbours) {
  cv::Mat scores(20, 20, CV_8UC1, cv::Scalar(0));
  scores.at<std::uint8_t>(10, 10) = scores.at<std::uint8_t>(10, 11) = 50;
  scores.at<std::uint8_t>(5, 7) = scores.at<std::uint8_t>(6, 6) = 40;
  std::vector<Corner> corners;
  collect_corners(scores, 1, corners);
  ASSERT_EQ(corners.size(), 2U);
  EXPECT_EQ(corners[0].x, 7);
  EXPECT_EQ(corners[1].x, 10);
}

TEST(Fast, RefinesToTheVertexOfTheParabola) {
  cv::Mat scores(5, 5, CV_8UC1, cv::Scalar(0));
  // 100 - 10 (x - 2.3)^2 - 20 (y - 1.9)^2 along the middle row and column
  for (int i = 0; i < 5; ++i) {
    scores.at<std::uint8_t>(2, i) =
        cv::saturate_cast<std::uint8_t>(100 - 10 * (i - 2.3) * (i - 2.3) - 20 * 0.01);
    scores.at<std::uint8_t>(i, 2) =
        cv::saturate_cast<std::uint8_t>(100 - 10 * 0.09 - 20 * (i - 1.9) * (i - 1.9));
  }
  const cv::Point2f offset = refine_corner(scores, {2, 2, 99});
  EXPECT_NEAR(offset.x, 0.3, 0.05);
  EXPECT_NEAR(offset.y, -0.1, 0.05);
  scores.setTo(7);
  EXPECT_EQ(refine_corner(scores, {2, 2, 7}), cv::Point2f(0, 0));
}

TEST(Fast, FindsNothingInAFlatOrTinyImage) {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(6, 6), cv::Size(7, 3), cv::Size(64, 48)}) {
    cv::Mat scores;
    std::vector<Corner> corners(3);
    fast_scores(cv::Mat(size, CV_8UC1, cv::Scalar(90)), 5, scores);
    EXPECT_EQ(cv::countNonZero(scores), 0);
    collect_corners(scores, 16, corners);
    EXPECT_TRUE(corners.empty());
  }
}

// A ramp keeps its values in place when the half pixel is right. Resizing rounds down a little, which a
// rising and a falling ramp show with opposite signs.
TEST(ScalePyramid, KnowsWhereItsPixelsLie) {
  cv::Mat rising(120, 240, CV_8UC1), falling(120, 240, CV_8UC1);
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 240; ++x) {
      rising.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(x);
      falling.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(240 - x);
    }
  }
  ScalePyramid up, down;
  up.build(rising, 8, 1.2);
  down.build(falling, 8, 1.2);
  ASSERT_EQ(up.size(), 8);
  for (int level = 0; level < 8; ++level) {
    const int y = up[level].rows / 2, margin = 5;
    double offset = 0;
    for (int x = margin; x < up[level].cols - margin; ++x) {
      const cv::Point2f full = up.to_full(cv::Point2f(static_cast<float>(x), static_cast<float>(y)), level);
      const double up_error = up[level].at<std::uint8_t>(y, x) - full.x;
      const double down_error = down[level].at<std::uint8_t>(y, x) - (240 - full.x);
      EXPECT_LE(std::abs(up_error), 2.5) << "level " << level;
      offset += (up_error - down_error) / 2;
      const cv::Point2f back = up.to_level(full, level);
      EXPECT_NEAR(back.x, x, 1e-3);
      EXPECT_NEAR(back.y, y, 1e-3);
    }
    // Without the half pixel this would be 1.3 px on the last level.
    EXPECT_NEAR(offset / (up[level].cols - 2 * margin), 0, 0.05) << "level " << level;
  }
}

}  // namespace
}  // namespace spslam
