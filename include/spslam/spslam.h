// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// What a user of the library includes: the system, its options, and what goes in and comes out.
//
// clang-format off
//   spslam::Slam slam(rig);  // focal length, principal point, baseline, image size
//   const spslam::TrackResult result = slam.track(t, left, right);
//   if (result.status == spslam::TrackStatus::kTracking) use(result.world_from_camera, result.covariance);
//   slam.finish();
//   for (const spslam::TrajectoryPose& pose : slam.trajectory()) save(pose);
// clang-format on
#pragma once

#include "spslam/base/error.h"
#include "spslam/camera/rectifier.h"
#include "spslam/camera/stereo_rig.h"
#include "spslam/system/slam.h"
