// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Which pose of the estimate belongs to which pose of the ground truth.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "spslam/io/trajectory.h"

namespace spslam {

struct AssociationOptions {
  bool by_index = false;    // for files without times: the n-th pose belongs to the n-th
  double tolerance = 0.02;  // s between the two times of a pair, at most (TUM's benchmark tool has the same)
  double offset = 0;        // s, added to the times of the ground truth
  bool interpolate =
      false;  // the truth at the estimate's times instead of the nearest; for truth slower than the camera
  double longest_gap = 1;  // s between two truth poses that are interpolated, at most
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.by_index, {"by_index", "", "n-th pose to n-th pose instead of by time"});
    visit(self.tolerance, {"tolerance", "s", "largest difference of the times of a pair", 0, 1e9});
    visit(self.offset, {"offset", "s", "added to the times of the ground truth", -1e12, 1e12});
    visit(self.interpolate, {"interpolate", "", "interpolate the ground truth at the times of the estimate"});
    visit(self.longest_gap,
          {"longest_gap", "s", "longest gap of the ground truth that is interpolated", 0, 1e9});
  }
};

// Both poses are world_from_camera, each in its own world, until the estimate is aligned.
struct AssociatedPose {
  double timestamp = 0;  // s, of the estimate
  SE3 estimate;
  SE3 truth;
};

// One-to-one and in the order of the estimate: each pose with the nearest in time, and of several that share
// a truth pose only the nearest stays. Throws InputError if a trajectory is empty, has a pose that is not
// finite, goes back in time, or (by index) if the numbers of poses differ. May return fewer pairs than either
// has poses, even none.
std::vector<AssociatedPose> associate(const Trajectory& estimate, const Trajectory& truth,
                                      const AssociationOptions& options);

// The length in m of the way through the poses, straight from one to the next.
double path_length(const Trajectory& trajectory);
double estimate_path_length(std::span<const AssociatedPose> poses);
double truth_path_length(std::span<const AssociatedPose> poses);

}  // namespace spslam
