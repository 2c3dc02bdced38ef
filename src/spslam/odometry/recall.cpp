// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/odometry/recall.h"

#include <Eigen/LU>
#include <set>

#include "spslam/odometry/follow.h"
#include "spslam/odometry/occupancy.h"

namespace spslam {
namespace {

constexpr double kMaxScale = 1.5;  // by which the patch may have grown or shrunk

bool looks_alike(const Landmark& landmark, const SE3& camera_from_host, const Prediction& prediction,
                 const RecallOptions& options) {
  const double area = std::abs(prediction.camera_from_host.determinant());
  const double scale = std::sqrt(area);
  if (!(scale < kMaxScale && scale * kMaxScale > 1)) return false;
  const Eigen::Vector3d from_host = camera_from_host.rotation * landmark.bearing;
  const Eigen::Vector3d from_here = from_host + landmark.inverse_depth * camera_from_host.translation;
  const double cosine = from_host.dot(from_here) / (from_host.norm() * from_here.norm());
  return cosine > std::cos(options.max_angle * M_PI / 180);
}

}  // namespace

std::vector<Landmark> landmarks_in_sight(const ActiveMap& map, const LocalMapView& view,
                                         const SE3& camera_from_world, const TrackerOptions& options) {
  ActiveMap local;
  local.rig = map.rig;
  local.disparity_offset = map.disparity_offset;
  for (const Keyframe& keyframe : view.keyframes)
    if (!keyframe.left.empty()) local.hosts[keyframe.id] = keyframe;
  Occupancy occupancy(map.rig, options.landmarks.spacing);
  for (const ActiveLandmark& active : map.landmarks)
    if (const auto at = predict(map, active.landmark, camera_from_world)) occupancy.take(at->position);
  std::vector<Landmark> candidates;
  for (const Landmark& landmark : view.landmarks)
    if (map.index_of(landmark.id) < 0 && !map.moving.contains(landmark.id) &&
        local.hosts.contains(landmark.host))
      candidates.push_back(landmark);
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Landmark& a, const Landmark& b) { return a.information > b.information; });
  std::vector<Landmark> out;
  for (const Landmark& landmark : candidates) {
    if (static_cast<int>(out.size()) >= options.recall.count) break;
    const auto at = predict(local, landmark, camera_from_world);
    const SE3 motion = camera_from_world * local.hosts.at(landmark.host).camera_from_world.inverse();
    if (!at || occupancy.is_taken(static_cast<int>(at->position.x()), static_cast<int>(at->position.y())) ||
        !looks_alike(landmark, motion, *at, options.recall))
      continue;
    occupancy.take(at->position);
    out.push_back(landmark);
  }
  return out;
}

void recall(const LocalMapView& view, const SE3& camera_from_world, const TrackerOptions& options,
            ActiveMap& map) {
  std::set<KeyframeId> hosts;
  for (const Landmark& landmark : landmarks_in_sight(map, view, camera_from_world, options)) {
    map.landmarks.push_back({landmark, landmark.inverse_depth, landmark.information,
                             options.follow.max_missed, Verdict::kProven});
    hosts.insert(landmark.host);
  }
  std::sort(map.landmarks.begin(), map.landmarks.end(),
            [](const ActiveLandmark& a, const ActiveLandmark& b) { return a.landmark.id < b.landmark.id; });
  for (const Keyframe& keyframe : view.keyframes)
    if (hosts.contains(keyframe.id)) map.hosts.try_emplace(keyframe.id, keyframe);
}

}  // namespace spslam
