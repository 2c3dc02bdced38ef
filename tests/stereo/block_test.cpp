// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/stereo/block.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "spslam/base/random.h"

namespace spslam {
namespace {

cv::Mat noise_image(int width, int height, std::uint64_t seed) {
  Random random(seed);
  cv::Mat image(height, width, CV_8UC1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(random.below(256));
  return image;
}

// Equation (4) as it is written.
int plain_sad(const cv::Mat& a, const cv::Point& p, const cv::Mat& b, const cv::Point& q, int radius) {
  int sum = 0;
  for (int y = -radius; y <= radius; ++y)
    for (int x = -radius; x <= radius; ++x)
      sum += std::abs(a.at<std::uint8_t>(p.y + y, p.x + x) - b.at<std::uint8_t>(q.y + y, q.x + x));
  return sum;
}

TEST(Block, SearchIsTheSumOfAbsoluteDifferencesAtEveryPlace) {
  const cv::Mat left = noise_image(60, 50, 1), right = noise_image(60, 50, 2);
  for (int radius = 2; radius <= kMaxBlockRadius; ++radius) {
    for (const auto& [ru, rv] : {std::pair{1, 0}, {4, 2}, {kMaxSearchRadius, kMaxSearchRadiusRows}}) {
      // The window's corner is the image's: reads past either end of it would show under the sanitizers.
      const cv::Point p(20, 20), q(60 - 1 - radius - ru, 50 - 1 - radius - rv);
      const CostWindow window = search_block(cut_block(left, p, radius), right, q, ru, rv);
      for (int v = -rv; v <= rv; ++v)
        for (int u = -ru; u <= ru; ++u)
          ASSERT_EQ(window.at(u, v), plain_sad(left, p, right, q + cv::Point(u, v), radius))
              << radius << " " << u << " " << v;
    }
  }
}

TEST(Block, BestIsTheLeastAndTheFirstOfEqual) {
  CostWindow window;
  window.radius_u = 2, window.radius_v = 1;
  window.cost.fill(9);
  EXPECT_EQ(window.best(), cv::Point(-2, -1));
  window.cost[5 + 3] = 1;
  EXPECT_EQ(window.best(), cv::Point(1, 0));
  EXPECT_FALSE(window.on_edge(window.best()));
  EXPECT_TRUE(window.on_edge({2, 0}));
  EXPECT_TRUE(window.on_edge({0, 1}));
  window.cost[0] = 0;
  EXPECT_EQ(window.best(), cv::Point(-2, -1));
}

TEST(Block, InsideCountsTheMargins) {
  const cv::Mat image(20, 30, CV_8UC1);
  EXPECT_TRUE(block_inside(image, {5, 5}, 5, 0, 0));
  EXPECT_FALSE(block_inside(image, {4, 5}, 5, 0, 0));
  EXPECT_FALSE(block_inside(image, {5, 5}, 5, 1, 0));
  EXPECT_TRUE(block_inside(image, {24, 14}, 5, 0, 0));
  EXPECT_FALSE(block_inside(image, {25, 14}, 5, 0, 0));
  EXPECT_FALSE(block_inside(image, {24, 14}, 5, 0, 1));
}

TEST(Block, MatchedBrightnessUndoesGainAndOffset) {
  const cv::Mat texture = noise_image(40, 40, 3) / 2 + 40;
  cv::Mat changed;
  texture.convertTo(changed, CV_8UC1, 1.2, -20);
  Block block = cut_block(texture, {20, 20}, 5);
  const Block wanted = cut_block(changed, {20, 20}, 5);
  match_brightness(block, wanted);
  for (std::size_t i = 0; i < block.pixels.size(); ++i) EXPECT_NEAR(block.pixels[i], wanted.pixels[i], 2);
}

TEST(Block, MatchedBrightnessOfAFlatBlockIsTheOthersMean) {
  const cv::Mat flat(40, 40, CV_8UC1, cv::Scalar(10)), other(40, 40, CV_8UC1, cv::Scalar(200));
  Block block = cut_block(flat, {20, 20}, 5);
  match_brightness(block, cut_block(other, {20, 20}, 5));
  EXPECT_EQ(block.pixels[0], 200);
  EXPECT_EQ(block.pixels[15], 0) << "padding";
}

}  // namespace
}  // namespace spslam
