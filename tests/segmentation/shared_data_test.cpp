// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// How well far keypoints are told on images of known depth, and on photographs whether what is certain is
// right.
#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "spslam/features/orb_extractor.h"
#include "spslam/segmentation/distance_segmenter.h"

namespace spslam {
namespace {

namespace fs = std::filesystem;

struct Agreement {
  int true_far = 0, false_far = 0, missed = 0;
  double precision() const { return true_far / std::max(1.0, static_cast<double>(true_far + false_far)); }
  double recall() const { return true_far / std::max(1.0, static_cast<double>(true_far + missed)); }
};

std::string frame_name(int frame, const char* extension) {
  const std::string digits = std::to_string(frame);
  return std::string(6 - digits.size(), '0') + digits + extension;
}

// All frames pass the segmenter; those with a mask of the truth (255 where z > 40 m or sky) are judged.
Agreement agreement(const fs::path& sequence) {
  DistanceSegmenter segmenter;
  OrbExtractor extractor;
  Agreement sum;
  for (int frame = 0; frame < 240; ++frame) {
    const cv::Mat image =
        cv::imread((sequence / "image_0" / frame_name(frame, ".jpg")).string(), cv::IMREAD_GRAYSCALE);
    const SegmentationResult result = segmenter.update(image);
    if (frame % 20 != 0) continue;
    const cv::Mat truth =
        cv::imread((sequence / "far_mask" / frame_name(frame, ".png")).string(), cv::IMREAD_GRAYSCALE);
    for (const Keypoint& keypoint : extractor.extract(image).keypoints) {
      const bool is_far = truth.at<std::uint8_t>(cvRound(keypoint.y), cvRound(keypoint.x)) > 0;
      const bool said_far = result.regions.at(keypoint.x, keypoint.y) == Region::kFar;
      sum.true_far += is_far && said_far ? 1 : 0;
      sum.false_far += !is_far && said_far ? 1 : 0;
      sum.missed += is_far && !said_far ? 1 : 0;
    }
  }
  return sum;
}

TEST(SharedData, AgreesWithTheDepthOfRenderedShores) {
  for (const char* name : {"nearshore_bank", "nearshore_loop"}) {
    const fs::path sequence = fs::path(SPSLAM_SHARED_DATA) / name;
    if (!fs::exists(sequence / "far_mask")) GTEST_SKIP() << "no " << sequence;
    const Agreement result = agreement(sequence);
    RecordProperty(std::string(name) + "_precision", std::to_string(result.precision()));
    RecordProperty(std::string(name) + "_recall", std::to_string(result.recall()));
    EXPECT_GT(result.precision(), 0.75) << name;
    EXPECT_GT(result.recall(), 0.7) << name;
  }
}

// Masks of the photographs: 1 = water. The sky is never water, so hardly any pixel of the far region,
// undilated, may be.
TEST(SharedData, SeldomTakesWaterForSky) {
  const fs::path folder = fs::path(SPSLAM_SHARED_DATA) / "usvinland_water";
  if (!fs::exists(folder)) GTEST_SKIP() << "no " << folder;
  int photographs = 0, with_far = 0, good = 0;
  for (const auto& entry : fs::directory_iterator(folder / "images")) {
    const cv::Mat image = cv::imread(entry.path().string(), cv::IMREAD_GRAYSCALE);
    const cv::Mat water =
        cv::imread((folder / "masks" / entry.path().stem()).string() + ".png", cv::IMREAD_GRAYSCALE);
    ASSERT_EQ(image.size(), water.size()) << entry.path();
    const SegmentationResult result = DistanceSegmenter().update(image);
    ++photographs;
    const cv::Mat far = result.regions.labels() == static_cast<int>(Region::kFar);
    const int pixels = cv::countNonZero(far);
    if (pixels == 0) continue;
    ++with_far;
    good += cv::countNonZero(far & (water > 0)) < 0.2 * pixels ? 1 : 0;
  }
  EXPECT_EQ(photographs, 53);
  EXPECT_GE(with_far, 40);
  EXPECT_GE(good, with_far * 3 / 4) << "of " << with_far;
}

}  // namespace
}  // namespace spslam
