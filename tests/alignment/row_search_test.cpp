// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/alignment/row_search.h"

#include <gtest/gtest.h>

#include "alignment/waves.h"

namespace spslam {
namespace {

constexpr int kRadius = 6;

AlignmentPyramid shifted(const Texture& texture, double disparity, double gain = 8) {
  return AlignmentPyramid(
      render(
          texture, [&](double x, double y) { return Eigen::Vector2d(x + disparity, y); }, gain),
      3);
}

class Disparities : public testing::TestWithParam<double> {};

TEST_P(Disparities, AreFoundToAPixelUnderGain) {
  const Texture texture(3);
  const AlignmentPyramid left = shifted(texture, 0), right = shifted(texture, GetParam(), 6);
  int found = 0, places = 0;
  for (float y = 30; y < 90; y += 10)
    for (float x = 70; x < 130; x += 10, ++places)
      if (const auto disparity = search_row(left, {x, y}, right, kRadius, {})) {
        ++found;
        EXPECT_NEAR(*disparity, GetParam(), 1.6) << x << " " << y;
      }
  EXPECT_GT(found, places * 3 / 4);
}

INSTANTIATE_TEST_SUITE_P(Pixels, Disparities, testing::Values(-2.0, 0.0, 0.6, 7.3, 31.0));

TEST(RowSearch, DropsTheAmbiguousAndTheFlat) {
  const auto stripes = [](double shift) {
    cv::Mat image(kHeight, kWidth, CV_8UC1);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        image.at<uchar>(y, x) = cv::saturate_cast<uchar>(128 + 60 * std::sin(2 * M_PI * (x + shift) / 16) +
                                                         20 * std::sin(y / 3.0));
    return AlignmentPyramid(image, 3);
  };
  EXPECT_FALSE(search_row(stripes(0), {100, 60}, stripes(3), kRadius, {}));
  const AlignmentPyramid flat(cv::Mat(kHeight, kWidth, CV_8UC1, cv::Scalar(90)), 3);
  EXPECT_FALSE(search_row(flat, {100, 60}, flat, kRadius, {}));
}

TEST(RowSearch, RefusesPlacesOutside) {
  const AlignmentPyramid image = shifted(Texture(3), 0);
  EXPECT_FALSE(search_row(image, {-20, 60}, image, kRadius, {}));
  EXPECT_FALSE(search_row(image, {100, 500}, image, kRadius, {}));
}

}  // namespace
}  // namespace spslam
