// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "spslam/features/distribute.h"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "spslam/base/random.h"

namespace spslam {
namespace {

std::vector<Corner> random_corners(int count, cv::Size size, std::uint64_t seed) {
  Random random(seed);
  std::set<std::pair<int, int>> places;
  while (static_cast<int>(places.size()) < count) {
    places.insert({static_cast<int>(random.below(size.height)), static_cast<int>(random.below(size.width))});
  }
  std::vector<Corner> corners;
  for (const auto& [y, x] : places) {
    corners.push_back({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y),
                       static_cast<std::uint8_t>(8 + random.below(100))});
  }
  return corners;
}

TEST(LevelQuotas, FollowTheAreaAndAddUp) {
  OrbOptions options;
  const std::vector<int> available(8, 10000);
  const std::vector<int> quota = level_quotas(available, 1500, options);
  EXPECT_EQ(std::accumulate(quota.begin(), quota.end(), 0), 1500);
  for (int i = 1; i < 8; ++i) EXPECT_NEAR(quota[i - 1], 1.44 * quota[i], 2);
  options.level_exponent = 0;
  for (const int q : level_quotas(available, 1600, options)) EXPECT_EQ(q, 200);
}

TEST(LevelQuotas, GiveWhatOneLevelLacksToTheOthers) {
  const OrbOptions options;
  const std::vector<int> available = {10, 0, 10000, 10000, 3, 50, 0, 0};
  const std::vector<int> quota = level_quotas(available, 1500, options);
  EXPECT_EQ(std::accumulate(quota.begin(), quota.end(), 0), 1500);
  for (int i = 0; i < 8; ++i) EXPECT_LE(quota[i], available[i]);
  EXPECT_EQ(quota[0], 10);
  EXPECT_EQ(quota[5], 50);
  EXPECT_NEAR(quota[2], 1.44 * quota[3], 3);
}

TEST(LevelQuotas, TakeAllIfThereIsTooLittle) {
  const std::vector<int> available = {10, 0, 7, 1};
  EXPECT_EQ(level_quotas(available, 1500, {}), available);
  EXPECT_EQ(level_quotas(std::vector<int>(3, 0), 5, {}), std::vector<int>(3, 0));
}

TEST(RankCorners, KeepsTheSpacingAndTheBetterOne) {
  OrbOptions options;
  options.spacing = 6;
  const cv::Size size(200, 150);
  const std::vector<Corner> corners = random_corners(2000, size, 1);
  const RankedCorners ranked = rank_corners(corners, size, 1000, options);
  ASSERT_GT(ranked.corners.size(), 100U);
  for (const Corner& a : ranked.corners) {
    for (const Corner& b : ranked.corners) {
      const bool same = a.x == b.x && a.y == b.y;
      EXPECT_TRUE(same || std::abs(a.x - b.x) >= 6 || std::abs(a.y - b.y) >= 6);
    }
  }
  // Whoever is left out has a better one (or an equal one before it) near.
  for (const Corner& corner : corners) {
    bool explained = false;
    for (const Corner& kept : ranked.corners) {
      explained = explained || (std::abs(kept.x - corner.x) < 6 && std::abs(kept.y - corner.y) < 6 &&
                                kept.score >= corner.score);
    }
    EXPECT_TRUE(explained) << corner.x << ", " << corner.y;
  }
}

TEST(RankCorners, TakesTheBestOfEachCellFirst) {
  OrbOptions options;
  options.spacing = 1;
  options.cell_size = 50;
  options.start_threshold = 7;
  const cv::Size size(200, 150);
  const std::vector<Corner> corners = random_corners(600, size, 2);
  const RankedCorners ranked = rank_corners(corners, size, 600, options);
  EXPECT_EQ(ranked.strong, static_cast<int>(ranked.corners.size()));
  ASSERT_EQ(ranked.corners.size(), 600U);
  std::set<int> cells;
  for (int i = 0; i < 12; ++i) {
    const Corner& first = ranked.corners[i];
    cells.insert(first.y / 50 * 4 + first.x / 50);
    for (const Corner& corner : corners) {
      const bool same_cell = corner.y / 50 == first.y / 50 && corner.x / 50 == first.x / 50;
      EXPECT_TRUE(!same_cell || corner.score <= first.score);
    }
  }
  EXPECT_EQ(cells.size(), 12U);
}

// One cell full of strong corners, the others with few weak ones: these get in, but not before their even
// share is used up.
TEST(RankCorners, LowersTheThresholdOnlyWhereACellIsPoor) {
  OrbOptions options;
  options.spacing = 1;
  options.cell_size = 50;
  std::vector<Corner> corners;
  for (std::int16_t y = 0; y < 50; y += 5) {
    for (std::int16_t x = 0; x < 100; x += 5) {
      corners.push_back({x, y, static_cast<std::uint8_t>(x < 50 ? 50 : 10)});
    }
  }
  const RankedCorners ranked = rank_corners(corners, {100, 50}, 40, options);
  EXPECT_EQ(ranked.corners.size(), 200U);
  EXPECT_EQ(ranked.strong, 100 + 20);
  for (int i = ranked.strong; i < 200; ++i) EXPECT_EQ(ranked.corners[i].score, 10);
}

TEST(RankCorners, AcceptsNone) {
  const RankedCorners ranked = rank_corners({}, {1, 1}, 100, {});
  EXPECT_TRUE(ranked.corners.empty());
  EXPECT_EQ(ranked.strong, 0);
}

}  // namespace
}  // namespace spslam
