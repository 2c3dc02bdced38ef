// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/loop/fusion.h"

#include "spslam/loop/correspondences.h"
#include "spslam/mapping/duplicates.h"

namespace spslam {
namespace {

constexpr double kDisparitySigmas = 4;   // by which disparities of duplicates may differ
constexpr double kDisparityFloor = 0.3;  // px, beside them

using Pixel = std::pair<float, float>;

// A keyframe's features on full size stand where it saw landmarks (mapping/describe.h), so that they can be
// told from their pixels.
class SightingTable {
 public:
  explicit SightingTable(const Keyframe& keyframe) {
    for (const Sighting& sighting : keyframe.sightings) landmark_[pixel(sighting)] = sighting.landmark;
    if (!keyframe.features) return;
    for (std::size_t i = 0; i < keyframe.features->size(); ++i)
      if (const Keypoint& at = keyframe.features->keypoints[i]; at.octave == 0)
        feature_[{at.x, at.y}] = static_cast<int>(i);
  }
  LandmarkId landmark(float x, float y) const {
    const auto found = landmark_.find({x, y});
    return found == landmark_.end() ? LandmarkId{} : found->second;
  }
  int feature(const Sighting& sighting) const {
    const auto found = feature_.find(pixel(sighting));
    return found == feature_.end() ? -1 : found->second;
  }

 private:
  static Pixel pixel(const Sighting& s) {
    return {static_cast<float>(s.measured.x()), static_cast<float>(s.measured.y())};
  }
  std::map<Pixel, LandmarkId> landmark_;
  std::map<Pixel, int> feature_;
};

class Fusion {
 public:
  Fusion(const Map& map, const StereoRig& rig, const LoopClosure& closure, const FusionOptions& options,
         MapCorrection& correction)
      : map_(map), rig_(rig), closure_(closure), options_(options), correction_(correction) {
    for (const auto& [id, pose] : correction.camera_from_world) pose_[id] = pose;
  }

  void run() {
    collect_older();
    for (const KeyframeId id : around(closure_.edge.newer)) match(*map_.find(id));
    add_pairs();
    for (const Duplicate& pair : best_of_each(std::move(duplicates_)))
      correction_.fused.emplace_back(pair.kept, pair.gone);
  }

 private:
  std::vector<KeyframeId> around(KeyframeId id) const {
    std::vector<KeyframeId> out = {id};
    for (const Covisible& near : map_.covisible(id))
      if (static_cast<int>(out.size()) <= options_.neighbours) out.push_back(near.id);
    return out;
  }

  SE3 pose(KeyframeId id) const {
    const auto found = pose_.find(id);
    return found == pose_.end() ? map_.find(id)->camera_from_world : found->second;
  }

  // The older side's landmarks with a descriptor each, from the first keyframe that has one.
  void collect_older() {
    for (const KeyframeId id : around(closure_.edge.older)) {
      const Keyframe& keyframe = *map_.find(id);
      const SightingTable table(keyframe);
      for (const Sighting& sighting : keyframe.sightings)
        if (const int feature = table.feature(sighting); feature >= 0)
          older_.try_emplace(sighting.landmark, keyframe.features->descriptors[feature]);
    }
  }

  // Older landmarks that this keyframe sees as landmarks of its own.
  void match(const Keyframe& keyframe) {
    if (!keyframe.features) return;
    const SightingTable table(keyframe);
    for (const auto& [id, descriptor] : older_) {
      if (find_sighting(keyframe, id)) continue;
      const Landmark& landmark = *map_.find(id);
      if (!map_.find(landmark.host)) continue;
      const SE3 motion = pose(keyframe.id) * pose(landmark.host).inverse();
      const Linearized at = linearize(rig_, motion, landmark.bearing, landmark.inverse_depth, {0, 0, 0});
      if (!at.in_front) continue;
      for (const Sighting& sighting : keyframe.sightings)
        consider(keyframe, table, id, descriptor, at.residual, sighting);
    }
  }

  void consider(const Keyframe& keyframe, const SightingTable& table, LandmarkId id,
                const Descriptor& descriptor, const Eigen::Vector3d& predicted, const Sighting& sighting) {
    const Eigen::Vector3d off = predicted - sighting.measured;
    if (off.head<2>().norm() > options_.radius || older_.contains(sighting.landmark)) return;
    if (sighting.inverse_sigma.z() > 0 &&
        std::abs(off.z()) > kDisparityFloor + kDisparitySigmas / sighting.inverse_sigma.z())
      return;
    const int feature = table.feature(sighting);
    if (feature < 0) return;
    const int distance = hamming(descriptor, keyframe.features->descriptors[feature]);
    if (distance <= options_.max_distance) duplicates_.push_back({distance, id, sighting.landmark});
  }

  // Verification matched features; where those were landmarks, they are known to be the same.
  void add_pairs() {
    const Keyframe& newer = *map_.find(closure_.edge.newer);
    if (!newer.features) return;
    const SightingTable of_newer(newer);
    std::map<KeyframeId, SightingTable> tables;
    for (const LoopClosure::Pair& pair : closure_.pairs) {
      const Keyframe* seen_by = map_.find(pair.seen_by);
      if (!seen_by || pair.feature < 0 || pair.feature >= static_cast<int>(newer.features->size())) continue;
      const auto table = tables.try_emplace(pair.seen_by, *seen_by).first;
      const LandmarkId kept = table->second.landmark(pair.seen_at.x(), pair.seen_at.y());
      if (!kept.valid() || find_sighting(newer, kept)) continue;
      const Keypoint& at = newer.features->keypoints[pair.feature];
      const LandmarkId gone = at.octave == 0 ? of_newer.landmark(at.x, at.y) : LandmarkId{};
      if (!gone.valid())
        add_sighting(newer, kept, at);
      else if (!older_.contains(gone))
        duplicates_.push_back({0, kept, gone});
    }
  }

  void add_sighting(const Keyframe& keyframe, LandmarkId landmark, const Keypoint& at) {
    const double level = std::pow(keyframe.features->level_scale, at.octave);
    const double sigma = std::hypot(kFusedSigma, options_.position_sigma * level);
    correction_.sightings.push_back({keyframe.id, {landmark, {at.x, at.y, 0}, {1 / sigma, 1 / sigma, 0}, 1}});
  }

  const Map& map_;
  const StereoRig& rig_;
  const LoopClosure& closure_;
  const FusionOptions& options_;
  MapCorrection& correction_;
  std::map<KeyframeId, SE3> pose_;
  std::map<LandmarkId, Descriptor> older_;
  std::vector<Duplicate> duplicates_;
};

}  // namespace

void fuse_across(const Map& map, const StereoRig& rig, const LoopClosure& closure,
                 const FusionOptions& options, MapCorrection& correction) {
  if (!map.find(closure.edge.older) || !map.find(closure.edge.newer)) return;
  Fusion(map, rig, closure, options, correction).run();
}

}  // namespace spslam
