// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Where in a known map the camera is: a Kalman filter over its pose, moved on by odometry and measured by
// places recognized (relocalizer.h).
#pragma once

#include <optional>

#include "spslam/base/options.h"
#include "spslam/base/uncertain_pose.h"
#include "spslam/map/map.h"

namespace spslam {

struct LocalizationOptions {
  bool enabled = false;
  int interval = 5;
  int nearest = 2;
  int confirmations = 2;
  double start_sigma = 0;
  double drift = 0.01;
  double turn_drift = 0.02;
  double correlation = 10;
  double map_sigma = 0.05;
  double map_turn_sigma = 0.2;
  double gate = kPoseGate;
  double max_uncertainty = 1;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.enabled, {"enabled", "", "stay in the map that is given and leave it as it is (--localize)"});
    visit(self.interval, {"interval", "frames", "between two attempts to recognize a place", 1, 10000});
    visit(self.nearest,
          {"nearest", "", "keyframes tried because they are near where the camera should be", 0, 100});
    visit(self.confirmations,
          {"confirmations", "", "attempts that must agree by odometry before the camera counts as found", 1,
           100});
    visit(self.start_sigma,
          {"start_sigma", "m",
           "of a place that is not precise up to which it helps to find the camera, two counting as one", 0,
           100});
    visit(self.drift, {"drift", "m/m", "error of odometry over its way", 1e-4, 10});
    visit(self.turn_drift, {"turn_drift", "deg/m", "of its rotation", 1e-4, 90});
    visit(self.correlation, {"correlation", "m", "way over which it errs alike", 0.01, 1000});
    visit(self.map_sigma,
          {"map_sigma", "m", "error of the map's own that no number of looks averages out", 0, 10});
    visit(self.map_turn_sigma, {"map_turn_sigma", "deg", "the same of its rotation", 0, 90});
    visit(self.gate,
          {"gate", "", "squared Mahalanobis distance of an attempt at most (6 degrees of freedom)", 1, 1000});
    visit(self.max_uncertainty,
          {"max_uncertainty", "m", "standard deviation of the position above which the camera counts as lost",
           0.01, 1000});
  }
};

enum class FilterAnswer {
  kPending,   // nothing is known yet, or it contradicts what is: it waits for others that agree
  kUsed,      // it agrees and has corrected the estimate
  kRestarted  // enough attempts agree with each other: the estimate is theirs
};

class LocalizationFilter {
 public:
  explicit LocalizationFilter(const LocalizationOptions& options) : options_(options) {}

  // The camera has moved, as odometry says.
  void move(const SE3& present_from_before);
  // A place was recognized; its pose is the camera's of now. One that is not `precise`, as where all is far,
  // corrects what is known, but does not contradict it; whether it helps to begin: start_sigma.
  FilterAnswer add(const UncertainPose& measured, bool precise = true);
  // Odometry was broken off: nothing is known any more.
  void forget() { estimate_.reset(), pending_.reset(), agreeing_ = 0; }

  // What is known, the map's own error included; nothing until found, or once it is too uncertain.
  std::optional<UncertainPose> estimate() const;

 private:
  bool agree(const UncertainPose& a, const UncertainPose& b) const;
  Matrix6d map_covariance() const;

  LocalizationOptions options_;
  std::optional<UncertainPose> estimate_;
  std::optional<UncertainPose> pending_;  // the last attempts that did not agree, but with each other
  int agreeing_ = 0;                      // attempts in a row that agree on it, precise ones counting twice
};

// Covariance of odometry's error over a motion, of a left perturbation of it.
Matrix6d drift_covariance(const SE3& motion, const LocalizationOptions& options);

// Where in the map a place that was recognized puts a frame.
struct SeenPlace {
  std::size_t frame = 0;
  UncertainPose pose;
};
// Frames that odometry saw without a break, and the places recognized in some of them.
struct PlacedRun {
  std::vector<SE3> camera_from_session;
  std::vector<SeenPlace> places;  // in order of their frames
};

// Where in the map each of the frames was, by all that is known in the end: the filter over the frames
// before, and over those behind, backwards, both weighed by their covariances (Fraser and Potter's two-filter
// smoother, 1969). Empty if there is no place.
std::vector<SE3> smooth(const PlacedRun& run, const LocalizationOptions& options);

// Keyframes that look from about there in about that direction, nearest first, at most so many.
std::vector<KeyframeId> nearest_keyframes(const Map& map, const SE3& camera_from_world, int count);

}  // namespace spslam
