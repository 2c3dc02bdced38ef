// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/optimize/robust.h"

#include <gtest/gtest.h>

namespace spslam {
namespace {

constexpr Loss kLosses[] = {Loss::kNone, Loss::kHuber, Loss::kPseudoHuber, Loss::kCauchy};

TEST(Robust, IsTheParabolaNearZero) {
  for (const Loss loss : kLosses) {
    EXPECT_EQ(robust(loss, 3, 0).cost, 0);
    EXPECT_EQ(robust(loss, 3, 0).weight, 1);
    EXPECT_NEAR(robust(loss, 3, 1e-4).cost, 1e-4, 1e-8);
  }
}

TEST(Robust, WeightIsTheDerivativeOfTheCost) {
  for (const Loss loss : kLosses)
    for (const double scale : {0.5, 1.0, 3.0})
      for (const double s : {0.01, 0.2, 0.9, 3.0, 8.5, 9.5, 100.0, 1e4}) {
        const double h = 1e-5 * s;
        const double slope = (robust(loss, scale, s + h).cost - robust(loss, scale, s - h).cost) / (2 * h);
        EXPECT_NEAR(robust(loss, scale, s).weight, slope, 1e-7) << static_cast<int>(loss) << " " << s;
      }
}

// Known values: c = 2, s = 16, a residual of 4.
TEST(Robust, HasTheCostsOfTheTextbooks) {
  EXPECT_DOUBLE_EQ(robust(Loss::kNone, 2, 16).cost, 16);
  EXPECT_DOUBLE_EQ(robust(Loss::kHuber, 2, 16).cost, 2 * 2 * 4 - 4);
  EXPECT_DOUBLE_EQ(robust(Loss::kPseudoHuber, 2, 16).cost, 2 * 4 * (std::sqrt(5.0) - 1));
  EXPECT_DOUBLE_EQ(robust(Loss::kCauchy, 2, 16).cost, 4 * std::log(5.0));
}

TEST(Robust, HuberHasNoStepWhereItLeavesTheParabola) {
  const double c = 1.5, s = c * c;
  EXPECT_NEAR(robust(Loss::kHuber, c, s).cost, robust(Loss::kHuber, c, s * (1 + 1e-12)).cost, 1e-10);
  EXPECT_NEAR(robust(Loss::kHuber, c, s).weight, robust(Loss::kHuber, c, s * (1 + 1e-12)).weight, 1e-10);
}

TEST(Robust, CostGrowsAndWeightFallsWithTheResidual) {
  for (const Loss loss : kLosses)
    for (double s = 0; s < 50; s += 0.5) {
      EXPECT_LT(robust(loss, 3, s).cost, robust(loss, 3, s + 0.5).cost);
      EXPECT_GE(robust(loss, 3, s).weight, robust(loss, 3, s + 0.5).weight);
      EXPECT_GT(robust(loss, 3, s).weight, 0);
    }
}

}  // namespace
}  // namespace spslam
