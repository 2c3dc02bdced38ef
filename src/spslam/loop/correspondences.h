// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Matches between a place and a keyframe, with what is known of their errors.
#pragma once

#include "spslam/loop/verification.h"

namespace spslam {

class Correspondences {
 public:
  // All three must outlive it.
  Correspondences(const Place& older, const KeyframeFeatures& newer, const StereoRig& rig,
                  const VerificationOptions& options);

  // Ratio of the scales (Verification::scale) by which the newer side's depths are multiplied from now on.
  void set_scale(double scale) { scale_ = scale; }
  void use_disparities(bool wanted) { use_disparities_ = wanted; }

  // By descriptor, from all sources of the place: a feature's best match.
  std::vector<Correspondence> by_descriptor(const Vocabulary& vocabulary) const;
  // Within a radius (px) of where the motion puts a point: mutually best, each feature and each point once.
  std::vector<Correspondence> guided(const SE3& newer_from_older, double radius) const;
  // Points whose depth is known that the motion puts into the image, each place of it (a few px) once.
  int visible(const SE3& newer_from_older) const;

 private:
  struct Seen {
    int point;
    Eigen::Vector2d at;
    double radius;
  };
  Correspondence pair(int point, int feature) const;
  std::optional<Seen> predict(const SE3& newer_from_older, int point, double radius) const;
  struct Choice {
    int other = -1, distance = 257, second = 257;
  };
  Choice best_feature(const Seen& seen, const Descriptor& descriptor) const;

  const Place& older_;
  const KeyframeFeatures& newer_;
  const StereoRig& rig_;
  const VerificationOptions& options_;
  std::vector<int> by_x_;  // features that are finite
  double scale_ = 1;
  bool use_disparities_ = true;
};

}  // namespace spslam
