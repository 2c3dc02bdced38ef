// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/eval/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace spslam {
namespace {

TEST(Statistics, OfFourValues) {
  const Statistics s = statistics_of({4, 1, 3, 2});
  EXPECT_EQ(s.count, 4u);
  EXPECT_DOUBLE_EQ(s.mean, 2.5);
  EXPECT_DOUBLE_EQ(s.maximum, 4);
  EXPECT_DOUBLE_EQ(s.median, 2.5);
  EXPECT_DOUBLE_EQ(s.rmse, std::sqrt(7.5));
  EXPECT_DOUBLE_EQ(s.deviation, std::sqrt(1.25));
}

TEST(Statistics, MedianOfAnOddCountIsTheMiddle) {
  EXPECT_DOUBLE_EQ(statistics_of({9, 1, 5}).median, 5);
}

TEST(Statistics, RmseSquaredIsMeanSquaredPlusVariance) {
  const Statistics s = statistics_of({0.3, 1.7, 2.2, 0.01, 5.5});
  EXPECT_NEAR(s.rmse * s.rmse, s.mean * s.mean + s.deviation * s.deviation, 1e-12);
}

TEST(Statistics, NothingHasNoFigures) {
  const Statistics s = statistics_of({});
  EXPECT_EQ(s.count, 0u);
  EXPECT_TRUE(std::isnan(s.mean) && std::isnan(s.maximum) && std::isnan(s.rmse) && std::isnan(s.median));
}

}  // namespace
}  // namespace spslam
