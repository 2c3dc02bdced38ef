// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/odometry/follow.h"

#include <tbb/parallel_for.h>

#include <Eigen/LU>

namespace spslam {
namespace {

constexpr double kImageMargin = 6;  // px; patches nearer to the edge show mostly its continuation
constexpr double kWarpStep = 4;     // px, of the numeric derivative

bool inside(const StereoRig& rig, const Eigen::Vector2d& p) {
  return p.x() >= kImageMargin && p.y() >= kImageMargin && p.x() <= rig.width - 1 - kImageMargin &&
         p.y() <= rig.height - 1 - kImageMargin;
}

Sighting make_sighting(LandmarkId id, const Eigen::Vector2f& position, double sigma) {
  Sighting sighting;
  sighting.landmark = id;
  sighting.measured = {position.x(), position.y(), 0};
  sighting.inverse_sigma = {1 / sigma, 1 / sigma, 0};
  return sighting;
}

void add_disparity(const Frame& frame, double predicted, const TrackerOptions& options, Sighting& sighting) {
  const auto disparity =
      align_disparity(frame, sighting.measured.head<2>().cast<float>(), predicted, 0, options);
  if (!disparity) return;
  sighting.measured.z() = *disparity;
  sighting.inverse_sigma.z() = 1 / options.follow.disparity_sigma;
}

std::optional<Sighting> follow_patch(const ActiveMap& map, const Landmark& landmark, const Frame& frame,
                                     const SE3& predicted, int levels, const TrackerOptions& options) {
  const auto prediction = predict(map, landmark, predicted);
  if (!prediction) return std::nullopt;
  const Eigen::Vector2f start = prediction->position.cast<float>();
  const Alignment found = align_patch(map.hosts.at(landmark.host).left, landmark.pixel, frame.left, start,
                                      prediction->camera_from_host, options.alignment, levels - 1);
  if (!found.ok() || !inside(map.rig, found.position.cast<double>())) return std::nullopt;
  if (levels < options.follow.scout_levels && (found.position - start).norm() > options.follow.max_move)
    return std::nullopt;
  Sighting sighting = make_sighting(landmark.id, found.position, options.follow.position_sigma);
  add_disparity(frame, prediction->disparity, options, sighting);
  return sighting;
}

// The features of a frame in cells of the image, so that those near a place are found at once.
class FeatureGrid {
 public:
  FeatureGrid(const Features& features, const StereoRig& rig, double cell)
      : features_(features),
        cell_(static_cast<float>(cell)),
        columns_(static_cast<int>(rig.width / cell) + 1),
        rows_(static_cast<int>(rig.height / cell) + 1),
        cells_(static_cast<std::size_t>(columns_) * rows_) {
    for (std::size_t i = 0; i < features.keypoints.size(); ++i) {
      const auto [column, row] = cell_of(features.keypoints[i].x, features.keypoints[i].y);
      cells_[static_cast<std::size_t>(row) * columns_ + column].push_back(static_cast<int>(i));
    }
  }

  template <class F>
  void for_each_near(const Eigen::Vector2f& at, float radius, F f) const {
    const auto [left, top] = cell_of(at.x() - radius, at.y() - radius);
    const auto [right, bottom] = cell_of(at.x() + radius, at.y() + radius);
    for (int row = top; row <= bottom; ++row)
      for (int column = left; column <= right; ++column)
        for (const int i : cells_[static_cast<std::size_t>(row) * columns_ + column]) {
          const Keypoint& k = features_.keypoints[i];
          if ((Eigen::Vector2f(k.x, k.y) - at).squaredNorm() <= radius * radius) f(i);
        }
  }

