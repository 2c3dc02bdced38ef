// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/odometry/new_landmarks.h"

#include <tbb/parallel_for.h>

#include "spslam/odometry/follow.h"
#include "spslam/odometry/occupancy.h"

namespace spslam {
namespace {

struct Disparity {
  double value, sigma;  // px
};

NewLandmark make_landmark(const ActiveMap& map, const Frame& frame, const Keypoint& keypoint,
                          const Descriptor& descriptor, const Disparity& disparity) {
  NewLandmark out;
  Landmark& landmark = out.landmark;
  landmark.pixel = {keypoint.x, keypoint.y};
  landmark.bearing = map.rig.bearing(keypoint.x, keypoint.y);
  landmark.octave = keypoint.octave;
  landmark.descriptor = descriptor;
  landmark.region = frame.regions.at(keypoint.x, keypoint.y);
  const double scale = map.rig.disparity_per_inverse_depth();
  landmark.inverse_depth =
      (disparity.value - map.disparity_offset.at(map.rig, keypoint.x, keypoint.y)) / scale;
  landmark.information = scale * scale / (disparity.sigma * disparity.sigma);
  out.sighting.measured = {keypoint.x, keypoint.y, disparity.value};
  out.sighting.inverse_sigma = {0, 0, 1 / disparity.sigma};
  return out;
}

std::vector<std::optional<double>> measure_all(const Frame& frame, const std::vector<Keypoint>& keypoints,
                                               const TrackerOptions& options) {
  std::vector<std::optional<double>> out(keypoints.size());
  tbb::parallel_for(std::size_t{0}, out.size(), [&](std::size_t i) {
    out[i] = measure_disparity(frame, {keypoints[i].x, keypoints[i].y}, options);
  });
  return out;
}

// The frame's features that are not near a sighting, at most `count`, with the stereo stage's disparities.
std::vector<NewLandmark> from_stereo_stage(const ActiveMap& map, const Frame& frame,
                                           const std::vector<Sighting>& sightings, int count,
                                           const TrackerOptions& options) {
  Occupancy occupancy(map.rig, options.landmarks.spacing);
  for (const Sighting& sighting : sightings) occupancy.take(sighting.measured.head<2>());
  std::vector<NewLandmark> found;
  for (std::size_t i = 0; i < frame.stereo.size() && static_cast<int>(found.size()) < count; ++i) {
    const Keypoint& k = frame.features.keypoints[i];
    const auto x = static_cast<int>(std::lround(k.x)), y = static_cast<int>(std::lround(k.y));
    if (!frame.stereo[i].ok() || occupancy.is_taken(x, y)) continue;
    found.push_back(make_landmark(map, frame, k, frame.features.descriptors[i],
                                  {frame.stereo[i].disparity, frame.stereo[i].sigma}));
  }
  return found;
}

}  // namespace

std::optional<double> measure_disparity(const Frame& frame, const Eigen::Vector2f& left,
                                        const TrackerOptions& options) {
  const auto start =
      search_row(frame.left, left, frame.right, options.alignment.patch_radius, options.row_search);
  return start ? align_disparity(frame, left, *start, 1, options) : std::nullopt;
}

KeyframeFeatures describe(const Frame& frame, const StereoRig& rig, const DisparityOffset& offset,
                          FrontEnd& front_end, const TrackerOptions& options) {
  Features features = front_end.all_features();
  const std::vector<std::optional<double>> disparities = measure_all(frame, features.keypoints, options);
  KeyframeFeatures out;
  const double scale = rig.disparity_per_inverse_depth(), sigma = options.follow.disparity_sigma;
  for (std::size_t i = 0; i < disparities.size(); ++i) {
    const Keypoint& k = features.keypoints[i];
    const double corrected = disparities[i] ? *disparities[i] - offset.at(rig, k.x, k.y) : 0;
    out.inverse_depths.push_back(static_cast<float>(corrected / scale));
    out.information.push_back(disparities[i] ? static_cast<float>(scale * scale / (sigma * sigma)) : 0);
  }
  out.keypoints = std::move(features.keypoints);
  out.descriptors = std::move(features.descriptors);
  out.level_scale = static_cast<float>(options.orb.scale);
  return out;
}

std::vector<NewLandmark> find_new_landmarks(const ActiveMap& map, const Frame& frame,
                                            const std::vector<Sighting>& sightings, FrontEnd& front_end,
                                            const TrackerOptions& options) {
  const int count = options.landmarks.count - static_cast<int>(sightings.size());
  if (count <= 0) return {};
  if (options.stereo_by_descriptor) return from_stereo_stage(map, frame, sightings, count, options);
  std::vector<cv::Point2f> occupied;
  occupied.reserve(sightings.size());
  for (const Sighting& s : sightings)
    occupied.emplace_back(static_cast<float>(s.measured.x()), static_cast<float>(s.measured.y()));
  const Features corners = front_end.new_corners(occupied, count);
  const std::vector<std::optional<double>> disparities = measure_all(frame, corners.keypoints, options);
  std::vector<NewLandmark> found;
  for (std::size_t i = 0; i < disparities.size(); ++i)
    if (disparities[i])
      found.push_back(make_landmark(map, frame, corners.keypoints[i], corners.descriptors[i],
                                    {*disparities[i], options.follow.disparity_sigma}));
  return found;
}

}  // namespace spslam
