// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/mapping/triangulate.h"

namespace spslam {
namespace {

constexpr int kNewtonSteps = 4;
constexpr double kLeastInformation = 1e-9;  // m^2
constexpr double kMaxMove = 3;              // sigma of a feature that its aligned position may lie off it
constexpr double kMaxScaleChange = 1.5;     // between the sizes that levels and that distances give

// sum over views of |a w + c|^2 for the direct linear transform, in px of the views.
struct LinearSums {
  double information, gradient;
};

LinearSums linear_sums(const StereoRig& rig, const Eigen::Vector3d& bearing,
                       std::span<const DepthView> views) {
  LinearSums sums{0, 0};
  const double fb = rig.disparity_per_inverse_depth();
  for (const DepthView& view : views) {
    const Eigen::Vector3d seen = rig.bearing(view.measured.x(), view.measured.y());
    const Eigen::Vector3d r = view.camera_from_host.rotation * bearing, t = view.camera_from_host.translation;
    // x/z, y/z and f B w/z of the point r + w t are those that were measured.
    Eigen::Vector3d a = rig.fx * (t.z() * seen - t), c = rig.fx * (r.z() * seen - r);
    a.z() = view.measured.z() * t.z() - fb, c.z() = view.measured.z() * r.z();
    a = a.cwiseProduct(view.inverse_sigma), c = c.cwiseProduct(view.inverse_sigma);
    sums.information += a.squaredNorm();
    sums.gradient += a.dot(c);
  }
  return sums;
}

// Whether each feature lies away from all sightings: nobody's yet.
std::vector<int> free_features(const StereoRig& rig, const Keyframe& keyframe, double spacing) {
  std::vector<char> taken(static_cast<std::size_t>(rig.width) * rig.height, 0);
  const auto index = [&](int x, int y) { return static_cast<std::size_t>(y) * rig.width + x; };
  for (const Sighting& s : keyframe.sightings) {
    const int left = std::max(0, static_cast<int>(std::ceil(s.measured.x() - spacing))),
              right = std::min(rig.width - 1, static_cast<int>(std::floor(s.measured.x() + spacing))),
              top = std::max(0, static_cast<int>(std::ceil(s.measured.y() - spacing))),
              bottom = std::min(rig.height - 1, static_cast<int>(std::floor(s.measured.y() + spacing)));
    for (int y = top; y <= bottom; ++y)
      for (int x = left; x <= right; ++x) taken[index(x, y)] = 1;
  }
  std::vector<int> out;
  for (std::size_t i = 0; i < keyframe.features->size(); ++i) {
    const Keypoint& k = keyframe.features->keypoints[i];
    const int x = static_cast<int>(std::lround(k.x)), y = static_cast<int>(std::lround(k.y));
    const bool is_inside = x >= 0 && y >= 0 && x < rig.width && y < rig.height;
    if (is_inside && !taken[index(x, y)]) out.push_back(static_cast<int>(i));
  }
  return out;
}

// A feature of another keyframe that looks like one of the newest keyframe's.
struct Partner {
  const Keyframe* keyframe;
  int feature;
};

class LandmarkMaker {
 public:
  LandmarkMaker(Map& map, const StereoRig& rig, const Keyframe& newest, double level_scale,
                const TriangulationOptions& options)
      : map_(map), rig_(rig), newest_(newest), level_scale_(level_scale), options_(options) {}

  int run(LandmarkId& next) {
    find_partners();
    int made = 0;
    for (const auto& [feature, partners] : partners_) {
      if (!next.valid()) break;
      made += make(feature, partners, next);
    }
    return made;
  }

 private:
  // A landmark as two keyframes give it, and where else it was seen.
  struct Trial {
    Landmark landmark;
    std::vector<KeyframeId> keyframes;
    std::vector<DepthView> views;
  };

  void find_partners() {
    const std::vector<int> of_newest = free_features(rig_, newest_, options_.spacing);
    int matched = 0;
    for (const Covisible& near : map_.covisible(newest_.id, options_.least_shared)) {
      if (matched++ >= options_.keyframes) break;
      const Keyframe& other = *map_.find(near.id);
      if (!other.features) continue;
      const SE3 motion = other.camera_from_world * newest_.camera_from_world.inverse();
      for (const EpipolarMatch& match : match_along_epipolar_lines(
               rig_, *newest_.features, of_newest, *other.features,
               free_features(rig_, other, options_.spacing), motion, level_scale_, options_.matching))
        partners_[match.first].push_back({&other, match.second});
    }
  }

  const Keypoint& keypoint(const Partner& partner) const {
    return partner.keyframe->features->keypoints[partner.feature];
  }
  double sigma(const Partner& partner) const {
    return keypoint_sigma(keypoint(partner), level_scale_, options_.matching);
  }

