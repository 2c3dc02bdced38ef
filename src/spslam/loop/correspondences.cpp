// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/loop/correspondences.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace spslam {
namespace {

constexpr double kGuidedRatio = 0.9;  // best distance over second best
constexpr double kSameCorner = 3;     // px; nearer ones are one corner found on two levels
constexpr int kVisibleCell = 4;       // px

double position_variance(const Keypoint& keypoint, double level_scale, double sigma) {
  return std::pow(sigma * std::pow(level_scale, keypoint.octave), 2);
}

}  // namespace

Correspondences::Correspondences(const Place& older, const KeyframeFeatures& newer, const StereoRig& rig,
                                 const VerificationOptions& options)
    : older_(older), newer_(newer), rig_(rig), options_(options) {
  for (std::size_t i = 0; i < newer.size(); ++i)
    if (std::isfinite(newer.keypoints[i].x) && std::isfinite(newer.keypoints[i].y))
      by_x_.push_back(static_cast<int>(i));
  std::stable_sort(by_x_.begin(), by_x_.end(),
                   [&](int a, int b) { return newer.keypoints[a].x < newer.keypoints[b].x; });
}

Correspondence Correspondences::pair(int point, int feature) const {
  const PlacePoint& p = older_.points[point];
  const Keypoint& seen = newer_.keypoints[feature];
  Correspondence out;
  out.point = point, out.feature = feature;
  out.bearing = p.bearing, out.inverse_depth = p.inverse_depth;
  const double share = options_.depth_share;
  if (p.information > 0) out.information = 1 / (1 / p.information + std::pow(share * p.inverse_depth, 2));
  const double older_scale = older_.sources[p.source].features->level_scale;
  const double sigma = std::sqrt(position_variance(seen, newer_.level_scale, options_.position_sigma) +
                                 position_variance(older_.keypoint(p), older_scale, options_.position_sigma));
  out.measured = {seen.x, seen.y, 0};
  out.inverse_sigma = {1 / sigma, 1 / sigma, 0};
  const double fb = rig_.disparity_per_inverse_depth();
  const double own = newer_.inverse_depths[feature] / scale_, information = newer_.information[feature];
  if (use_disparities_ && information > 0 && std::isfinite(own) && std::isfinite(information)) {
    out.measured.z() = fb * own;
    out.inverse_sigma.z() =
        1 / (fb * std::sqrt(1 / (information * scale_ * scale_) + std::pow(share * own, 2)));
  }
  return out;
}

std::vector<Correspondence> Correspondences::by_descriptor(const Vocabulary& vocabulary) const {
  const NodeFeatures nodes = group_features(vocabulary, newer_, options_.matching);
  struct Best {
    int point = -1, distance = 257;
  };
  std::vector<Best> best(newer_.size());
  for (const PlaceSource& source : older_.sources)
    for (const FeatureMatch& match :
         match_features(*source.features, group_features(vocabulary, *source.features, options_.matching),
                        newer_, nodes, options_.matching))
      if (const int point = source.point[match.first];
          point >= 0 && match.distance < best[match.second].distance)
        best[match.second] = {point, match.distance};
  std::vector<Correspondence> out;
  for (const int feature : by_x_)
    if (best[feature].point >= 0) out.push_back(pair(best[feature].point, feature));
  return out;
}

std::optional<Correspondences::Seen> Correspondences::predict(const SE3& newer_from_older, int point,
                                                              double radius) const {
  const PlacePoint& p = older_.points[point];
  const Eigen::Vector3d x =
      newer_from_older.rotation * p.bearing + p.inverse_depth * newer_from_older.translation;
  if (!(x.z() > 0.1)) return std::nullopt;
  const Eigen::Vector2d at = rig_.project(x);
  const bool inside = at.x() >= 0 && at.y() >= 0 && at.x() < rig_.width && at.y() < rig_.height;
  if (!inside) return std::nullopt;
  return Seen{point, at, radius};
}

Correspondences::Choice Correspondences::best_feature(const Seen& seen, const Descriptor& descriptor) const {
  Choice choice;
  auto it = std::lower_bound(by_x_.begin(), by_x_.end(), seen.at.x() - seen.radius,
                             [&](int feature, double x) { return newer_.keypoints[feature].x < x; });
  for (; it != by_x_.end() && newer_.keypoints[*it].x <= seen.at.x() + seen.radius; ++it) {
    const Keypoint& keypoint = newer_.keypoints[*it];
    if (std::hypot(keypoint.x - seen.at.x(), keypoint.y - seen.at.y()) > seen.radius) continue;
    const int distance = hamming(descriptor, newer_.descriptors[*it]);
    const bool same =
        choice.other >= 0 && std::hypot(keypoint.x - newer_.keypoints[choice.other].x,
                                        keypoint.y - newer_.keypoints[choice.other].y) < kSameCorner;
    if (distance < choice.distance) {
      if (!same) choice.second = choice.distance;
      choice.distance = distance, choice.other = *it;
    } else if (!same) {
      choice.second = std::min(choice.second, distance);
    }
  }
  return choice;
}

std::vector<Correspondence> Correspondences::guided(const SE3& newer_from_older, double radius) const {
  std::vector<Choice> of_feature(newer_.size());
  for (std::size_t point = 0; point < older_.points.size(); ++point) {
    const PlacePoint& p = older_.points[point];
    if (!(p.information > 0)) continue;
    const std::optional<Seen> seen = predict(newer_from_older, static_cast<int>(point), radius);
    if (!seen) continue;
    const Choice choice = best_feature(*seen, older_.descriptor(p));
    if (choice.distance > options_.guided_distance || choice.distance > kGuidedRatio * choice.second)
      continue;
    Choice& taken = of_feature[choice.other];
    if (choice.distance < taken.distance) taken = {static_cast<int>(point), choice.distance, 0};
  }
  std::vector<Correspondence> out;
  for (const int feature : by_x_)
    if (of_feature[feature].other >= 0) out.push_back(pair(of_feature[feature].other, feature));
  return out;
}

int Correspondences::visible(const SE3& newer_from_older) const {
  std::set<std::pair<int, int>> places;
  for (std::size_t point = 0; point < older_.points.size(); ++point)
    if (older_.points[point].information > 0)
      if (const std::optional<Seen> seen = predict(newer_from_older, static_cast<int>(point), 0))
        places.insert(
            {static_cast<int>(seen->at.x()) / kVisibleCell, static_cast<int>(seen->at.y()) / kVisibleCell});
  return static_cast<int>(places.size());
}

}  // namespace spslam
