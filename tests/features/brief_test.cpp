// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "spslam/features/brief.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "features/test_images.h"

namespace spslam {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(BriefPattern, LiesInThePatchAndIsCentred) {
  double sum = 0, squares = 0;
  for (int i = 0; i < 256; ++i) {
    const BriefPair pair = brief_pair(i);
    EXPECT_LE(std::hypot(pair.ax, pair.ay), kPatchRadius);
    EXPECT_LE(std::hypot(pair.bx, pair.by), kPatchRadius);
    EXPECT_GE(std::hypot(pair.ax - pair.bx, pair.ay - pair.by), 3);
    for (const float v : {pair.ax, pair.ay, pair.bx, pair.by}) sum += v, squares += v * v;
  }
  EXPECT_NEAR(sum / 1024, 0, 0.6);
  EXPECT_NEAR(std::sqrt(squares / 1024), 7, 1);
}

// Everyone's maps hold descriptors made with this pattern.
TEST(BriefPattern, NeverChanges) {
  double checksum = 0;
  for (int i = 0; i < 256; ++i) {
    const BriefPair pair = brief_pair(i);
    checksum += (i + 1) * (pair.ax + 2.0 * pair.ay + 3.0 * pair.bx + 4.0 * pair.by);
  }
  EXPECT_NEAR(checksum, 74575.875, 1e-2);
}

TEST(Smooth, IsTheSeparableTriangle) {
  const cv::Mat image = test::shapes_image({77, 40}, 3);
  cv::Mat smoothed, reference;
  smooth(image, smoothed);
  const cv::Mat kernel = (cv::Mat_<float>(7, 1) << 1, 2, 3, 4, 3, 2, 1) / 16;
  cv::sepFilter2D(image, reference, CV_8U, kernel, kernel, {-1, -1}, 0.7, cv::BORDER_REPLICATE);
  cv::Mat difference;
  cv::absdiff(smoothed, reference, difference);
  double largest = 0;
  cv::minMaxLoc(difference, nullptr, &largest);
  EXPECT_LE(largest, 3);
  EXPECT_LE(cv::mean(difference)[0], 1);
}

TEST(Smooth, LeavesFlatImagesAlone) {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(3, 50), cv::Size(64, 2), cv::Size(100, 80)}) {
    cv::Mat smoothed;
    smooth(cv::Mat(size, CV_8UC1, cv::Scalar(255)), smoothed);
    EXPECT_EQ(cv::countNonZero(smoothed != 255), 0);
  }
}

TEST(Patch, RepeatsTheEdge) {
  cv::Mat image(10, 12, CV_8UC1);
  for (int i = 0; i < 120; ++i) image.data[i] = static_cast<std::uint8_t>(i);
  Patch patch;
  copy_patch(image, 2, 3, patch);
  for (int v = 0; v < Patch::kSide; ++v) {
    for (int u = 0; u < Patch::kSide; ++u) {
      const int y = std::clamp(3 + v - kPatchRadius, 0, 9), x = std::clamp(2 + u - kPatchRadius, 0, 11);
      EXPECT_EQ(patch.pixels[v * Patch::kStride + u], image.at<std::uint8_t>(y, x));
    }
  }
}

// A bright half plane lies in the direction of its normal.
TEST(PatchOrientation, PointsToTheBrightSide) {
  for (int degrees = -175; degrees <= 180; degrees += 15) {
    const double angle = degrees * kPi / 180;
    cv::Mat image(101, 101, CV_8UC1);
    for (int y = 0; y < 101; ++y) {
      for (int x = 0; x < 101; ++x) {
        const double along = (x - 50) * std::cos(angle) + (y - 50) * std::sin(angle);
        image.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(128 + 30 * along);
      }
    }
    Patch patch;
    copy_patch(image, 50, 50, patch);
    const double error = std::remainder(patch_orientation(patch) - angle, 2 * kPi);
    EXPECT_NEAR(error, 0, 0.02) << degrees;
  }
}

TEST(PatchOrientation, EqualsTheMomentsOfTheDisc) {
  const cv::Mat image = test::with_noise(test::shapes_image({100, 100}, 9), 20, 1);
  double x_moment = 0, y_moment = 0;
  for (int v = -15; v <= 15; ++v) {
    for (int u = -15; u <= 15; ++u) {
      if (u * u + v * v > 15.5 * 15.5) continue;
      x_moment += u * image.at<std::uint8_t>(50 + v, 50 + u);
      y_moment += v * image.at<std::uint8_t>(50 + v, 50 + u);
    }
  }
  Patch patch;
  copy_patch(image, 50, 50, patch);
  EXPECT_NEAR(patch_orientation(patch), std::atan2(y_moment, x_moment), 1e-5);
  // Sums of a saturated half disc are the largest there are.
  cv::Mat half(100, 100, CV_8UC1, cv::Scalar(255));
  half.rowRange(0, 50).setTo(0);
  copy_patch(half, 50, 50, patch);
  EXPECT_NEAR(patch_orientation(patch), kPi / 2, 1e-6);
}

TEST(DescribePatch, ComparesThePixelsOfThePattern) {
  const cv::Mat image = test::with_noise(test::shapes_image({60, 60}, 5), 20, 2);
  Patch patch;
  copy_patch(image, 30, 30, patch);
  const Descriptor descriptor = describe_patch(patch, 0);
  const auto grey = [&](float x, float y) {
    return image.at<std::uint8_t>(30 + static_cast<int>(std::lround(y)),
                                  30 + static_cast<int>(std::lround(x)));
  };
  int set = 0;
  for (int i = 0; i < 256; ++i) {
    const BriefPair pair = brief_pair(i);
    set += grey(pair.ax, pair.ay) < grey(pair.bx, pair.by) ? 1 : 0;
  }
  EXPECT_EQ(std::popcount(descriptor[0]) + std::popcount(descriptor[1]) + std::popcount(descriptor[2]) +
                std::popcount(descriptor[3]),
            set);
}

TEST(DescribePatch, TakesEveryAngle) {
  Patch patch;
  copy_patch(test::shapes_image({60, 60}, 5), 30, 30, patch);
  EXPECT_EQ(describe_patch(patch, static_cast<float>(-kPi)), describe_patch(patch, static_cast<float>(kPi)));
  EXPECT_EQ(describe_patch(patch, -0.001F), describe_patch(patch, 0.001F));
  EXPECT_NE(describe_patch(patch, 1.5F), describe_patch(patch, -1.5F));
}

}  // namespace
}  // namespace spslam
