// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/stereo/coarse.h"

#include <gtest/gtest.h>

#include "stereo/synthetic_pair.h"

namespace spslam {
namespace {

constexpr std::array<double, 3> kPixelSizes = {1.0, 1.2, 1.44};

void add(Features& features, float x, float y, const Descriptor& descriptor, int octave = 0) {
  features.keypoints.push_back({x, y, 0, 1, static_cast<std::uint8_t>(octave)});
  features.descriptors.push_back(descriptor);
}

// The descriptor with its first `bits` bits turned.
Descriptor turned(Descriptor d, int bits) {
  for (int i = 0; i < bits; ++i) d[i / 64] ^= 1ULL << (i % 64);
  return d;
}

class Coarse : public testing::Test {
 protected:
  CoarseMatch only_match() { return match_rows(left, right, kPixelSizes, 640, 480, options).at(0); }

  Random random{5};
  Descriptor descriptor = test::random_descriptor(random);
  Features left, right;
  StereoOptions options;
};

TEST_F(Coarse, TakesTheNearestDescriptorInTheBand) {
  add(left, 300, 200, descriptor);
  add(right, 290, 200, turned(descriptor, 60));
  add(right, 280, 201, turned(descriptor, 5));
  add(right, 270, 204, descriptor);                    // another row
  add(right, 303, 200, descriptor);                    // disparity -3
  add(right, 300 - 0.15F * 640 - 1, 200, descriptor);  // too near
  add(right, 290, 200, descriptor, 2);                 // two levels off
  const CoarseMatch match = only_match();
  EXPECT_EQ(match.status, StereoStatus::kOk);
  EXPECT_EQ(match.right, 1);
  EXPECT_EQ(match.distance, 5);
}

TEST_F(Coarse, BandGrowsWithTheLevel) {
  add(left, 300, 200, descriptor, 2);
  add(right, 290, 202.6F, descriptor, 2);
  EXPECT_EQ(only_match().status, StereoStatus::kOk);
  left.keypoints[0].octave = right.keypoints[0].octave = 0;
  EXPECT_EQ(only_match().status, StereoStatus::kNone);
}

TEST_F(Coarse, SmallNegativeDisparitiesAreKept) {
  add(left, 300, 200, descriptor);
  add(right, 301.5F, 200, descriptor);
  EXPECT_EQ(only_match().status, StereoStatus::kOk);
}

TEST_F(Coarse, RepeatedTextureIsAmbiguousTheSameCornerIsNot) {
  add(left, 300, 200, descriptor);
  add(right, 290, 200, turned(descriptor, 30));
  add(right, 291, 200, turned(descriptor, 31), 1);  // the same corner on the next level
  EXPECT_EQ(only_match().status, StereoStatus::kOk);
  add(right, 270, 200, turned(descriptor, 31));
  EXPECT_EQ(only_match().status, StereoStatus::kAmbiguous);
}

TEST_F(Coarse, UnlikeDescriptorsAreNoMatch) {
  add(left, 300, 200, descriptor);
  add(right, 290, 200, turned(descriptor, options.max_distance + 1));
  EXPECT_EQ(only_match().status, StereoStatus::kNone);
  EXPECT_EQ(only_match().right, -1);
}

TEST_F(Coarse, ARightPointBelongsToTheLeftPointItIsNearestTo) {
  add(left, 300, 200, turned(descriptor, 9));
  add(left, 320, 200, descriptor);
  add(left, 321, 200, turned(descriptor, 1));  // the same corner as the one before
  add(right, 290, 200, descriptor);
  const auto matches = match_rows(left, right, kPixelSizes, 640, 480, options);
  EXPECT_EQ(matches[0].status, StereoStatus::kLeftRight);
  EXPECT_EQ(matches[1].status, StereoStatus::kOk);
  EXPECT_EQ(matches[2].status, StereoStatus::kOk);
  options.left_right_check = false;
  EXPECT_EQ(only_match().status, StereoStatus::kOk);
}

TEST_F(Coarse, PointsOutsideTheImageOrOnUnknownLevelsAreHarmless) {
  add(left, 300, -7, descriptor);
  add(left, 300, 900, descriptor);
  add(left, 300, 200, descriptor, 9);
  add(right, 290, 1e6F, descriptor);
  add(right, 290, -1e6F, descriptor);
  for (const CoarseMatch& match : match_rows(left, right, kPixelSizes, 640, 480, options))
    EXPECT_EQ(match.status, StereoStatus::kNone);
}

}  // namespace
}  // namespace spslam