  // The best determined of the landmarks that the newest keyframe's feature and one partner each give, with
  // the other partners' sightings that agree with it.
  bool make(int feature, const std::vector<Partner>& partners, LandmarkId& next) {
    const Partner here{&newest_, feature};
    if (belongs_to_one_made(keypoint(here))) return false;
    std::optional<Trial> best;
    for (const Partner& host : partners) {
      std::optional<Trial> trial = try_pair(host, here);
      if (trial && (!best || relative_variance(*trial) < relative_variance(*best))) best = std::move(trial);
    }
    if (!best) return false;
    for (const Partner& other : partners)
      if (other.keyframe->id != best->landmark.host) extend(other, *best);
    add(*best, next);
    made_at_.push_back(keypoint(here));
    return true;
  }

  // Features of several levels may stand on one corner.
  bool belongs_to_one_made(const Keypoint& at) const {
    return std::any_of(made_at_.begin(), made_at_.end(), [&](const Keypoint& made) {
      return std::hypot(made.x - at.x, made.y - at.y) <= options_.spacing;
    });
  }

  static double relative_variance(const Trial& trial) {
    const Landmark& l = trial.landmark;
    return 1 / (l.information * l.inverse_depth * l.inverse_depth);
  }

  std::optional<Trial> try_pair(const Partner& host, const Partner& other) const {
    const Keypoint& at = keypoint(host);
    Trial trial;
    Landmark& landmark = trial.landmark;
    landmark.host = host.keyframe->id;
    landmark.pixel = {at.x, at.y};
    landmark.bearing = rig_.bearing(at.x, at.y);
    landmark.octave = at.octave;
    landmark.descriptor = host.keyframe->features->descriptors[host.feature];
    // By the features' own positions first: enough to know how the patch is warped.
    const DepthView rough = view_at(*host.keyframe, *other.keyframe, {keypoint(other).x, keypoint(other).y},
                                    std::hypot(sigma(host), sigma(other)));
    if (!solve({&rough, 1}, landmark)) return std::nullopt;
    trial.views.push_back(rough);
    trial.keyframes.push_back(other.keyframe->id);
    if (options_.align && !host.keyframe->left.empty() && !other.keyframe->left.empty()) {
      const auto aligned = align(host, other, landmark);
      if (!aligned) return std::nullopt;
      trial.views.front() = *aligned;
      if (!solve(trial.views, landmark)) return std::nullopt;
    }
    if (!is_acceptable(trial) || !has_one_size(host, other, landmark)) return std::nullopt;
    landmark.region = region_near(*host.keyframe, landmark.pixel);
    if (landmark.region == Region::kMirror) return std::nullopt;
    return trial;
  }

  static DepthView view_at(const Keyframe& host, const Keyframe& other, const Eigen::Vector2d& at,
                           double sigma) {
    const SE3 motion = other.camera_from_world * host.camera_from_world.inverse();
    return {motion, {at.x(), at.y(), 0}, {1 / sigma, 1 / sigma, 0}};
  }

  std::optional<DepthView> align(const Partner& host, const Partner& other, const Landmark& landmark) const {
    const Keypoint& k = keypoint(other);
    const auto at = find_patch(rig_, *host.keyframe, landmark, *other.keyframe, {k.x, k.y},
                               kMaxMove * std::hypot(sigma(host), sigma(other)), options_.alignment);
    if (!at) return std::nullopt;
    return view_at(*host.keyframe, *other.keyframe, *at, options_.position_sigma);
  }

  bool solve(std::span<const DepthView> views, Landmark& landmark) const {
    const auto found = triangulate(rig_, landmark.bearing, views);
    if (!found || found->inverse_depth <= 0) return false;
    landmark.inverse_depth = found->inverse_depth;
    landmark.information = found->information;
    return true;
  }

  bool fits(const Landmark& landmark, const DepthView& view) const {
    const Linearized at =
        linearize(rig_, view.camera_from_host, landmark.bearing, landmark.inverse_depth, view.measured);
    const double chi2 = at.residual.head<2>().squaredNorm() * view.inverse_sigma.x() * view.inverse_sigma.x();
    return at.in_front && chi2 <= options_.max_chi2;
  }

  // The host's own view fits by definition: the bearing is where it saw the point.
  bool is_acceptable(const Trial& trial) const {
    const double limit = options_.max_relative_sigma * options_.max_relative_sigma;
    return relative_variance(trial) <= limit &&
           std::all_of(trial.views.begin(), trial.views.end(),
                       [&](const DepthView& view) { return fits(trial.landmark, view); });
  }

