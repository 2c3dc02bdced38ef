// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/mapping/fuse.h"

#include "spslam/base/weighted_mean.h"
#include "spslam/map/moved_point.h"
#include "spslam/mapping/duplicates.h"
#include "spslam/optimize/problem.h"

namespace spslam {
namespace {

constexpr double kDepthFloor = 0.02;  // of the inverse depth: two corners of one thing are not equally far

// What a keyframe saw, by column, so that a place's neighbourhood is found at once.
class SightingsByColumn {
 public:
  explicit SightingsByColumn(const Keyframe& keyframe) {
    for (const Sighting& s : keyframe.sightings) by_x_.push_back(&s);
    std::stable_sort(by_x_.begin(), by_x_.end(),
                     [](const Sighting* a, const Sighting* b) { return a->measured.x() < b->measured.x(); });
  }
  // The nearest one within a radius, or null.
  const Sighting* nearest(const Eigen::Vector2d& at, double radius) const {
    const Sighting* best = nullptr;
    double distance = radius;
    auto it = std::lower_bound(by_x_.begin(), by_x_.end(), at.x() - radius,
                               [](const Sighting* s, double x) { return s->measured.x() < x; });
    for (; it != by_x_.end() && (*it)->measured.x() <= at.x() + radius; ++it)
      if (const double d = ((*it)->measured.head<2>() - at).norm(); d <= distance) distance = d, best = *it;
    return best;
  }

 private:
  std::vector<const Sighting*> by_x_;
};

// A landmark from a camera: where, and how far, 1/m along z, with its variance.
struct Seen {
  Eigen::Vector2d at;
  double blur;  // px, by which the inverse depth's deviation moves it
  double inverse_depth, variance;
};

class Fusion {
 public:
  Fusion(Map& map, const StereoRig& rig, const Keyframe& newest, const DuplicateOptions& options)
      : map_(map), rig_(rig), newest_(newest), options_(options) {}

  int run() {
    const SightingsByColumn here(newest_);
    int compared = 0;
    for (const Covisible& near : map_.covisible(newest_.id)) {
      if (compared++ >= options_.keyframes) break;
      const Keyframe& other = *map_.find(near.id);
      const SightingsByColumn there(other);
      for (const Sighting& s : other.sightings)
        if (!find_sighting(newest_, s.landmark)) compare(s.landmark, newest_, here, false);
      for (const Sighting& s : newest_.sightings)
        if (!find_sighting(other, s.landmark)) compare(s.landmark, other, there, true);
    }
    const std::vector<Duplicate> pairs = best_of_each(std::move(found_));
    for (const Duplicate& pair : pairs) fuse(pair);
    return static_cast<int>(pairs.size());
  }

 private:
  std::optional<Seen> see(const Landmark& landmark, const Keyframe& from) const {
    const Keyframe* host = map_.find(landmark.host);
    if (!host || !(landmark.information > 0)) return std::nullopt;
    const SE3 motion = from.camera_from_world * host->camera_from_world.inverse();
    const Linearized at = linearize(rig_, motion, landmark.bearing, landmark.inverse_depth, {0, 0, 0});
    if (!at.in_front || !at.residual.allFinite()) return std::nullopt;
    const double sigma = 1 / std::sqrt(landmark.information);
    const double by = at.by_inverse_depth.z() / rig_.disparity_per_inverse_depth();
    return Seen{at.residual.head<2>(), at.by_inverse_depth.head<2>().norm() * sigma,
                at.residual.z() / rig_.disparity_per_inverse_depth(), by * by * sigma * sigma};
  }

  // Whether a landmark is, from this keyframe, the same as the one that stands where it should be.
  void compare(LandmarkId id, const Keyframe& from, const SightingsByColumn& sightings, bool is_kept) {
    const auto mine = see(*map_.find(id), from);
    if (!mine || mine->blur > options_.radius) return;
    const Sighting* nearest = sightings.nearest(mine->at, options_.radius);
    if (!nearest || nearest->landmark == id || share_a_keyframe(id, nearest->landmark)) return;
    const Landmark &a = *map_.find(id), &b = *map_.find(nearest->landmark);
    const int distance = hamming(a.descriptor, b.descriptor);
    const auto its = see(b, from);
    if (distance > options_.max_distance || !its || !are_equally_far(*mine, *its)) return;
    if (options_.align && !is_at(a, from, nearest->measured.head<2>())) return;
    found_.push_back({distance, is_kept ? id : b.id, is_kept ? b.id : id});
  }

