// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/camera/rectifier.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/features2d.hpp>
#include <opencv2/imgcodecs.hpp>

#include "spslam/base/error.h"
#include "spslam/base/random.h"

namespace spslam {
namespace {

SE3 transform(const std::array<double, 16>& m) {
  SE3 t;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) t.rotation(r, c) = m[4 * r + c];
    t.translation[r] = m[4 * r + 3];
  }
  return t.normalized();
}

// EuRoC's VI-sensor (sensor.yaml of V1_01): real distortion, eyes turned against each other by 1.4 degrees.
RawStereo euroc() {
  const SE3 body_from_left =
      transform({0.0148655429818, -0.999880929698, 0.00414029679422, -0.0216401454975, 0.999557249008,
                 0.0149672133247, 0.025715529948, -0.064676986768, -0.0257744366974, 0.00375618835797,
                 0.999660727178, 0.00981073058949, 0, 0, 0, 1});
  const SE3 body_from_right =
      transform({0.0125552670891, -0.999755099723, 0.0182237714554, -0.0198435579556, 0.999598781151,
                 0.0130119051815, 0.0251588363115, 0.0453689425024, -0.0253898008918, 0.0179005838253,
                 0.999517347078, 0.00786212447038, 0, 0, 0, 1});
  RawStereo raw;
  raw.left = {752,
              480,
              458.654,
              457.296,
              367.215,
              248.375,
              LensModel::kRadtan,
              {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05}};
  raw.right = {752,
               480,
               457.587,
               456.134,
               379.999,
               255.238,
               LensModel::kRadtan,
               {-0.28368365, 0.07451284, -0.00010473, -3.55590700e-05}};
  raw.right_from_left = body_from_right.inverse() * body_from_left;
  return raw;
}

RawStereo fisheye() {
  RawStereo raw = euroc();
  raw.left.lens = raw.right.lens = LensModel::kEquidistant;
  raw.left.distortion = {-0.02, 0.01, -0.004, 0.001};
  raw.right.distortion = {-0.018, 0.009, -0.003, 0.0008};
  return raw;
}

// Written out from the two models' definitions, independently of OpenCV.
Eigen::Vector2d project_raw(const RawCamera& camera, const Eigen::Vector3d& point) {
  const double x = point.x() / point.z(), y = point.y() / point.z(), r2 = x * x + y * y;
  const std::vector<double>& k = camera.distortion;
  double xd = x, yd = y;
  if (camera.lens == LensModel::kRadtan) {
    const double radial = 1 + k[0] * r2 + k[1] * r2 * r2;
    xd = x * radial + 2 * k[2] * x * y + k[3] * (r2 + 2 * x * x);
    yd = y * radial + k[2] * (r2 + 2 * y * y) + 2 * k[3] * x * y;
  } else {
    const double r = std::sqrt(r2), a = std::atan(r), a2 = a * a;
    const double scale = r < 1e-9 ? 1 : a * (1 + a2 * (k[0] + a2 * (k[1] + a2 * (k[2] + a2 * k[3])))) / r;
    xd *= scale, yd *= scale;
  }
  return {camera.fx * xd + camera.cx, camera.fy * yd + camera.cy};
}

// A bright spot with a smooth edge around each centre on black.
cv::Mat spots(const std::vector<Eigen::Vector2d>& centres, const RawCamera& camera) {
  cv::Mat image(camera.height, camera.width, CV_8UC1, cv::Scalar(0));
  for (const Eigen::Vector2d& c : centres)
    for (int y = std::max(0, int(c.y()) - 9); y < std::min(camera.height, int(c.y()) + 10); ++y)
      for (int x = std::max(0, int(c.x()) - 9); x < std::min(camera.width, int(c.x()) + 10); ++x)
        image.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(
            std::lround(250 * std::exp(-(Eigen::Vector2d(x, y) - c).squaredNorm() / 8)));
  return image;
}

Eigen::Vector2d centroid(const cv::Mat& image, const Eigen::Vector2d& near) {
  Eigen::Vector2d sum(0, 0);
  double weight = 0;
  for (int y = int(near.y()) - 9; y <= int(near.y()) + 10; ++y)
    for (int x = int(near.x()) - 9; x <= int(near.x()) + 10; ++x) {
      const double value = image.at<std::uint8_t>(y, x);
      sum += value * Eigen::Vector2d(x, y), weight += value;
    }
  return sum / weight;
}

class RectifiedSpots : public testing::TestWithParam<RawStereo> {};

