// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/odometry/rig_monitor.h"

#include <gtest/gtest.h>

namespace spslam {
namespace {

TEST(RigMonitor, BelievesWhatWindowsAgreeOn) {
  EXPECT_EQ(believable_mean({}, 0.1, 0.05), 0);
  EXPECT_NEAR(believable_mean({-0.20, -0.19, -0.21, -0.2, -0.2, -0.2}, 0.1, 0.05), -0.2, 0.03);
  EXPECT_GT(std::abs(believable_mean({0.2, 0.2, 0.2, 0.2}, 0.1, 0.05)),
            std::abs(believable_mean({0.2}, 0.1, 0.05)));
}

TEST(RigMonitor, BelievesNothingBelowTheFloorOrInTheScatter) {
  EXPECT_EQ(believable_mean({0.02, 0.018, 0.022, 0.02, 0.02}, 0.1, 0.05), 0);
  EXPECT_EQ(believable_mean({0.5, -0.4, 0.1, -0.2, 0.45, -0.5}, 0.1, 0.05), 0);
}

TEST(RigMonitor, OneWindowThatWentWrongDoesNotCount) {
  EXPECT_NEAR(believable_mean({0.2, 0.21, 0.19, 0.2, 0.2, 0.2, 0.2, 0.2, 0.2, 1.4}, 0.1, 0.05), 0.2, 0.08);
}

TEST(RigMonitor, AnOffsetThatPutsPointsBehindInfinityIsImpossible) {
  // Far points at 0 to 0.5 px, near ones at several, one mismatch below zero.
  const std::vector<double> measured = {0.1, 0.2, 0.05, 0.3, 0.5, 0.4, 0.2,  0.15, 2,   3, 4,  5,
                                        6,   2.5, 3.5,  4.5, 5.5, 6.5, 0.35, 0.25, 0.3, 7, -2, 1.5};
  EXPECT_TRUE(leaves_points_in_front(measured, -0.8, 0.1));
  EXPECT_TRUE(leaves_points_in_front(measured, 0.2, 0.1));
  EXPECT_FALSE(leaves_points_in_front(measured, 0.6, 0.1));
  EXPECT_TRUE(leaves_points_in_front({}, 5, 0.1));
}

}  // namespace
}  // namespace spslam