  bool share_a_keyframe(LandmarkId a, LandmarkId b) const {
    const std::vector<KeyframeId>&of_a = map_.observers(a), &of_b = map_.observers(b);
    return std::any_of(of_a.begin(), of_a.end(),
                       [&](KeyframeId id) { return std::binary_search(of_b.begin(), of_b.end(), id); });
  }

  bool are_equally_far(const Seen& a, const Seen& b) const {
    const double difference = std::abs(a.inverse_depth - b.inverse_depth);
    const double floor = kDepthFloor * std::max(std::abs(a.inverse_depth), std::abs(b.inverse_depth));
    return difference <= floor + options_.depth_sigmas * std::sqrt(a.variance + b.variance);
  }

  // Whether the landmark's patch is where the other landmark stands. True if there is no image to look at.
  bool is_at(const Landmark& landmark, const Keyframe& from, const Eigen::Vector2d& position) const {
    const Keyframe& host = *map_.find(landmark.host);
    if (host.left.empty() || from.left.empty()) return true;
    return find_patch(rig_, host, landmark, from, position, options_.radius, options_.alignment).has_value();
  }

  void fuse(const Duplicate& pair) {
    merge_depths(pair);
    const Landmark& kept = *map_.find(pair.kept);
    const Keyframe& host = *map_.find(kept.host);
    // Two corners of one thing are not at the same pixel: the kept one's patch says where it itself is.
    for (const KeyframeId id : std::vector(map_.observers(pair.gone))) {
      const Keyframe& observer = *map_.find(id);
      if (!options_.align || find_sighting(observer, pair.kept)) continue;
      Sighting s = as_seen_of(pair.kept, *find_sighting(observer, pair.gone));
      const auto at = find_patch(rig_, host, kept, observer, s.measured.head<2>(), 2 * options_.radius,
                                 options_.alignment);
      if (!at) continue;
      s.measured.head<2>() = *at;
      s.inverse_sigma.head<2>().setConstant(1 / options_.position_sigma);
      map_.set_sighting(id, s);
    }
    map_.fuse(pair.kept, pair.gone);
  }

  // What was known of the inverse depth of the one that goes, the other knows as well.
  void merge_depths(const Duplicate& pair) {
    Landmark kept = *map_.find(pair.kept);
    const Landmark& gone = *map_.find(pair.gone);
    const SE3 motion =
        map_.find(kept.host)->camera_from_world * map_.find(gone.host)->camera_from_world.inverse();
    const auto merge = [&](double inverse_depth, double information, double& into, double& known) {
      if (!(information > 0)) return;
      const MovedPoint point = move_point(motion, gone.bearing, inverse_depth);
      if (!(point.depth_ratio > 1e-3)) return;
      add_to_mean(point.inverse_depth, information * point.information_gain, into, known);
    };
    merge(gone.inverse_depth, gone.information, kept.inverse_depth, kept.information);
    merge(gone.stereo_inverse_depth, gone.stereo_information, kept.stereo_inverse_depth,
          kept.stereo_information);
    if (std::isfinite(kept.inverse_depth) && std::isfinite(kept.stereo_inverse_depth)) map_.update(kept);
  }

  Map& map_;
  const StereoRig& rig_;
  const Keyframe& newest_;
  const DuplicateOptions& options_;
  std::vector<Duplicate> found_;
};

}  // namespace

int fuse_duplicates(Map& map, const StereoRig& rig, KeyframeId newest, const DuplicateOptions& options) {
  const Keyframe* keyframe = map.find(newest);
  if (!options.enabled || !keyframe || !keyframe->camera_from_world.is_finite()) return 0;
  return Fusion(map, rig, *keyframe, options).run();
}

}  // namespace spslam