 private:
  std::pair<int, int> cell_of(float x, float y) const {
    return {std::clamp(static_cast<int>(x / cell_), 0, columns_ - 1),
            std::clamp(static_cast<int>(y / cell_), 0, rows_ - 1)};
  }
  const Features& features_;
  float cell_;
  int columns_, rows_;
  std::vector<std::vector<int>> cells_;
};

// Index of the feature that a landmark is, or -1 where none is near enough or two are alike.
int best_feature(const Landmark& landmark, const Eigen::Vector2f& at, const Features& features,
                 const FeatureGrid& grid, const FollowOptions& options) {
  int best = -1, distance = options.max_distance + 1, second = 257;
  grid.for_each_near(at, static_cast<float>(options.search_radius), [&](int i) {
    if (std::abs(features.keypoints[i].octave - landmark.octave) > 1) return;
    const int d = hamming(landmark.descriptor, features.descriptors[i]);
    if (d < distance)
      second = distance, distance = d, best = i;
    else if (d < second)
      second = d;
  });
  if (best < 0 || distance > options.max_distance) return -1;
  return distance <= options.max_distance_ratio * second ? best : -1;
}

template <class F>
std::vector<Sighting> collect(std::span<const int> landmarks, F find) {
  std::vector<std::optional<Sighting>> found(landmarks.size());
  tbb::parallel_for(std::size_t{0}, landmarks.size(), [&](std::size_t i) { found[i] = find(landmarks[i]); });
  std::vector<Sighting> sightings;
  for (const std::optional<Sighting>& sighting : found)
    if (sighting) sightings.push_back(*sighting);
  return sightings;
}

}  // namespace

std::optional<Prediction> predict(const ActiveMap& map, const Landmark& landmark,
                                  const SE3& camera_from_world) {
  const SE3 motion = camera_from_world * map.hosts.at(landmark.host).camera_from_world.inverse();
  const Eigen::Vector3d shift = landmark.inverse_depth * motion.translation;
  const Eigen::Vector3d x = motion.rotation * landmark.bearing + shift;
  if (x.z() < 1e-3) return std::nullopt;
  Prediction out;
  out.position = map.rig.project(x);
  if (!inside(map.rig, out.position)) return std::nullopt;
  out.disparity = map.rig.disparity_per_inverse_depth() * landmark.inverse_depth / x.z() +
                  map.disparity_offset.at(map.rig, out.position.x(), out.position.y());
  const auto moved = [&](double dx, double dy) -> Eigen::Vector2f {
    const Eigen::Vector3d b = landmark.bearing + Eigen::Vector3d(dx / map.rig.fx, dy / map.rig.fy, 0);
    return ((map.rig.project(motion.rotation * b + shift) - out.position) / kWarpStep).cast<float>();
  };
  out.camera_from_host << moved(kWarpStep, 0), moved(0, kWarpStep);
  return out;
}

std::optional<double> align_disparity(const Frame& frame, const Eigen::Vector2f& left, double start,
                                      int first_level, const TrackerOptions& options) {
  const bool soft = !frame.soft_left.empty() && start < options.follow.soft_disparity;
  const AlignmentPyramid& left_image = soft ? frame.soft_left : frame.left;
  const AlignmentPyramid& right_image = soft ? frame.soft_right : frame.right;
  const Eigen::Matrix2f upright = Eigen::Matrix2f::Identity();
  const Eigen::Vector2f guess(left.x() - static_cast<float>(start), left.y());
  const Alignment right =
      align_patch(left_image, left, right_image, guess, upright, options.alignment, first_level);
  if (!right.ok() || std::abs(right.position.y() - left.y()) > options.follow.max_row_offset)
    return std::nullopt;
  const Alignment back =
      align_patch(right_image, right.position, left_image, left, upright, options.alignment, 0);
  if (!back.ok() || (back.position - left).norm() > options.follow.max_return) return std::nullopt;
  return left.x() - right.position.x();
}

std::vector<Sighting> follow_patches(const ActiveMap& map, std::span<const int> landmarks, const Frame& frame,
                                     const SE3& predicted, int levels, const TrackerOptions& options) {
  return collect(landmarks, [&](int i) {
    return follow_patch(map, map.landmarks[i].landmark, frame, predicted, levels, options);
  });
}

std::vector<Sighting> follow_descriptors(const ActiveMap& map, std::span<const int> landmarks,
                                         const Frame& frame, const SE3& predicted,
                                         const TrackerOptions& options) {
  const FeatureGrid grid(frame.features, map.rig, options.follow.search_radius);
  return collect(landmarks, [&](int i) -> std::optional<Sighting> {
    const Landmark& landmark = map.landmarks[i].landmark;
    const auto prediction = predict(map, landmark, predicted);
    if (!prediction) return std::nullopt;
    const int feature =
        best_feature(landmark, prediction->position.cast<float>(), frame.features, grid, options.follow);
    if (feature < 0) return std::nullopt;
    const Keypoint& keypoint = frame.features.keypoints[feature];
    const Eigen::Vector2f at(keypoint.x, keypoint.y);
    if (!options.follow.align) {
      const double sigma = options.follow.keypoint_sigma * std::pow(options.orb.scale, keypoint.octave);
      Sighting sighting = make_sighting(landmark.id, at, sigma);
      const StereoMeasurement& stereo = frame.stereo[feature];
      if (stereo.ok())
        sighting.measured.z() = stereo.disparity, sighting.inverse_sigma.z() = 1 / stereo.sigma;
      return sighting;
    }
    const Alignment aligned = align_patch(map.hosts.at(landmark.host).left, landmark.pixel, frame.left, at,
                                          prediction->camera_from_host, options.alignment, 0);
    if (!aligned.ok() || (aligned.position - at).norm() > 3 * options.follow.keypoint_sigma + 2)
      return std::nullopt;
    Sighting sighting = make_sighting(landmark.id, aligned.position, options.follow.position_sigma);
    add_disparity(frame, prediction->disparity, options, sighting);
    return sighting;
  });
}

}  // namespace spslam
