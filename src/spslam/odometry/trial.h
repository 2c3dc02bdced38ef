// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Where landmarks must prove themselves before they count. Ripples, glints and mirror images look like
// corners, but next to none of them is where a standing point would be a few frames later. So each cell of
// the image keeps the share of its new landmarks that proved right, as equation (8) does for the far region,
// and where that share is low, new landmarks are on trial: they are followed, but say nothing of the motion
// until they have agreed with it often enough, and never come into the map if they do not. SPEC, last
// section: "image regions whose tracks keep dying or disagreeing lose weight".
#pragma once

#include <array>

#include "spslam/odometry/active_map.h"

namespace spslam {

struct TrialOptions {
  bool enabled = true;
  int sightings = 3;
  double max_residual = 5;
  double min_share = 0.5;
  int memory = 50;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.enabled,
          {"enabled", "", "new landmarks from places where few prove right count only once they have"});
    visit(self.sightings,
          {"sightings", "", "agreeing with the motion prove a landmark; as many others refute it", 1, 100});
    visit(self.max_residual, {"max_residual", "sigma", "up to which a sighting agrees", 0.1, 100});
    visit(self.min_share,
          {"min_share", "", "of a place's landmarks proved right below which new ones are on trial", 0, 1});
    visit(self.memory,
          {"memory", "", "verdicts over which the share of a cell of the image is averaged", 1, 100000});
  }
};

class Trials {
 public:
  explicit Trials(const TrialOptions& options) : options_(options) {}

  // Whether landmarks that were made there, and are neither proven nor refuted yet, are on trial.
  bool needed_at(const StereoRig& rig, const Eigen::Vector2f& pixel) const;
  // Judges the landmarks that are neither proven nor refuted yet by what the newest frame of the window saw
  // of them. Refuted are, too, those in sight that have been missed more than `max_missed` times. Those
  // refuted while on trial are missed more often than that afterwards, so that they are let go. The others
  // that are still open go on trial, or cease to be, as their place deserves.
  void judge(ActiveMap& map, int max_missed);
  // What else has been found out about a landmark: it is on trial and refuted, so let go.
  void refute(const StereoRig& rig, int max_missed, ActiveLandmark& active);

 private:
  static constexpr int kColumns = 8, kRows = 6;
  struct Cell {
    double proven = 0, all = 0;  // verdicts, older ones counting less
  };
  static std::size_t cell_at(const StereoRig& rig, const Eigen::Vector2f& pixel);
  void conclude(const StereoRig& rig, Verdict verdict, int max_missed, ActiveLandmark& active);

  TrialOptions options_;
  std::array<Cell, std::size_t{kColumns} * kRows> cells_{};
};

}  // namespace spslam
