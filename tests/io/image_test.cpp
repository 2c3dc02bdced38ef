// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/io/image.h"

#include <gtest/gtest.h>

#include "io/synthetic_folder.h"
#include "spslam/io/dataset.h"

namespace spslam {
namespace {

using namespace test;

// 0, 1, 2, ... at `bits` of depth over the whole image, and grey in all channels.
cv::Mat ramp(int type, int largest) {
  cv::Mat image(kHeight, kWidth, type);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const int value = (y * kWidth + x) * largest / (kWidth * kHeight - 1);
      for (int c = 0; c < image.channels(); ++c) {
        if (image.depth() == CV_8U)
          image.ptr<std::uint8_t>(y)[x * image.channels() + c] = static_cast<std::uint8_t>(value);
        else
          image.ptr<std::uint16_t>(y)[x * image.channels() + c] = static_cast<std::uint16_t>(value);
      }
    }
  return image;
}

struct Kind {
  const char* file;
  int type;
  int largest;
  int bit_depth;
  double tolerance;  // grey levels
};

class Decoding : public testing::TestWithParam<Kind> {};

TEST_P(Decoding, GivesGreyEightBit) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / GetParam().file;
  write_image(path, ramp(GetParam().type, GetParam().largest));
  const GreyImage image = read_grey(path, GetParam().bit_depth);
  ASSERT_EQ(image.problem, "");
  ASSERT_EQ(image.pixels.type(), CV_8UC1);
  EXPECT_LE(cv::norm(image.pixels, ramp(CV_8UC1, 255), cv::NORM_INF), GetParam().tolerance);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, Decoding,
    testing::Values(Kind{"grey.png", CV_8UC1, 255, 16, 0}, Kind{"colour.png", CV_8UC3, 255, 16, 1},
                    Kind{"alpha.png", CV_8UC4, 255, 16, 1}, Kind{"grey.jpg", CV_8UC1, 255, 16, 4},
                    Kind{"colour.JPEG", CV_8UC3, 255, 16, 4}, Kind{"grey16.png", CV_16UC1, 65535, 16, 1},
                    Kind{"grey12.png", CV_16UC1, 4095, 12, 1}, Kind{"colour16.png", CV_16UC3, 65535, 16, 1}));

TEST(Image, UsedBitDepth) {
  EXPECT_EQ(used_bit_depth(ramp(CV_16UC1, 255)), 8);
  EXPECT_EQ(used_bit_depth(ramp(CV_16UC1, 256)), 10);
  EXPECT_EQ(used_bit_depth(ramp(CV_16UC1, 4095)), 12);
  EXPECT_EQ(used_bit_depth(ramp(CV_16UC1, 65535)), 16);
}

TEST(Image, MoreThanTheStatedDepthSaturates) {
  const TemporaryFolder folder;
  write_image(folder.path() / "a.png", ramp(CV_16UC1, 65535));
  EXPECT_EQ(read_grey(folder.path() / "a.png", 12).pixels.at<std::uint8_t>(kHeight - 1, kWidth - 1), 255);
}

// A dark first frame must not set the scale of the brighter ones behind it.
TEST(Image, OneScaleForTheWholeSequence) {
  const TemporaryFolder folder;
  write_kitti(folder.path());
  for (int i = 0; i < kFrames; ++i)
    for (const char* eye : {"image_0", "image_1"})
      write_image(folder.path() / eye / frame_name(i), ramp(CV_16UC1, i == 0 ? 1000 : 4000));
  const std::unique_ptr<Dataset> dataset = open_dataset(folder.path());
  EXPECT_NEAR(dataset->load(0).left.at<std::uint8_t>(kHeight - 1, kWidth - 1), 1000 / 16, 1);
  EXPECT_NEAR(dataset->load(5).left.at<std::uint8_t>(kHeight - 1, kWidth - 1), 4000 / 16, 1);
  DatasetOptions options;
  options.bit_depth = 16;
  EXPECT_NEAR(open_dataset(folder.path(), options)->load(5).left.at<std::uint8_t>(kHeight - 1, kWidth - 1),
              4000 / 256, 1);
}

}  // namespace
}  // namespace spslam