  // The size of what a feature shows goes with its level's scale times its distance.
  bool has_one_size(const Partner& host, const Partner& other, const Landmark& landmark) const {
    const SE3 motion = other.keyframe->camera_from_world * host.keyframe->camera_from_world.inverse();
    const double distances =
        (motion.rotation * landmark.bearing + landmark.inverse_depth * motion.translation).norm() /
        landmark.bearing.norm();
    const double change = distances * std::pow(level_scale_, keypoint(other).octave - keypoint(host).octave);
    return change <= kMaxScaleChange && change * kMaxScaleChange >= 1;
  }

  // The mapper has no masks: what the nearest landmark is labelled, this is.
  Region region_near(const Keyframe& host, const Eigen::Vector2f& pixel) const {
    double nearest = std::numeric_limits<double>::infinity();
    Region region = Region::kNear;
    for (const Sighting& s : host.sightings) {
      const double distance = (s.measured.head<2>() - pixel.cast<double>()).squaredNorm();
      if (distance < nearest) nearest = distance, region = map_.find(s.landmark)->region;
    }
    return region;
  }

  // Only what is aligned with the host's patch: features' own positions all have the error of the host's one
  // in common, and two of them would not know the depth as well as they say.
  void extend(const Partner& other, Trial& trial) const {
    const Keyframe& host = *map_.find(trial.landmark.host);
    if (!options_.align || host.left.empty() || other.keyframe->left.empty()) return;
    const Keypoint& k = keypoint(other);
    const auto at = find_patch(rig_, host, trial.landmark, *other.keyframe, {k.x, k.y},
                               kMaxMove * sigma(other), options_.alignment);
    if (!at) return;
    Trial extended = trial;
    extended.views.push_back(view_at(host, *other.keyframe, *at, options_.position_sigma));
    extended.keyframes.push_back(other.keyframe->id);
    if (solve(extended.views, extended.landmark) && is_acceptable(extended)) trial = std::move(extended);
  }

  void add(Trial& trial, LandmarkId& next) {
    Landmark& landmark = trial.landmark;
    landmark.id = next;
    ++next.value;
    // The depth has its scale from the motion. Taken for more certain, it would hold the tracker's next
    // motions to the scale of the last ones, errors and all.
    const double relative = relative_variance(trial) + options_.motion_sigma * options_.motion_sigma;
    landmark.information = 1 / (relative * landmark.inverse_depth * landmark.inverse_depth);
    map_.add(landmark);
    Sighting own;
    own.landmark = landmark.id;
    own.measured.head<2>() = landmark.pixel.cast<double>();
    map_.set_sighting(landmark.host, own);
    for (std::size_t i = 0; i < trial.views.size(); ++i)
      map_.set_sighting(trial.keyframes[i],
                        {landmark.id, trial.views[i].measured, trial.views[i].inverse_sigma, 1});
  }

  Map& map_;
  const StereoRig& rig_;
  const Keyframe& newest_;
  double level_scale_;
  const TriangulationOptions& options_;
  std::map<int, std::vector<Partner>> partners_;  // of the newest keyframe's features
  std::vector<Keypoint> made_at_;                 // in the newest keyframe
};

}  // namespace

std::optional<Triangulated> triangulate(const StereoRig& rig, const Eigen::Vector3d& bearing,
                                        std::span<const DepthView> views) {
  const LinearSums start = linear_sums(rig, bearing, views);
  if (!(start.information > kLeastInformation)) return std::nullopt;
  Triangulated out{-start.gradient / start.information, 0};
  for (int step = 0; step < kNewtonSteps; ++step) {
    double information = 0, gradient = 0;
    for (const DepthView& view : views) {
      const Linearized at = linearize(rig, view.camera_from_host, bearing, out.inverse_depth, view.measured);
      if (!at.in_front) return std::nullopt;
      const Eigen::Vector3d j = at.by_inverse_depth.cwiseProduct(view.inverse_sigma);
      information += j.squaredNorm();
      gradient += j.dot(at.residual.cwiseProduct(view.inverse_sigma));
    }
    if (!(information > kLeastInformation)) return std::nullopt;
    out.inverse_depth -= gradient / information;
    out.information = information;
    if (!std::isfinite(out.inverse_depth) || !std::isfinite(out.information)) return std::nullopt;
  }
  return out;
}

int add_landmarks_between(Map& map, const StereoRig& rig, KeyframeId newest, double level_scale,
                          const TriangulationOptions& options, LandmarkId& next) {
  const Keyframe* keyframe = map.find(newest);
  if (!options.enabled || !keyframe || !keyframe->features || !keyframe->camera_from_world.is_finite())
    return 0;
  return LandmarkMaker(map, rig, *keyframe, level_scale, options).run(next);
}

}  // namespace spslam
