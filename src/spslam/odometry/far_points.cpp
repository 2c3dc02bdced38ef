// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/odometry/far_points.h"

#include <numeric>

#include "spslam/base/random.h"
#include "spslam/odometry/follow.h"

namespace spslam {
namespace {

// Unit bearings of a far point: where it should be and where it was seen.
struct Bearings {
  std::size_t sighting;
  Eigen::Vector3d predicted, seen;
};

std::vector<Bearings> far_bearings(const ActiveMap& map, const SE3& predicted,
                                   const std::vector<Sighting>& sightings) {
  std::vector<Bearings> all;
  for (std::size_t s = 0; s < sightings.size(); ++s) {
    const int i = map.index_of(sightings[s].landmark);
    if (i < 0 || map.landmarks[i].landmark.region == Region::kNear) continue;
    const Landmark& landmark = map.landmarks[i].landmark;
    const SE3 motion = predicted * map.hosts.at(landmark.host).camera_from_world.inverse();
    const Eigen::Vector3d x =
        motion.rotation * landmark.bearing + landmark.inverse_depth * motion.translation;
    const Eigen::Vector3d seen = map.rig.bearing(sightings[s].measured.x(), sightings[s].measured.y());
    all.push_back({s, x.normalized(), seen.normalized()});
  }
  return all;
}

// The rotation that takes a.predicted and b.predicted nearest to where they were seen.
Eigen::Matrix3d rotation_of(const Bearings& a, const Bearings& b) {
  return rotation_between(a.seen * a.predicted.transpose() + b.seen * b.predicted.transpose());
}

std::vector<char> largest_consensus(const std::vector<Bearings>& all, double threshold, int rounds,
                                    Random random) {
  std::vector<char> best(all.size(), 0);
  int best_count = 0;
  const auto count = static_cast<std::uint32_t>(all.size());
  for (int round = 0; round < rounds; ++round) {
    const std::uint32_t a = random.below(count), b = random.below(count);
    if (a == b || all[a].seen.cross(all[b].seen).norm() < 0.02) continue;
    const Eigen::Matrix3d rotation = rotation_of(all[a], all[b]);
    std::vector<char> inlier(all.size());
    for (std::size_t i = 0; i < all.size(); ++i)
      inlier[i] = (rotation * all[i].predicted - all[i].seen).norm() < threshold;
    const int inliers = std::accumulate(inlier.begin(), inlier.end(), 0);
    if (inliers > best_count) best_count = inliers, best = inlier;
  }
  return best;
}

}  // namespace

void FarPoints::weigh(const ActiveMap& map, const SE3& predicted, FrameId frame, const FarOptions& options,
                      std::vector<Sighting>& sightings) {
  const std::vector<Bearings> far = far_bearings(map, predicted, sightings);
  if (!options.enabled || far.size() < 3) return;
  const std::vector<char> inlier =
      largest_consensus(far, options.ransac_threshold / map.rig.fx, options.ransac_rounds,
                        Random(static_cast<std::uint64_t>(frame.value)));
  const double share = std::accumulate(inlier.begin(), inlier.end(), 0.0) / static_cast<double>(far.size());
  inlier_share_.push_back(share);
  if (static_cast<int>(inlier_share_.size()) > options.memory) inlier_share_.pop_front();
  weight_ = std::max(options.min_weight, std::accumulate(inlier_share_.begin(), inlier_share_.end(), 0.0) /
                                             static_cast<double>(inlier_share_.size()));
  if (share <= 0) return;  // no consensus at all: the weight says so, and the robust loss has to do
  std::vector<char> refused(sightings.size(), 0);
  for (std::size_t i = 0; i < far.size(); ++i) {
    sightings[far[i].sighting].weight = weight_;
    refused[far[i].sighting] = !inlier[i];
  }
  std::size_t s = 0;
  std::erase_if(sightings, [&](const Sighting&) { return refused[s++] != 0; });
}

}  // namespace spslam
