// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// When a frame becomes a keyframe (paper 3.2.1): three named conditions, any of which suffices, and a floor.
#pragma once

#include <deque>
#include <string>

#include "spslam/odometry/options.h"

namespace spslam {

// Equation (10): the differential entropy of a normal distribution, in nats, from a Cholesky factor of its
// covariance. NaN if the covariance is not positive definite.
double differential_entropy(const Matrix6d& covariance);

// What the policy looks at.
struct KeyframeEvidence {
  int frames_since_keyframe = 0;
  int tracked = 0;               // points found in this frame
  int tracked_before = 0;        // in the previous one
  double share_of_keyframe = 1;  // of the last keyframe's points that are still found
  double rotation = 0;           // deg, since the last keyframe
  double parallax = 0;           // px, median motion of the points since they were first seen
  double entropy = 0;            // nats
  bool mapper_is_busy = false;   // then the conditions (i) on time and motion have to wait
};

struct KeyframeDecision {
  bool too_many_frames = false;       // (i)
  bool moved_enough = false;          // (i)
  bool keyframe_points_lost = false;  // (i)
  bool previous_points_lost = false;  // (ii)
  bool entropy_changed = false;       // (iii)
  bool too_few_points = false;        // the floor

  bool insert() const {
    return too_many_frames || moved_enough || keyframe_points_lost || previous_points_lost ||
           entropy_changed || too_few_points;
  }
  std::string reason() const;  // the names of those that hold, joined by '+'; "" if none does
};

class KeyframePolicy {
 public:
  KeyframeDecision decide(const KeyframeEvidence& evidence, const KeyframeOptions& options);

 private:
  bool entropy_changed(double entropy, const KeyframeOptions& options);
  std::deque<double> entropies_;  // nats, of the frames since the last keyframe
};

}  // namespace spslam
