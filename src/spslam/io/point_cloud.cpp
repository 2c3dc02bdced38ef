// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/io/point_cloud.h"

#include <spdlog/fmt/fmt.h>

namespace spslam {
namespace {

const char* colour(Region region) {
  return region == Region::kFar ? "214 52 47" : "31 157 77";
}

// The sum makes 0 of -0, which an inverse leaves at the origin.
Eigen::Vector3d position_of(const Keyframe& keyframe) {
  return keyframe.camera_from_world.inverse().translation + Eigen::Vector3d::Zero();
}

}  // namespace

std::vector<CloudPoint> cloud_points(const Map& map, const CloudOptions& options) {
  std::vector<CloudPoint> points;
  for (const auto& [id, landmark] : map.landmarks()) {
    const int observers = static_cast<int>(map.observers(id).size());
    if (landmark.region == Region::kMirror || observers < options.min_observers) continue;
    if (!(landmark.inverse_depth > 0) || !(landmark.information > 0)) continue;
    // To first order the depth's relative error is that of its inverse.
    const double uncertainty = 1 / (std::sqrt(landmark.information) * landmark.inverse_depth);
    if (!(uncertainty <= options.max_uncertainty)) continue;
    const Eigen::Vector3d in_host = landmark.bearing / landmark.inverse_depth;
    const SE3 world_from_host = map.find(landmark.host)->camera_from_world.inverse();
    points.push_back(
        {id, world_from_host * in_host, uncertainty * in_host.norm(), landmark.region, observers});
  }
  return points;
}

std::string format_ply(const std::vector<CloudPoint>& points, const Map& map) {
  const std::size_t keyframes = map.keyframes().size();
  fmt::memory_buffer text;
  const auto out = fmt::appender(text);
  fmt::format_to(
      out,
      "ply\nformat ascii 1.0\ncomment SP-SLAM map, world frame, m; near green, far red, keyframes blue\n"
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float sigma\n"
      "element edge {}\nproperty int vertex1\nproperty int vertex2\nend_header\n",
      points.size() + keyframes, std::max<std::size_t>(keyframes, 1) - 1);
  for (const CloudPoint& point : points)
    fmt::format_to(out, "{:.4f} {:.4f} {:.4f} {} {:.4g}\n", point.position.x(), point.position.y(),
                   point.position.z(), colour(point.region), point.sigma);
  for (const auto& [id, keyframe] : map.keyframes()) {
    const Eigen::Vector3d at = position_of(keyframe);
    fmt::format_to(out, "{:.4f} {:.4f} {:.4f} 11 107 203 0\n", at.x(), at.y(), at.z());
  }
  for (std::size_t i = 1; i < keyframes; ++i)
    fmt::format_to(out, "{} {}\n", points.size() + i - 1, points.size() + i);
  return fmt::to_string(text);
}

std::string format_points_csv(const std::vector<CloudPoint>& points) {
  std::string text = "landmark,x,y,z,sigma,region,observers\n";
  for (const CloudPoint& point : points)
    text += fmt::format("{},{:.4f},{:.4f},{:.4f},{:.4g},{},{}\n", point.id.value, point.position.x(),
                        point.position.y(), point.position.z(), point.sigma,
                        point.region == Region::kFar ? "far" : "near", point.observers);
  return text;
}

std::string format_keyframe_poses_csv(const Map& map) {
  std::string text = "keyframe,frame,timestamp,x,y,z,qx,qy,qz,qw,parent\n";
  for (const auto& [id, keyframe] : map.keyframes()) {
    const Eigen::Vector3d t = position_of(keyframe);
    const Eigen::Quaterniond q = keyframe.camera_from_world.inverse().quaternion();
    text += fmt::format("{},{},{:.9f},{:.6f},{:.6f},{:.6f},{:.9f},{:.9f},{:.9f},{:.9f},{}\n", id.value,
                        keyframe.frame.value, keyframe.timestamp, t.x(), t.y(), t.z(), q.x(), q.y(), q.z(),
                        q.w(), keyframe.parent.valid() ? std::to_string(keyframe.parent.value) : "");
  }
  return text;
}

}  // namespace spslam
