// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Rigs of known faults: what is measured of them without assuming that they have none.

#include "spslam/stereo/pair_check.h"

#include <gmock/gmock.h>

#include "stereo/synthetic_pair.h"

namespace spslam {
namespace {

using test::Texture;

const cv::Size kImage(480, 320);

// How a rig sees a point of the left image: by `disparity` further left, in rows off by `offset`, turned by
// `roll` and stretched by `stretch` about the middle.
struct Rig {
  double disparity = 6;  // px
  double offset = 0;     // px, right rows lower
  double roll = 0;       // rad
  double stretch = 1;    // of rows
};

struct RenderedPair {
  cv::Mat left, right;
};

// A far half (disparity 0) on top of a near one, of one texture each.
RenderedPair render_rig(const Rig& rig, std::uint64_t seed = 7) {
  const Texture texture(seed);
  RenderedPair pair{cv::Mat(kImage, CV_8UC1), cv::Mat(kImage, CV_8UC1)};
  const double middle_x = 0.5 * (kImage.width - 1), middle_y = 0.5 * (kImage.height - 1);
  const auto seen = [&](double x, double y, double disparity) {
    return cv::saturate_cast<std::uint8_t>(texture.at(x + (y < middle_y ? 0 : disparity), y));
  };
  for (int y = 0; y < kImage.height; ++y)
    for (int x = 0; x < kImage.width; ++x) {
      pair.left.at<std::uint8_t>(y, x) = seen(x, y, 0);
      const double row = (y - rig.offset - middle_y - rig.roll * (x - middle_x)) / rig.stretch + middle_y;
      pair.right.at<std::uint8_t>(y, x) = seen(x, row, rig.disparity);
    }
  return pair;
}

std::vector<PairMatch> matches_of(const RenderedPair& pair) {
  PairMatcher matcher;
  return match_pair(matcher.prepare(pair.left), matcher.prepare(pair.right));
}

RowOffsets rows_of(const Rig& rig) {
  return measure_rows(matches_of(render_rig(rig)), kImage);
}

TEST(PairCheck, SoundRig) {
  const std::vector<PairMatch> matches = matches_of(render_rig({}));
  ASSERT_GT(matches.size(), 100U);
  const RowOffsets rows = measure_rows(matches, kImage);
  EXPECT_NEAR(rows.median, 0, 0.03);
  EXPECT_NEAR(rows.worst_corner, 0, 0.1);
  EXPECT_LT(rows.spread, 0.1);
  const DisparityStatistics disparities = measure_disparities(on_rows(matches, rows));
  EXPECT_NEAR(disparities.quantile_5, 0, 0.1);
  EXPECT_NEAR(disparities.quantile_95, 6, 0.1);
  EXPECT_LT(disparities.negative, 0.02);
  EXPECT_GT(disparities.positive, 0.3);
  EXPECT_NEAR(disparities.below_1 + disparities.positive, 1, 0.1);
  EXPECT_FALSE(seem_swapped(disparities));
}

TEST(PairCheck, RowsOffByPartsOfAPixelAndByMany) {
  for (const double offset : {-0.4, 2.0, 15.0}) {
    const RowOffsets rows = rows_of({.offset = offset});
    EXPECT_GT(rows.matches, 80) << offset;
    EXPECT_NEAR(rows.median, offset, 0.1);
    EXPECT_NEAR(rows.centre, offset, 0.1);
    EXPECT_LT(std::abs(rows.slope_x) + std::abs(rows.slope_y), 1e-3);
  }
}

TEST(PairCheck, RollIsASlopeOverColumns) {
  const RowOffsets rows = rows_of({.roll = 0.01});
  EXPECT_NEAR(rows.slope_x, 0.01, 5e-4);
  EXPECT_NEAR(rows.slope_y, 0, 5e-4);
  EXPECT_NEAR(rows.median, 0, 0.3);
  EXPECT_NEAR(std::abs(rows.worst_corner), 2.4, 0.3);
  EXPECT_LT(rows.corner_sigma, 0.1);
  EXPECT_NEAR(rows.at(0, 160), -2.4, 0.2);
}

TEST(PairCheck, AnotherFocalLengthIsASlopeOverRows) {
  const RowOffsets rows = rows_of({.stretch = 1.01});
  EXPECT_NEAR(rows.slope_y, 0.01, 5e-4);
  EXPECT_NEAR(rows.slope_x, 0, 5e-4);
}

TEST(PairCheck, SwappedEyesHaveNegativeDisparities) {
  const RenderedPair pair = render_rig({});
  const std::vector<PairMatch> matches = matches_of({pair.right, pair.left});
  const RowOffsets rows = measure_rows(matches, kImage);
  const DisparityStatistics disparities = measure_disparities(on_rows(matches, rows));
  EXPECT_NEAR(disparities.quantile_5, -6, 0.2);
  EXPECT_TRUE(seem_swapped(disparities));
}

TEST(PairCheck, WrongMatchesDoNotPull) {
  std::vector<PairMatch> matches;
  for (int i = 0; i < 300; ++i) {
    const auto x = static_cast<float>(i * 37 % 480), y = static_cast<float>(i * 53 % 320);
    const float wrong = i % 6 == 0 ? static_cast<float>(i % 19) : 0;
    matches.push_back({x, y, 3, 0.5F + 0.002F * x + wrong});
  }
  const RowOffsets rows = measure_rows(matches, kImage);
  EXPECT_NEAR(rows.at(0, 0), 0.5, 0.05);
  EXPECT_NEAR(rows.slope_x, 0.002, 1e-4);
  EXPECT_EQ(on_rows(matches, rows).size(), 253U) << "with three wrong ones of offset 0";
}

TEST(PairCheck, NothingToMatch) {
  const cv::Mat flat(kImage, CV_8UC1, cv::Scalar(90));
  const std::vector<PairMatch> none = matches_of({flat, flat});
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(measure_rows(none, kImage).matches, 0);
  EXPECT_EQ(measure_disparities(none).matches, 0);
  EXPECT_FALSE(seem_swapped({}));
  EXPECT_TRUE(matches_of({render_rig({}, 7).left, render_rig({}, 8).right}).size() < 10) << "of two scenes";
}

}  // namespace
}  // namespace spslam
