// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// What a user of the installed library writes: a rig, a motion, and a system that is told of a frame it
// cannot use.

#include <spslam/spslam.h>

#include <cstdio>

int main() {
  spslam::StereoRig rig;
  rig.fx = rig.fy = 360;
  rig.cx = 320;
  rig.cy = 180;
  rig.baseline = 0.08;
  rig.width = 640;
  rig.height = 360;
  rig.check();

  spslam::Vector6d twist;
  twist << 0.1, 0, 0.5, 0, 0.02, 0;
  const spslam::SE3 there = spslam::SE3::exp(twist);
  const double error = (there * there.inverse()).log().norm();
  std::printf("depth at 2.88 px: %.3f m, error of a motion and its inverse: %g\n", rig.depth(2.88), error);
  spslam::Slam slam(rig);
  const spslam::TrackResult result = slam.track(0.0, cv::Mat(), cv::Mat());
  slam.finish();
  if (result.status != spslam::TrackStatus::kInitializing || result.reason.empty()) return 1;
  return rig.depth(2.88) > 9.999 && rig.depth(2.88) < 10.001 && error < 1e-12 ? 0 : 1;
}
