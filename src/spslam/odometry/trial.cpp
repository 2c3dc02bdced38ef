// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/odometry/trial.h"

#include <cmath>

#include "spslam/odometry/follow.h"

namespace spslam {
namespace {

constexpr double kTrust = 5;  // verdicts, all of them good, that a cell begins with

bool agrees(const ActiveMap& map, const Landmark& landmark, const WindowFrame& frame,
            const Sighting& sighting, double max_residual) {
  const Linearized at = linearize(map, landmark, frame.camera_from_world, sighting);
  const Eigen::Vector3d sigmas = at.residual.cwiseProduct(sighting.inverse_sigma);
  return at.in_front && sigmas.head<2>().norm() <= max_residual && std::abs(sigmas.z()) <= max_residual;
}

}  // namespace

std::size_t Trials::cell_at(const StereoRig& rig, const Eigen::Vector2f& pixel) {
  const auto part = [](float at, int size, int parts) {
    return std::clamp(static_cast<int>(at * static_cast<float>(parts) / static_cast<float>(size)), 0,
                      parts - 1);
  };
  return static_cast<std::size_t>(part(pixel.y(), rig.height, kRows) * kColumns +
                                  part(pixel.x(), rig.width, kColumns));
}

bool Trials::needed_at(const StereoRig& rig, const Eigen::Vector2f& pixel) const {
  const Cell& cell = cells_[cell_at(rig, pixel)];
  return options_.enabled && cell.proven + kTrust < options_.min_share * (cell.all + kTrust);
}

void Trials::conclude(const StereoRig& rig, Verdict verdict, int max_missed, ActiveLandmark& active) {
  active.verdict = verdict;
  const double kept = 1 - 1.0 / options_.memory;
  Cell& cell = cells_[cell_at(rig, active.landmark.pixel)];
  cell.proven = kept * cell.proven + (verdict == Verdict::kProven);
  cell.all = kept * cell.all + 1;
  if (verdict == Verdict::kRefuted && active.on_trial) active.missed = max_missed + 1;
  if (verdict == Verdict::kProven) active.on_trial = false;
}

void Trials::refute(const StereoRig& rig, int max_missed, ActiveLandmark& active) {
  active.on_trial = true;
  conclude(rig, Verdict::kRefuted, max_missed, active);
}

void Trials::judge(ActiveMap& map, int max_missed) {
  if (!options_.enabled || map.window.empty()) return;
  const WindowFrame& newest = map.window.back();
  for (const Sighting& sighting : newest.sightings) {
    const int i = map.index_of(sighting.landmark);
    if (i < 0) continue;
    ActiveLandmark& active = map.landmarks[i];
    if (active.verdict != Verdict::kOpen || active.landmark.host == newest.keyframe) continue;
    const bool right = agrees(map, active.landmark, newest, sighting, options_.max_residual);
    if (++(right ? active.agreed : active.disagreed) == options_.sightings)
      conclude(map.rig, right ? Verdict::kProven : Verdict::kRefuted, max_missed, active);
  }
  for (ActiveLandmark& active : map.landmarks)
    if (active.verdict == Verdict::kOpen && active.missed > max_missed &&
        predict(map, active.landmark, newest.camera_from_world))
      conclude(map.rig, Verdict::kRefuted, max_missed, active);
  // At the start nothing is known of a place: its landmarks go on trial as soon as the first have failed.
  for (ActiveLandmark& active : map.landmarks)
    if (active.verdict == Verdict::kOpen) active.on_trial = needed_at(map.rig, active.landmark.pixel);
}

}  // namespace spslam
