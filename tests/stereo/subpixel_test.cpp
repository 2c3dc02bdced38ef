// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/stereo/subpixel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "spslam/base/random.h"

namespace spslam {
namespace {

FiveSamples sample(const std::function<double(double, double)>& f) {
  return {f(0, 0), f(-1, 0), f(1, 0), f(0, -1), f(0, 1)};
}

TEST(SubPixel, QuadricIsExactOnQuadrics) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const double u = random.uniform(-0.5, 0.5), v = random.uniform(-0.5, 0.5);
    const double a = random.uniform(0.1, 9), b = random.uniform(0.1, 9), e = random.uniform(0, 100);
    const auto found = interpolate(
        sample([&](double x, double y) { return a * (x - u) * (x - u) + b * (y - v) * (y - v) + e; }),
        Interpolation::kQuadric);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->du, u, 1e-9);
    EXPECT_NEAR(found->dv, v, 1e-9);
    EXPECT_NEAR(found->curvature, 2 * a, 1e-9);
  }
}

TEST(SubPixel, EquiangularIsExactOnRoofs) {
  for (double u = -0.5; u <= 0.5; u += 0.05) {
    const auto roof = sample([&](double x, double y) { return 5 * std::abs(x - u) + y * y; });
    const auto found = interpolate(roof, Interpolation::kEquiangular);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->du, u, 1e-9);
    // A parabola is pulled towards whole pixels there: the known bias of SAD with a parabola.
    const auto locked = interpolate(roof, Interpolation::kParabola);
    ASSERT_TRUE(locked);
    EXPECT_LE(std::abs(locked->du), std::abs(u) + 1e-9);
  }
}

TEST(SubPixel, NoneStaysOnThePixel) {
  const auto found = interpolate({1, 2, 3, 2, 3}, Interpolation::kNone);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->du, 0);
  EXPECT_EQ(found->dv, 0);
}

TEST(SubPixel, RefusesWhatHasNoMinimum) {
  for (const Interpolation kind : {Interpolation::kNone, Interpolation::kParabola, Interpolation::kQuadric,
                                   Interpolation::kEquiangular}) {
    EXPECT_FALSE(interpolate({5, 5, 5, 5, 5}, kind)) << "flat";
    EXPECT_FALSE(interpolate({5, 4, 4, 9, 9}, kind)) << "ridge along the row";
  }
  EXPECT_FALSE(interpolate({5, 9, 9, 4, 4}, Interpolation::kQuadric)) << "saddle";
  EXPECT_TRUE(interpolate({5, 9, 9, 4, 4}, Interpolation::kParabola)) << "the row alone has one";
  EXPECT_FALSE(interpolate({5, 1, 10, 9, 9}, Interpolation::kParabola)) << "minimum beyond the cell";
}

}  // namespace
}  // namespace spslam
