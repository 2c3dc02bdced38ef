// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "spslam/segmentation/dilation.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "segmentation/test_scenes.h"

namespace spslam {
namespace {

constexpr StructuringElement kElements[] = {StructuringElement::kDisc25, StructuringElement::kDisc15,
                                            StructuringElement::kRect25x15};

cv::Mat full_size(const cv::Mat& field, cv::Size size) {
  cv::Mat mask(size, CV_8UC1);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) mask.at<std::uint8_t>(y, x) = is_inside(field, size, x, y) ? 255 : 0;
  }
  return mask;
}

// Two blobs and a single pixel in a corner.
cv::Mat blobs(cv::Size size) {
  cv::Mat image(size, CV_8UC1, cv::Scalar(0));
  cv::circle(image, {size.width / 3, size.height / 2}, size.height / 10, cv::Scalar(255), cv::FILLED);
  cv::rectangle(image, {size.width * 3 / 4, size.height / 5, size.width / 20, size.height / 3},
                cv::Scalar(255), cv::FILLED);
  image.at<std::uint8_t>(0, 0) = 255;
  return image;
}

TEST(StructuringElement, HasThePapersSizes) {
  const cv::Mat disc25 = structuring_element(StructuringElement::kDisc25, 640);
  ASSERT_EQ(disc25.size(), cv::Size(51, 51));
  const cv::Mat disc15 = structuring_element(StructuringElement::kDisc15, 640);
  ASSERT_EQ(disc15.size(), cv::Size(31, 31));
  for (int y = -25; y <= 25; ++y) {
    for (int x = -25; x <= 25; ++x)
      EXPECT_EQ(disc25.at<std::uint8_t>(y + 25, x + 25), x * x + y * y <= 625 ? 1 : 0);
  }
  const cv::Mat rectangle = structuring_element(StructuringElement::kRect25x15, 640);
  ASSERT_EQ(rectangle.size(), cv::Size(25, 15));
  EXPECT_EQ(cv::countNonZero(rectangle), 25 * 15);
}

TEST(StructuringElement, GrowsWithTheWidth) {
  EXPECT_EQ(structuring_element(StructuringElement::kDisc25, 1280).size(), cv::Size(101, 101));
  EXPECT_EQ(structuring_element(StructuringElement::kDisc25, 320).size(), cv::Size(25, 25));
  EXPECT_EQ(structuring_element(StructuringElement::kRect25x15, 1280).size(), cv::Size(49, 29));
  EXPECT_EQ(structuring_element(StructuringElement::kRect25x15, 16).size(), cv::Size(1, 1));
}

TEST(DilateRegion, IsExactAtFullSize) {
  for (const cv::Size size : {cv::Size(640, 360), cv::Size(400, 300)}) {
    const cv::Mat region = blobs(size);
    for (const StructuringElement element : kElements) {
      cv::Mat reference;
      cv::dilate(region, reference, structuring_element(element, size.width));
      const cv::Mat dilated = full_size(dilate_region(region, element, size.width), size);
      EXPECT_EQ(cv::countNonZero(dilated != reference), 0)
          << option_names(element)[static_cast<int>(element)];
    }
  }
}

// Found in a quarter of the size, the outline is off by a pixel or two.
TEST(DilateRegion, IsCloseFromASmallImage) {
  const cv::Size size(640, 360);
  cv::Mat small = blobs({160, 90}), region;
  cv::resize(small, region, size, 0, 0, cv::INTER_NEAREST);
  for (const StructuringElement element : kElements) {
    cv::Mat reference, inner, outer;
    cv::dilate(region, reference, structuring_element(element, size.width));
    const cv::Mat two = cv::Mat::ones(7, 7, CV_8UC1);
    cv::erode(reference, inner, two);
    cv::dilate(reference, outer, two);
    const cv::Mat dilated = full_size(dilate_region(small, element, size.width), size);
    EXPECT_EQ(cv::countNonZero(inner & ~dilated), 0) << option_names(element)[static_cast<int>(element)];
    EXPECT_EQ(cv::countNonZero(dilated & ~outer), 0) << option_names(element)[static_cast<int>(element)];
    EXPECT_GT(test::overlap(dilated, reference), 0.9);
  }
}

TEST(DilateRegion, IsEmptyIfTheRegionIs) {
  const cv::Mat nothing(90, 160, CV_8UC1, cv::Scalar(0));
  EXPECT_TRUE(dilate_region(nothing, StructuringElement::kDisc25, 640).empty());
  EXPECT_FALSE(is_inside(cv::Mat(), {640, 360}, 3, 3));
}

}  // namespace
}  // namespace spslam
