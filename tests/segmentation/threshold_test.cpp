// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "spslam/segmentation/threshold.h"

#include <gtest/gtest.h>

#include <numeric>
#include <opencv2/imgproc.hpp>

#include "segmentation/test_scenes.h"

namespace spslam {
namespace {

TEST(Histogram, CountsEveryPixelOnce) {
  cv::Mat image(3, 5, CV_8UC1, cv::Scalar(7));
  image.at<std::uint8_t>(2, 4) = 255;
  image.at<std::uint8_t>(0, 1) = 0;
  const Histogram shares = histogram(image);
  EXPECT_DOUBLE_EQ(shares[7], 13 / 15.0);
  EXPECT_DOUBLE_EQ(shares[255], 1 / 15.0);
  EXPECT_DOUBLE_EQ(shares[0], 1 / 15.0);
  EXPECT_NEAR(std::accumulate(shares.begin(), shares.end(), 0.0), 1, 1e-12);
}

TEST(Otsu, AgreesWithOpenCv) {
  for (int seed = 0; seed < 20; ++seed) {
    const test::Scene scene{.sky = 150.0 + 5 * seed, .land = 100.0 - 4 * seed, .noise = 5.0 + 2 * seed};
    const cv::Mat image = scene.draw({160, 90}, seed);
    cv::Mat binary;
    const double reference = cv::threshold(image, binary, 0, 255, cv::THRESH_OTSU);
    EXPECT_EQ(otsu(histogram(image)).threshold, reference) << seed;
  }
}

TEST(Otsu, SplitsTwoValuesBetweenThem) {
  cv::Mat image(10, 10, CV_8UC1, cv::Scalar(40));
  image.rowRange(0, 3).setTo(200);
  const Split split = otsu(histogram(image));
  EXPECT_GE(split.threshold, 40);
  EXPECT_LT(split.threshold, 200);
  EXPECT_NEAR(split.bright_share, 0.3, 1e-9);
  EXPECT_NEAR(split.dark_mean, 40, 1e-9);
  EXPECT_NEAR(split.bright_mean, 200, 1e-9);
  EXPECT_NEAR(split.bimodality, 1, 1e-9);
  // g = w0 (u0 - u)^2 + w1 (u1 - u)^2
  EXPECT_NEAR(split.between, 0.7 * 48 * 48 + 0.3 * 112 * 112, 1e-6);
}

TEST(Otsu, KnowsOneGaussianFromTwo) {
  Random random(1);
  cv::Mat one(300, 300, CV_8UC1), two = one.clone();
  for (int y = 0; y < 300; ++y) {
    for (int x = 0; x < 300; ++x) {
      one.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(120 + 25 * random.normal());
      two.at<std::uint8_t>(y, x) =
          cv::saturate_cast<std::uint8_t>((y < 150 ? 70 : 180) + 20 * random.normal());
    }
  }
  EXPECT_NEAR(otsu(histogram(one)).bimodality, 2 / M_PI, 0.02);
  EXPECT_GT(otsu(histogram(two)).bimodality, 0.85);
}

TEST(Otsu, AcceptsAFlatImage) {
  for (const int grey : {0, 100, 255}) {
    const Split split = otsu(histogram(cv::Mat(5, 5, CV_8UC1, cv::Scalar(grey))));
    EXPECT_EQ(split.bimodality, 0);
    EXPECT_EQ(split.contrast(), 0);
  }
}

TEST(RefineThreshold, EndsInTheMiddleBetweenTheMeans) {
  const cv::Mat image = test::Scene{.sky = 190, .land = 60, .noise = 25}.draw({160, 90}, 1);
  const Histogram shares = histogram(image);
  for (const double start : {70.0, 100.0, 125.0, 160.0, 185.0}) {
    const Split split = refine_threshold(shares, split_at(shares, start));
    EXPECT_NEAR(split.threshold, (split.dark_mean + split.bright_mean) / 2, 0.02) << start;
    EXPECT_NEAR(split.dark_share, otsu(shares).dark_share, 0.01) << start;
  }
}

}  // namespace
}  // namespace spslam
