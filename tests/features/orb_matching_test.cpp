// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Whether features of one place are found again and recognised in a turned, scaled, darker or noisy view,
// with cv::ORB on the same images as the reference.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <opencv2/features2d.hpp>
#include <opencv2/imgcodecs.hpp>

#include "features/test_images.h"
#include "spslam/features/orb_extractor.h"

namespace spslam {
namespace {

struct Score {
  int matches = 0, inliers = 0;
  double error = 0;        // px, mean of the inliers
  double coverage = 0;     // share of the cells of a 16 x 9 grid with an inlier
  double angle_error = 0;  // rad, mean of the inliers
  double inlier_ratio() const { return matches > 0 ? static_cast<double>(inliers) / matches : 0; }
};

std::vector<int> nearest(const Features& from, const Features& to) {
  std::vector<int> best(from.keypoints.size(), -1);
  for (std::size_t i = 0; i < best.size(); ++i) {
    int distance = 65;
    for (std::size_t j = 0; j < to.keypoints.size(); ++j) {
      const int d = hamming(from.descriptors[i], to.descriptors[j]);
      if (d < distance) distance = d, best[i] = static_cast<int>(j);
    }
  }
  return best;
}

// Matches both ways; an inlier is within 3 px of where the warp (turned by `turn`) takes it.
Score match(const Features& a, const Features& b, const cv::Matx33d& warp, double turn, cv::Size size) {
  const std::vector<int> forward = nearest(a, b), backward = nearest(b, a);
  Score score;
  cv::Mat cells(9, 16, CV_8UC1, cv::Scalar(0));
  for (std::size_t i = 0; i < forward.size(); ++i) {
    if (forward[i] < 0 || backward[forward[i]] != static_cast<int>(i)) continue;
    ++score.matches;
    const Keypoint &p = a.keypoints[i], &q = b.keypoints[forward[i]];
    const cv::Vec3d w = warp * cv::Vec3d(p.x, p.y, 1);
    const double error = std::hypot(w[0] / w[2] - q.x, w[1] / w[2] - q.y);
    if (error > 3) continue;
    ++score.inliers;
    score.error += error;
    score.angle_error += std::abs(std::remainder(q.angle - p.angle - turn, 2 * M_PI));
    cells.at<std::uint8_t>(static_cast<int>(p.y * 9 / size.height), static_cast<int>(p.x * 16 / size.width)) =
        1;
  }
  score.error /= std::max(1, score.inliers);
  score.angle_error /= std::max(1, score.inliers);
  score.coverage = cv::countNonZero(cells) / 144.0;
  return score;
}

Features opencv_orb(const cv::Mat& image) {
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
  cv::ORB::create(1500)->detectAndCompute(image, {}, keypoints, descriptors);
  Features features;
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    features.keypoints.push_back({keypoints[i].pt.x, keypoints[i].pt.y,
                                  static_cast<float>(keypoints[i].angle * M_PI / 180), keypoints[i].response,
                                  static_cast<std::uint8_t>(keypoints[i].octave)});
    std::memcpy(features.descriptors.emplace_back().data(), descriptors.ptr(static_cast<int>(i)), 32);
  }
  return features;
}

struct View {
  const char* name;
  double turn = 0;  // rad
  double scale = 1;
  double gain = 1, offset = 0, noise = 2;

  // About the centre, with a shift that is no whole pixel.
  cv::Matx33d warp(cv::Size size) const {
    const double c = scale * std::cos(turn), s = scale * std::sin(turn);
    const double x = size.width / 2.0, y = size.height / 2.0;
    return {c, -s, x - c * x + s * y + 2.3, s, c, y - s * x - c * y - 1.7, 0, 0, 1};
  }
  cv::Mat of(const cv::Mat& image) const {
    cv::Mat warped;
    cv::warpPerspective(image, warped, cv::Mat(warp(image.size())), image.size(), cv::INTER_LINEAR,
                        cv::BORDER_REFLECT);
    return test::with_noise(warped, noise, 11, gain, offset);
  }
};

void PrintTo(const View& view, std::ostream* out) {
  *out << view.name;
}

class OrbMatching : public testing::TestWithParam<View> {};

Score score_view(const cv::Mat& image, const View& view) {
  const Features a = OrbExtractor().extract(image), b = OrbExtractor().extract(view.of(image));
  return match(a, b, view.warp(image.size()), view.turn, image.size());
}

TEST_P(OrbMatching, RecognisesTheShapes) {
  const cv::Mat image = test::with_noise(test::shapes_image({640, 360}, 21, 1500), 2, 1);
  const Score own = score_view(image, GetParam());
  EXPECT_GT(own.inlier_ratio(), 0.7);
  EXPECT_GT(own.inliers, 350);
  EXPECT_LT(own.error, 0.8);
  EXPECT_LT(own.angle_error, 0.15);
}

TEST_P(OrbMatching, IsNoWorseThanOpenCvOnPhotographs) {
  const std::filesystem::path folder = SPSLAM_SHARED_DATA;
  for (const char* name : {"nearshore_bank/image_0/000100.jpg", "kitti_raw/image_0/000100.jpg"}) {
    const cv::Mat image = cv::imread((folder / name).string(), cv::IMREAD_GRAYSCALE);
    if (image.empty()) GTEST_SKIP() << "no " << name << " in the shared data (" << folder << ")";
    const Score own = score_view(image, GetParam());
    const Score reference = match(opencv_orb(image), opencv_orb(GetParam().of(image)),
                                  GetParam().warp(image.size()), GetParam().turn, image.size());
    // cv::ORB clusters on the strongest texture, where matching is easiest; ours covers twice the image, more
    // precisely.
    EXPECT_GT(own.inlier_ratio(), reference.inlier_ratio() - 0.15) << name;
    EXPECT_GT(own.inliers, 0.6 * reference.inliers) << name;
    EXPECT_GT(own.coverage, 1.3 * reference.coverage) << name;
    EXPECT_LT(own.error, 0.8 * reference.error) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Views, OrbMatching,
                         testing::Values(View{"same"}, View{"turned by 20 degrees", 0.35},
                                         View{"turned by 90", 1.5708}, View{"turned by 170", 2.967},
                                         View{"scaled by 1.3", 0.05, 1.3}, View{"scaled by 0.7", 0, 0.7},
                                         View{"darker", 0.02, 1, 0.6, 5}, View{"brighter", 0, 1, 1.2, 20},
                                         View{"noisy", 0, 1, 1, 0, 6}));

}  // namespace
}  // namespace spslam