// Points of the rectified camera, drawn through the raw lenses, come back where the rig says.
TEST_P(RectifiedSpots, LieOnTheirRowsAtTheirDisparity) {
  const RawStereo raw = GetParam();
  const Rectifier rectifier(raw);
  const StereoRig& rig = rectifier.rig();
  EXPECT_NEAR(rig.baseline, raw.right_from_left.translation.norm(), 1e-9);
  Random random(5);
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> left_raw, right_raw;
  for (int v = 60; v < rig.height - 60; v += 60)
    for (int u = 130; u < rig.width - 60; u += 60) {
      points.push_back(random.uniform(1.5, 10) * rig.bearing(u + random.uniform(), v + random.uniform()));
      const Eigen::Vector3d in_left = rectifier.raw_left_from_rectified() * points.back();
      left_raw.push_back(project_raw(raw.left, in_left));
      right_raw.push_back(project_raw(raw.right, raw.right_from_left * in_left));
    }
  // One spot an image: none may hide or touch another.
  double worst = 0, worst_row = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const cv::Mat left = rectifier.rectify_left(spots({left_raw[i]}, raw.left));
    const cv::Mat right = rectifier.rectify_right(spots({right_raw[i]}, raw.right));
    const Eigen::Vector2d expected_left = rig.project(points[i]);
    const Eigen::Vector2d expected_right = rig.project(points[i] - Eigen::Vector3d(rig.baseline, 0, 0));
    const Eigen::Vector2d found_left = centroid(left, expected_left),
                          found_right = centroid(right, expected_right);
    worst = std::max({worst, (found_left - expected_left).norm(), (found_right - expected_right).norm()});
    worst_row = std::max(worst_row, std::abs(found_left.y() - found_right.y()));
  }
  EXPECT_LT(worst, 0.08);
  EXPECT_LT(worst_row, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Lenses, RectifiedSpots, testing::Values(euroc(), fisheye()));

double median_row_offset(const cv::Mat& left, const cv::Mat& right, int& count) {
  const cv::Ptr<cv::ORB> orb = cv::ORB::create(1000, 1.2F, 1);
  std::vector<cv::KeyPoint> a, b;
  cv::Mat descriptors_a, descriptors_b;
  orb->detectAndCompute(left, cv::noArray(), a, descriptors_a);
  orb->detectAndCompute(right, cv::noArray(), b, descriptors_b);
  std::vector<cv::DMatch> matches;
  cv::BFMatcher(cv::NORM_HAMMING, true).match(descriptors_a, descriptors_b, matches);
  std::vector<double> rows;
  for (const cv::DMatch& match : matches)
    if (match.distance < 40) rows.push_back(std::abs(a[match.queryIdx].pt.y - b[match.trainIdx].pt.y));
  count = static_cast<int>(rows.size());
  if (rows.empty()) return 1e9;
  std::nth_element(rows.begin(), rows.begin() + count / 2, rows.end());
  return rows[rows.size() / 2];
}

TEST(Rectifier, RealPair) {
  const std::filesystem::path cameras = std::filesystem::path(SPSLAM_SHARED_DATA) / "euroc_still" / "mav0";
  if (!std::filesystem::is_directory(cameras)) GTEST_SKIP() << "no sequences at " << SPSLAM_SHARED_DATA;
  const std::string name = "data/1403715273262142976.png";
  const cv::Mat left = cv::imread((cameras / "cam0" / name).string(), cv::IMREAD_GRAYSCALE);
  const cv::Mat right = cv::imread((cameras / "cam1" / name).string(), cv::IMREAD_GRAYSCALE);
  const Rectifier rectifier(euroc());
  int raw_count = 0, count = 0;
  const double raw = median_row_offset(left, right, raw_count);
  const double rectified =
      median_row_offset(rectifier.rectify_left(left), rectifier.rectify_right(right), count);
  EXPECT_GT(count, 100);
  EXPECT_LT(rectified, 1.0) << "ORB's positions are whole pixels";
  EXPECT_GT(raw, 3.0) << "the raw rows do not correspond";
}

TEST(Rectifier, LeavesARectifiedPairAlone) {
  RawStereo raw = euroc();
  raw.left.distortion = {0, 0, 0, 0};
  raw.right = raw.left;
  raw.right_from_left = {Eigen::Matrix3d::Identity(), {-0.11, 0, 0}};
  const cv::Mat image = spots({{100.3, 200.4}, {500, 300}}, raw.left);
  const Rectifier rectifier(raw);
  EXPECT_EQ(cv::norm(image, rectifier.rectify_right(image), cv::NORM_INF), 0);
  EXPECT_FALSE(rectifier.resamples());
  EXPECT_EQ(rectifier.rig().fy, raw.left.fy);
  EXPECT_EQ(rectifier.rig().baseline, 0.11);
  raw.right_from_left.rotation = so3_exp({0, 1e-3, 0});
  EXPECT_GT(cv::norm(image, Rectifier(raw).rectify_right(image), cv::NORM_INF), 0);
}

TEST(Rectifier, RefusesImpossibleRigs) {
  RawStereo raw = euroc();
  raw.right_from_left.translation = -raw.right_from_left.translation;
  EXPECT_THROW(Rectifier{raw}, InputError) << "eyes swapped";
  raw = euroc();
  raw.right_from_left.translation = {0, -0.1, 0};
  EXPECT_THROW(Rectifier{raw}, InputError) << "one eye above the other";
  raw = euroc();
  raw.left.distortion.pop_back();
  EXPECT_THROW(Rectifier{raw}, InputError);
  raw = euroc();
  raw.right.width = 640;
  EXPECT_THROW(Rectifier{raw}, InputError);
  EXPECT_THROW(Rectifier(euroc()).rectify_left(cv::Mat(480, 640, CV_8UC1)), InputError)
      << "image of another size";
}

}  // namespace
}  // namespace spslam
