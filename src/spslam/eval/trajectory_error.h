// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The errors of a trajectory as the paper reports them (4.3): absolute (ATE), relative (RPE) and KITTI's.
#pragma once

#include <span>
#include <vector>

#include "spslam/eval/association.h"
#include "spslam/eval/statistics.h"

namespace spslam {

// Distance in m of each estimated position from the true one. The poses must be in one world (aligned)
// already.
struct AteResult {
  Statistics position;         // m
  std::vector<double> errors;  // m, one a pair
};
AteResult absolute_trajectory_error(std::span<const AssociatedPose> poses);

// What the estimated motion between two poses gets wrong: E = (estimate_i^-1 estimate_j)^-1 (truth_i^-1
// truth_j). No alignment changes it but a scale. (Sturm et al., "A benchmark for the evaluation of RGB-D SLAM
// systems", IROS 2012.)
struct RpeResult {
  Statistics translation;          // m/s, or m per frame
  Statistics rotation;             // deg/s, or deg per frame
  std::vector<double> timestamps;  // s, of the first pose of each motion
  std::vector<double> translation_errors;
  std::vector<double> rotation_errors;
};
// From each pose to the one nearest to interval seconds later (motions more than a quarter longer or shorter,
// as over gaps, are left out); errors are divided by the true time between them, so the unit is per second
// whatever the interval.
RpeResult relative_pose_error_per_second(std::span<const AssociatedPose> poses, double interval = 1);
// From each pair to the step-th next; the errors of the whole step.
RpeResult relative_pose_error_per_frame(std::span<const AssociatedPose> poses, int step = 1);

// One length of the KITTI odometry metric.
struct KittiLength {
  double length = 0;  // m
  std::size_t count = 0;
  double translation = 0;  // %
  double rotation = 0;     // deg / 100 m
};
// KITTI's t_rel and r_rel (Geiger et al., CVPR 2012, with the development kit's sampling): motions that start
// at every tenth pose and end at the first pose more than 100, 200 ... 800 m further along the true path,
// without any alignment; mean over all of them. count is 0 (and the figures NaN) if the path is too short for
// one.
struct KittiResult {
  std::size_t count = 0;
  double t_rel = 0;                  // %
  double r_rel = 0;                  // deg / 100 m
  std::vector<KittiLength> lengths;  // those with at least one motion
};
KittiResult kitti_error(std::span<const AssociatedPose> poses);

}  // namespace spslam
