// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/camera/stereo_rig.h"

#include <gtest/gtest.h>

#include <cmath>

#include "spslam/base/error.h"

namespace spslam {
namespace {

const StereoRig kGood{
    .fx = 360, .fy = 361, .cx = 319.5, .cy = 159.5, .baseline = 0.08, .width = 640, .height = 320};

TEST(StereoRig, ProjectsWhatItSees) {
  const Eigen::Vector3d point = 7.0 * kGood.bearing(100, 50);
  EXPECT_LT((kGood.project(point) - Eigen::Vector2d(100, 50)).norm(), 1e-12);
  const double right_u = kGood.project(point - Eigen::Vector3d(kGood.baseline, 0, 0)).x();
  EXPECT_NEAR(kGood.depth(100 - right_u), 7, 1e-9);
}

TEST(StereoRig, RefusesWhatCannotBe) {
  EXPECT_NO_THROW(kGood.check());
  const auto broken = [](auto change) {
    StereoRig rig = kGood;
    change(rig);
    return rig;
  };
  EXPECT_THROW(broken([](StereoRig& rig) { rig.fx = 0; }).check(), InputError);
  EXPECT_THROW(broken([](StereoRig& rig) { rig.fy = std::nan(""); }).check(), InputError);
  EXPECT_THROW(broken([](StereoRig& rig) { rig.baseline = -0.08; }).check(), InputError);
  EXPECT_THROW(broken([](StereoRig& rig) { rig.cx = 640; }).check(), InputError);
  EXPECT_THROW(broken([](StereoRig& rig) { rig.height = 1; }).check(), InputError);
}

}  // namespace
}  // namespace spslam
