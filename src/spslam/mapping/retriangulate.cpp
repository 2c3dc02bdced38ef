// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/mapping/retriangulate.h"

namespace spslam {
namespace {

constexpr int kSteps = 5;
constexpr double kLossScale = 3;  // sigma

// Sums of the normal equation of the inverse depth over all views but the host's.
struct DepthSums {
  double information = 0, gradient = 0;
  int views = 0;
};

DepthSums sum_views(const Map& map, const StereoRig& rig, const Landmark& landmark, double inverse_depth) {
  DepthSums sums;
  const SE3 world_from_host = map.find(landmark.host)->camera_from_world.inverse();
  for (const KeyframeId id : map.observers(landmark.id)) {
    if (id == landmark.host) continue;
    const Keyframe& keyframe = *map.find(id);
    const Sighting& sighting = *find_sighting(keyframe, landmark.id);
    const Linearized at = linearize(rig, keyframe.camera_from_world * world_from_host, landmark.bearing,
                                    inverse_depth, sighting.measured);
    if (!at.in_front || sighting.inverse_sigma.x() <= 0) continue;
    const Eigen::Vector2d r = at.residual.head<2>() * sighting.inverse_sigma.x();
    const Eigen::Vector2d j = at.by_inverse_depth.head<2>() * sighting.inverse_sigma.x();
    const double weight = robust(Loss::kPseudoHuber, kLossScale, r.squaredNorm()).weight;
    sums.information += weight * j.squaredNorm();
    sums.gradient += weight * j.dot(r);
    ++sums.views;
  }
  return sums;
}

// The angle under which the stereo baseline is seen from a point, rad.
double stereo_parallax(const StereoRig& rig, double inverse_depth) {
  return rig.baseline * std::max(0.0, inverse_depth);
}

enum class Depth { kGood, kImprovable, kAnomalous };

Depth judge(const Map& map, const StereoRig& rig, const Landmark& landmark, const Keyframe& keyframe,
            const Sighting& sighting, double anomalous_sigmas) {
  const SE3 motion = keyframe.camera_from_world * map.find(landmark.host)->camera_from_world.inverse();
  const Eigen::Vector3d from_host = motion.rotation * landmark.bearing;
  const Eigen::Vector3d from_here = rig.bearing(sighting.measured.x(), sighting.measured.y());
  const double angle = std::atan2(from_host.cross(from_here).norm(), from_host.dot(from_here));
  const Linearized at = linearize(rig, motion, landmark.bearing, landmark.inverse_depth, sighting.measured);
  if (!at.in_front || std::abs(at.residual.z()) * sighting.inverse_sigma.z() > anomalous_sigmas)
    return Depth::kAnomalous;
  const double here = landmark.inverse_depth / (from_host + landmark.inverse_depth * motion.translation).z();
  const double stereo = std::max(stereo_parallax(rig, landmark.inverse_depth), stereo_parallax(rig, here));
  return angle > stereo ? Depth::kImprovable : Depth::kGood;
}

}  // namespace

std::optional<Triangulated> triangulate_by_observers(const Map& map, const StereoRig& rig,
                                                     const Landmark& landmark) {
  Triangulated out{landmark.inverse_depth, 0};
  for (int step = 0; step < kSteps; ++step) {
    const DepthSums sums = sum_views(map, rig, landmark, out.inverse_depth);
    if (sums.views == 0 || !(sums.information > 1e-9)) return std::nullopt;
    out.inverse_depth -= sums.gradient / sums.information;
    out.information = sums.information;
    if (!std::isfinite(out.inverse_depth)) return std::nullopt;
  }
  return out;
}

int retriangulate(Map& map, const StereoRig& rig, KeyframeId id, const RetriangulationOptions& options) {
  const Keyframe* keyframe = map.find(id);
  if (!options.enabled || !keyframe) return 0;
  int changed = 0;
  for (const Sighting& sighting : keyframe->sightings) {
    const Landmark& landmark = *map.find(sighting.landmark);
    if (landmark.host == id || !map.find(landmark.host)) continue;
    const Depth depth = judge(map, rig, landmark, *keyframe, sighting, options.anomalous_sigmas);
    if (depth == Depth::kGood) continue;
    const auto found = triangulate_by_observers(map, rig, landmark);
    if (!found) continue;
    // Keyframes alone seldom know better than all the frames that the tracker saw it in.
    if (depth == Depth::kImprovable && found->information <= landmark.information) continue;
    map.set_estimate(landmark.id, found->inverse_depth, found->information);
    ++changed;
  }
  return changed;
}

}  // namespace spslam
