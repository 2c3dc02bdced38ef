// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/alignment/pyramid.h"

#include <gtest/gtest.h>

#include "alignment/waves.h"

namespace spslam {
namespace {

// Flat on its left third, waves elsewhere.
cv::Mat half_smooth(double noise) {
  const Texture texture(4);
  const auto flattened = [](double x, double y) {
    return Eigen::Vector2d(std::max(x, kWidth / 3.0), x > kWidth / 3.0 ? y : 0);
  };
  return render(texture, flattened, 8, 128, noise);
}

TEST(AlignmentPyramid, TellsTheNoiseOfAnImageThatIsSmoothSomewhere) {
  for (const double noise : {1.0, 2.0, 5.0})
    EXPECT_NEAR(AlignmentPyramid(half_smooth(noise), 3, true).noise(), noise, 0.2 * noise + 0.1) << noise;
}

TEST(AlignmentPyramid, WhiteAndBlackHaveNoNoise) {
  EXPECT_EQ(AlignmentPyramid(cv::Mat(100, 100, CV_8UC1, cv::Scalar(255)), 3, true).noise(), 0);
  cv::Mat image = half_smooth(2);
  image.rowRange(0, kHeight / 2).setTo(255);  // an overexposed sky
  EXPECT_NEAR(AlignmentPyramid(image, 3, true).noise(), 2, 0.6);
}

TEST(AlignmentPyramid, ImagesSmallerThanABlockHaveNone) {
  EXPECT_EQ(AlignmentPyramid(cv::Mat(30, 30, CV_8UC1, cv::Scalar(9)), 3, true).noise(), 0);
  EXPECT_EQ(AlignmentPyramid(cv::Mat(1, 1, CV_8UC1, cv::Scalar(9)), 3, true).noise(), 0);
}

TEST(AlignmentPyramid, WithoutBeingAskedItMeasuresNone) {
  EXPECT_EQ(AlignmentPyramid(half_smooth(3), 3).noise(), 0);
  EXPECT_EQ(AlignmentPyramid(half_smooth(3), 3).softened(1).noise(), 0);
}

TEST(AlignmentPyramid, SoftenedItHasLess) {
  const AlignmentPyramid sharp(half_smooth(3), 3, true);
  EXPECT_LT(sharp.softened(1).noise(), 0.6 * sharp.noise());
}

}  // namespace
}  // namespace spslam
