// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/alignment/patch_aligner.h"

#include <gtest/gtest.h>

#include <numeric>

#include "alignment/waves.h"

namespace spslam {
namespace {

struct Errors {
  std::vector<double> x, y, normalized;
  int failed = 0;
  static double mean(const std::vector<double>& v) {
    return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
  }
  static double rms(const std::vector<double>& v) {
    return std::sqrt(std::inner_product(v.begin(), v.end(), v.begin(), 0.0) / static_cast<double>(v.size()));
  }
};

Errors align_grid(const AlignmentPyramid& from, const AlignmentPyramid& to, const Eigen::Vector2d& shift,
                  const Eigen::Vector2f& start_error) {
  Errors errors;
  for (float y = 25; y < kHeight - 25; y += 7.3F)
    for (float x = 25; x < kWidth - 25; x += 7.7F) {
      const Eigen::Vector2f point(x, y);
      const Alignment a = align_patch(from, point, to, point + start_error, Eigen::Matrix2f::Identity(), {});
      if (!a.ok()) {
        ++errors.failed;
        continue;
      }
      const Eigen::Vector2d e = a.position.cast<double>() - point.cast<double>() - shift;
      errors.x.push_back(e.x());
      errors.y.push_back(e.y());
      errors.normalized.push_back(e.x() / std::sqrt(a.covariance(0, 0)));
    }
  return errors;
}

class Shifts : public testing::TestWithParam<double> {};

TEST_P(Shifts, AreFoundWithoutBiasUnderGainAndOffset) {
  const Texture texture(3);
  const Eigen::Vector2d shift(GetParam(), 0.37 * GetParam());
  const auto moved = [&](double x, double y) { return Eigen::Vector2d(Eigen::Vector2d(x, y) - shift); };
  const AlignmentPyramid from(render(texture, kUnmoved), 4), to(render(texture, moved, 11, 90), 4);
  const Errors errors = align_grid(from, to, shift, {0, 0});
  EXPECT_LE(errors.failed, 2);
  EXPECT_LT(std::abs(Errors::mean(errors.x)), 0.02);
  EXPECT_LT(Errors::rms(errors.x), 0.06);
  EXPECT_LT(Errors::rms(errors.y), 0.06);
}

INSTANTIATE_TEST_SUITE_P(Pixels, Shifts, testing::Values(0.0, 0.25, 0.5, -0.3, 1.8, 5.1, -9.4));

// Low contrast in fog: what is there correlates far less than the threshold asks, and is right all the same.
TEST(PatchAligner, NoiseIsNotAskedToBeAlike) {
  const Texture texture(5);
  const auto fog = [&](double shift, std::uint64_t seed) {
    const auto part = [&](double x, double y) {
      return Eigen::Vector2d(std::max(x, kWidth / 3.0) - shift, x > kWidth / 3.0 ? y : 0);
    };
    return AlignmentPyramid(render(texture, part, 0.8, 128, 1.5, seed), 3, true);
  };
  const AlignmentPyramid from = fog(0, 7), to = fog(0.4, 8);
  AlignmentOptions strict, fair;
  strict.noise_factor = 0;
  fair.noise_factor = 1.8;
  int by_strict = 0, by_fair = 0;
  int near = 0;
  for (float y = 25; y < kHeight - 25; y += 7)
    for (float x = kWidth / 2; x < kWidth - 25; x += 7) {
      const Eigen::Vector2f at(x, y);
      by_strict += align_patch(from, at, to, at, Eigen::Matrix2f::Identity(), strict).ok();
      const Alignment found = align_patch(from, at, to, at, Eigen::Matrix2f::Identity(), fair);
      if (!found.ok()) continue;
      ++by_fair;
      near += std::abs(found.position.x() - x - 0.4F) < 0.5F;
    }
  EXPECT_GT(by_fair, 20);
  EXPECT_LT(by_strict, by_fair / 2);
  EXPECT_GT(near, 0.75 * by_fair);
  // Patches of noise alone have nothing in common, and are refused.
  for (float y = 25; y < kHeight - 25; y += 7) {
    const Eigen::Vector2f at(20, y);
    EXPECT_FALSE(align_patch(from, at, to, at, Eigen::Matrix2f::Identity(), fair).ok());
  }
}

TEST(PatchAligner, VarianceIsThatOfTheErrors) {
  const Texture texture(5);
  const auto moved = [&](double x, double y) { return Eigen::Vector2d(x - 0.4, y); };
  const AlignmentPyramid from(render(texture, kUnmoved, 3, 128, 3), 3),
      to(render(texture, moved, 3, 128, 3, 100), 3);
  const Errors errors = align_grid(from, to, {0.4, 0}, {0, 0});
  EXPECT_GT(Errors::rms(errors.normalized), 0.5);
  EXPECT_LT(Errors::rms(errors.normalized), 2.0);
}

TEST(PatchAligner, WarpedTemplateFollowsZoomAndTurn) {
  const Texture texture(7);
  const Eigen::Matrix2d warp = 1.25 * Eigen::Rotation2Dd(0.3).toRotationMatrix();
  const Eigen::Vector2d centre(80, 60);
  const auto moved = [&](double x, double y) {
    return Eigen::Vector2d(centre + warp.inverse() * (Eigen::Vector2d(x, y) - centre));
  };
  const AlignmentPyramid from(render(texture, kUnmoved), 3), to(render(texture, moved), 3);
  const Eigen::Vector2f point(92, 55);
  const Eigen::Vector2d truth = centre + warp * (point.cast<double>() - centre);
  const Eigen::Vector2f start = truth.cast<float>() + Eigen::Vector2f(1.5F, -1);
  const Alignment a = align_patch(from, point, to, start, warp.cast<float>(), {});
  ASSERT_TRUE(a.ok());
  EXPECT_LT((a.position.cast<double>() - truth).norm(), 0.1);
  EXPECT_GT(a.correlation, 0.97F);
}

TEST(PatchAligner, RefusesFlatForeignAndOutside) {
  const Texture texture(3), other(4);
  const AlignmentPyramid from(render(texture, kUnmoved), 3), foreign(render(other, kUnmoved), 3);
  const AlignmentPyramid flat(cv::Mat(kHeight, kWidth, CV_8UC1, cv::Scalar(128)), 3);
  const Eigen::Matrix2f identity = Eigen::Matrix2f::Identity();
  EXPECT_EQ(align_patch(flat, {60, 60}, from, {60, 60}, identity, {}).status, AlignmentStatus::kFlat);
  EXPECT_FALSE(align_patch(from, {60, 60}, flat, {60, 60}, identity, {}).ok());
  EXPECT_FALSE(align_patch(from, {60, 60}, foreign, {60, 60}, identity, {}).ok());
  EXPECT_EQ(align_patch(from, {60, 60}, from, {-40, 60}, identity, {}).status, AlignmentStatus::kOutside);
  EXPECT_EQ(align_patch(from, {-3, 60}, from, {60, 60}, identity, {}).status, AlignmentStatus::kOutside);
  EXPECT_FALSE(align_patch(from, {60, 60}, from, {60, NAN}, identity, {}).ok());
  EXPECT_FALSE(align_patch(from, {60, 60}, from, {60, 60}, Eigen::Matrix2f::Zero(), {}).ok());
}

TEST(AlignmentPyramid, TinyImageHasOneLevel) {
  EXPECT_EQ(AlignmentPyramid(cv::Mat(1, 1, CV_8UC1, cv::Scalar(9)), 4).size(), 1);
  EXPECT_EQ(AlignmentPyramid(cv::Mat(100, 100, CV_8UC1, cv::Scalar(9)), 4).size(), 3);
}

}  // namespace
}  // namespace spslam
