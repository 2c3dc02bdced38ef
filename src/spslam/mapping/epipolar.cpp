// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/mapping/epipolar.h"

namespace spslam {
namespace {

constexpr double kSameCorner = 4;  // px on the coarser level: two features of one corner, not two alike

// A feature as the search along lines needs it. The line is that of the feature in the other image, px,
// up to a factor: a point (u, v) lies off it by line . (u, v, 1) / |(line.x, line.y)|.
struct Point {
  Eigen::Vector3d at, line;
  double sigma, slope;  // px; |(line.x, line.y)|^2
};

// Where the epipolar plane with this normal (in the camera's axes) cuts the image.
Eigen::Vector3d line_of(const StereoRig& rig, const Eigen::Vector3d& normal) {
  const double x = normal.x() / rig.fx, y = normal.y() / rig.fy;
  return {x, y, normal.z() - x * rig.cx - y * rig.cy};
}

// The features with their lines in the other image. Both images' lines share one factor: e = p2' F p1 is
// the same from both sides.
std::vector<Point> points_of(const StereoRig& rig, const KeyframeFeatures& features,
                             const std::vector<int>& chosen, const SE3& other_from_here, bool is_first,
                             double level_scale, const EpipolarOptions& options) {
  std::vector<Point> out;
  out.reserve(chosen.size());
  const Eigen::Matrix3d& r = other_from_here.rotation;
  for (const int i : chosen) {
    const Keypoint& k = features.keypoints[i];
    const Eigen::Vector3d bearing = rig.bearing(k.x, k.y);
    // Of the second image: R' (b x t), with R and t of the motion from the first one, t = -R t_back.
    const Eigen::Vector3d normal = is_first ? other_from_here.translation.cross(r * bearing).eval()
                                            : (r * bearing).cross(-other_from_here.translation).eval();
    const Eigen::Vector3d line = line_of(rig, normal);
    out.push_back(
        {{k.x, k.y, 1}, line, keypoint_sigma(k, level_scale, options), line.head<2>().squaredNorm()});
  }
  return out;
}

bool is_on_line(const Point& first, const Point& second, double max_chi2) {
  const double e = first.line.dot(second.at);
  return e * e <
         max_chi2 * (second.sigma * second.sigma * first.slope + first.sigma * first.sigma * second.slope);
}

struct Candidate {
  int distance, second;
  friend auto operator<=>(const Candidate&, const Candidate&) = default;
};

// The nearest of the candidates, unless another one that is elsewhere is nearly as near.
const Candidate* clear_best(const std::vector<Candidate>& candidates, const std::vector<Point>& second,
                            double same_corner, const EpipolarOptions& options) {
  const auto best = std::min_element(candidates.begin(), candidates.end());
  if (best == candidates.end() || best->distance > options.max_distance) return nullptr;
  for (const Candidate& other : candidates)
    if (best->distance >= options.ratio * other.distance &&
        (second[other.second].at - second[best->second].at).norm() > same_corner)
      return nullptr;
  return &*best;
}

}  // namespace

double keypoint_sigma(const Keypoint& keypoint, double level_scale, const EpipolarOptions& options) {
  return options.keypoint_sigma * std::pow(level_scale, keypoint.octave);
}

std::vector<EpipolarMatch> match_along_epipolar_lines(const StereoRig& rig, const KeyframeFeatures& first,
                                                      const std::vector<int>& of_first,
                                                      const KeyframeFeatures& second,
                                                      const std::vector<int>& of_second,
                                                      const SE3& second_from_first, double level_scale,
                                                      const EpipolarOptions& options) {
  if (!(second_from_first.translation.norm() > 1e-6) || !second_from_first.is_finite()) return {};
  const std::vector<Point> ones =
      points_of(rig, first, of_first, second_from_first, true, level_scale, options);
  const std::vector<Point> others =
      points_of(rig, second, of_second, second_from_first.inverse(), false, level_scale, options);
  constexpr int kNone = 257;
  std::vector<EpipolarMatch> back(others.size(), {-1, -1, kNone});
  std::vector<EpipolarMatch> there;
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < ones.size(); ++i) {
    candidates.clear();
    for (std::size_t j = 0; j < others.size(); ++j) {
      if (!is_on_line(ones[i], others[j], options.max_chi2)) continue;
      const int d = hamming(first.descriptors[of_first[i]], second.descriptors[of_second[j]]);
      candidates.push_back({d, static_cast<int>(j)});
      if (d < back[j].distance) back[j] = {static_cast<int>(i), static_cast<int>(j), d};
    }
    const double same_corner = kSameCorner * ones[i].sigma / options.keypoint_sigma;
    if (const Candidate* best = clear_best(candidates, others, same_corner, options))
      there.push_back({static_cast<int>(i), best->second, best->distance});
  }
  std::vector<EpipolarMatch> out;
  for (const EpipolarMatch& match : there)
    if (back[match.second].first == match.first)
      out.push_back({of_first[match.first], of_second[match.second], match.distance});
  return out;
}

}  // namespace spslam
