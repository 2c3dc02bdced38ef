// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/stereo/stereo.h"

#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include "spslam/base/error.h"
#include "stereo/synthetic_pair.h"

namespace spslam {
namespace {

using test::make_pair;
using test::Pair;
using test::PairSettings;

StereoOptions quadric() {
  StereoOptions options;
  options.block_matching = true;
  options.alignment = false;
  return options;
}

std::vector<StereoMeasurement> measure(const Pair& pair, const StereoOptions& options) {
  const AlignmentPyramid left(pair.left_levels[0], 4), right(pair.right_levels[0], 4);
  return measure_stereo({pair.left, pair.left_levels, &left}, {pair.right, pair.right_levels, &right},
                        options);
}

struct Statistics {
  double measured = 0;  // share
  double bias = 0, spread = 0, row = 0, normalized = 0;
};

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

Statistics statistics(const std::vector<StereoMeasurement>& measured, double disparity) {
  std::vector<double> errors, rows, normalized;
  for (const StereoMeasurement& m : measured) {
    if (!m.ok()) continue;
    errors.push_back(m.disparity - disparity), rows.push_back(m.row_offset);
    normalized.push_back(std::abs(errors.back()) / m.sigma);
  }
  if (errors.empty()) return {};
  Statistics s;
  s.measured = static_cast<double>(errors.size()) / static_cast<double>(measured.size());
  s.bias = median(errors), s.row = median(rows), s.normalized = 1.4826 * median(normalized);
  for (double& e : errors) e = std::abs(e - s.bias);
  s.spread = 1.4826 * median(errors);
  return s;
}

struct Case {
  const char* name;
  PairSettings pair;
};

class StereoCases : public testing::TestWithParam<Case> {};

TEST_P(StereoCases, AlignmentMeasuresToAFewHundredthsOfAPixel) {
  const PairSettings& s = GetParam().pair;
  const Statistics found = statistics(measure(make_pair(s, 3), StereoOptions()), s.disparity);
  EXPECT_GT(found.measured, 0.95);
  EXPECT_NEAR(found.bias, 0, 0.02);
  EXPECT_LT(found.spread, 0.05);
  EXPECT_NEAR(found.row, s.row_offset, 0.02);
}

TEST_P(StereoCases, QuadricMeasuresToAFewTenthsOfAPixel) {
  const PairSettings& s = GetParam().pair;
  const Statistics found = statistics(measure(make_pair(s, 3), quadric()), s.disparity);
  EXPECT_GT(found.measured, 0.9);
  EXPECT_NEAR(found.bias, 0, 0.25);  // whole pixels attract it
  EXPECT_LT(found.spread, 0.2);
  EXPECT_NEAR(found.row, s.row_offset, 0.3);
}

INSTANTIATE_TEST_SUITE_P(
    All, StereoCases,
    testing::Values(Case{"Plain", {.disparity = 7.0, .noise = 2}},
                    Case{"Quarter", {.disparity = 7.25, .noise = 2}},
                    Case{"Half", {.disparity = 3.5, .noise = 2}}, Case{"Far", {.disparity = 0.3, .noise = 2}},
                    Case{"RowOffset", {.disparity = 4.7, .row_offset = 0.6, .noise = 2}},
                    Case{"RowsOffByOneAndAHalf", {.disparity = 2.2, .row_offset = -1.5, .noise = 2}},
                    Case{"GainAndOffset", {.disparity = 5.4, .gain = 0.8, .offset = 12, .noise = 2}},
                    Case{"LowContrastBright", {.disparity = 1.8, .gain = 0.6, .offset = 40, .noise = 1}}),
    [](const auto& test) { return test.param.name; });

TEST(Stereo, CoarserLevelsMeasureToo) {
  PairSettings s{.disparity = 6.3, .noise = 2};
  for (int octave = 1; octave < 4; ++octave) {
    const Statistics found = statistics(measure(make_pair(s, 4, octave), quadric()), s.disparity);
    EXPECT_GT(found.measured, 0.9) << octave;
    EXPECT_NEAR(found.bias, 0, 0.12 * std::pow(1.2, octave))
        << octave;  // whole pixels of the level attract it
  }
}

// A difference of exposure between the eyes must not look like a shift: on a slope of brightness it does for
// plain SAD.
TEST(Stereo, GainDifferenceDoesNotBias) {
  PairSettings s{.disparity = 2.4, .gain = 1.1, .offset = -9, .noise = 1};
  const Pair pair = make_pair(s, 8);
  StereoOptions options = quadric();
  const Statistics matched = statistics(measure(pair, options), s.disparity);
  options.match_brightness = false;
  const Statistics raw = statistics(measure(pair, options), s.disparity);
  EXPECT_LT(matched.spread, raw.spread);
  EXPECT_LT(statistics(measure(pair, StereoOptions()), s.disparity).spread, matched.spread);
}

TEST(Stereo, AtInfinityNoiseHasBothSignsAndNoneIsCut) {
  PairSettings s{.disparity = 0, .noise = 6};
  for (const StereoOptions& options : {StereoOptions(), quadric()}) {
    double sum = 0, squares = 0;
    int count = 0, negative = 0, points = 0;
    for (std::uint64_t seed = 20; seed < 24; ++seed) {
      for (const StereoMeasurement& m : measure(make_pair(s, seed), options)) {
        ++points;
        if (!m.ok()) continue;
        sum += m.disparity, squares += m.disparity * m.disparity;
        ++count, negative += m.disparity < 0;
      }
    }
    EXPECT_GT(count, 0.9 * points);
    EXPECT_NEAR(sum / count, 0, 4 * std::sqrt(squares) / count);  // four standard errors of the mean
    EXPECT_NEAR(static_cast<double>(negative) / count, 0.5, 0.06);
  }
}

TEST(Stereo, SigmaDescribesTheErrors) {
  for (const double noise : {1.0, 4.0, 10.0}) {
    PairSettings s{.disparity = 3.3, .noise = noise};
    const Statistics found = statistics(measure(make_pair(s, 30), StereoOptions()), s.disparity);
    EXPECT_GT(found.normalized, 0.25) << noise;
    EXPECT_LT(found.normalized, 1.5) << noise;
  }
  PairSettings clean{.disparity = 3.3, .noise = 1}, noisy{.disparity = 3.3, .noise = 10};
  const auto a = measure(make_pair(clean, 30), StereoOptions()),
             b = measure(make_pair(noisy, 30), StereoOptions());
  std::vector<double> sigma_a, sigma_b;
  for (const auto& m : a) sigma_a.push_back(m.sigma);
  for (const auto& m : b) sigma_b.push_back(m.sigma);
  EXPECT_LT(median(sigma_a), median(sigma_b));
}

TEST(Stereo, PointsWithoutAMatchAreMeasuredFromTheirNeighbours) {
  PairSettings s{.disparity = 5.6, .noise = 2};
  Pair pair = make_pair(s, 9);
  Random random(1);
  for (std::size_t i = 0; i < pair.left.descriptors.size(); i += 3)
    pair.left.descriptors[i] = test::random_descriptor(random);  // nothing on the right looks like these
  StereoOptions options;
  const auto measured = measure(pair, options);
  EXPECT_GT(statistics(measured, s.disparity).measured, 0.95);
  EXPECT_NEAR(measured[0].disparity, s.disparity, 0.2);
  options.align_unmatched = false;
  EXPECT_EQ(measure(pair, options)[0].status, StereoStatus::kNone);
}

TEST(Stereo, RepeatingTextureIsDropped) {
  Pair pair = make_pair({.disparity = 4}, 11);
  for (auto& d : pair.left.descriptors) d = pair.left.descriptors[0];
  pair.right.descriptors = pair.left.descriptors;
  for (const bool align : {false, true}) {
    StereoOptions options;
    options.alignment = align;
    options.align_unmatched = false;
    const auto measured = measure(pair, options);
    for (std::size_t i = 0; i < measured.size(); ++i) {
      if (pair.left.keypoints[i].x < 80) continue;  // one place only within the limits of disparity
      EXPECT_EQ(measured[i].status, StereoStatus::kAmbiguous);
    }
  }
}

TEST(Stereo, WhatTheRightEyeDoesNotSeeIsRejected) {
  const PairSettings s{.disparity = 4, .noise = 2};
  Pair pair = make_pair(s, 12);
  const Pair other = make_pair(s, 13);
  for (std::size_t i = 0; i < pair.right_levels.size();
       ++i) {  // the left third of the right image shows something else
    const int columns = pair.right_levels[i].cols / 3;
    other.right_levels[i].colRange(0, columns).copyTo(pair.right_levels[i].colRange(0, columns));
  }
  for (const StereoOptions& options : {StereoOptions(), quadric()}) {
    const auto measured = measure(pair, options);
    int hidden = 0, wrong = 0, seen = 0, right = 0;
    for (std::size_t i = 0; i < measured.size(); ++i) {
      const float x = pair.right.keypoints[i].x;
      if (x < s.width / 3.0 - 12) ++hidden, wrong += measured[i].ok();
      if (x > s.width / 3.0 + 12) ++seen, right += measured[i].ok();
    }
    EXPECT_LE(wrong, 0.05 * hidden);
    EXPECT_GE(right, 0.9 * seen);
  }
}

TEST(Stereo, FlatImagesHaveNoDisparity) {
  Pair pair = make_pair({.disparity = 4}, 14);
  for (auto* levels : {&pair.left_levels, &pair.right_levels})
    for (cv::Mat& level : *levels) level.setTo(90);
  for (const StereoOptions& options :
       {StereoOptions(), quadric(), paper_stereo_options(), baseline_stereo_options()})
    for (const StereoMeasurement& m : measure(pair, options)) ASSERT_FALSE(m.ok()) << to_string(m.status);
}

TEST(Stereo, EmptyFeaturesAreNoError) {
  Pair pair = make_pair({}, 15);
  const Features some = pair.left;
  pair.left = {};
  EXPECT_TRUE(measure(pair, StereoOptions()).empty());
  pair.left = some, pair.right = {};
  for (const StereoMeasurement& m : measure(pair, quadric())) EXPECT_EQ(m.status, StereoStatus::kNone);
  EXPECT_TRUE(measure_stereo({{}, {}}, {{}, {}}, StereoOptions()).empty());
}

TEST(Stereo, LevelsThatDoNotFitAreAnError) {
  Pair pair = make_pair({}, 16);
  pair.right_levels.pop_back();
  EXPECT_THROW(measure(pair, StereoOptions()), InputError);
  pair = make_pair({}, 16);
  pair.right_levels[1] = pair.right_levels[1].colRange(0, 100);
  EXPECT_THROW(measure(pair, StereoOptions()), InputError);
  pair = make_pair({}, 16);
  pair.right_levels[2].convertTo(pair.right_levels[2], CV_32F);
  EXPECT_THROW(measure(pair, StereoOptions()), InputError);
}

TEST(Stereo, SameBitsAtAnyNumberOfThreads) {
  const Pair pair = make_pair({.disparity = 4.3, .noise = 3}, 17, 1, 6);
  for (const StereoOptions& options : {StereoOptions(), quadric()}) {
    std::vector<StereoMeasurement> one;
    {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
      one = measure(pair, options);
    }
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 4);
    const auto many = measure(pair, options);
    for (std::size_t i = 0; i < one.size(); ++i) {
      ASSERT_EQ(one[i].disparity, many[i].disparity);
      ASSERT_EQ(one[i].sigma, many[i].sigma);
      ASSERT_EQ(one[i].status, many[i].status);
    }
  }
}

TEST(Stereo, OptionsAreInRange) {
  for (const StereoOptions& options : {StereoOptions(), paper_stereo_options(), baseline_stereo_options()})
    EXPECT_NO_THROW(check_options(options));
  EXPECT_FALSE(baseline_stereo_options().search_2d);
  EXPECT_EQ(paper_stereo_options().interpolation, Interpolation::kQuadric);
}

}  // namespace
}  // namespace spslam
