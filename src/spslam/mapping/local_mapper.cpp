// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/mapping/local_mapper.h"

#include "spslam/map/keyframe_image.h"

namespace spslam {
namespace {

// The tracker counts landmarks up from where a map ends and does not ask anybody. Those made here have ids
// that it does not reach: from the next multiple of 2^40 on.
LandmarkId first_own_id(const Map& map) {
  constexpr std::int64_t kBlock = std::int64_t{1} << 40, kBlocks = std::int64_t{1} << 22;
  const std::int64_t last = map.landmarks().empty() ? 0 : map.landmarks().rbegin()->first.value;
  const std::int64_t block = last / kBlock + 1;
  return block < kBlocks ? LandmarkId{block * kBlock} : LandmarkId{};
}

}  // namespace

LocalMapper::LocalMapper(const StereoRig& rig, const OrbOptions& orb, const LocalMapperOptions& options,
                         Map map)
    : rig_(rig),
      options_(options),
      extractor_(orb),
      map_(std::move(map)),
      next_landmark_(first_own_id(map_)) {
  rig.check();
  check_options(options);
}

MappingResult LocalMapper::insert(KeyframeProposal proposal, const std::function<bool()>& stop) {
  MappingResult result;
  result.keyframe = proposal.keyframe.id;
  add(std::move(proposal));
  result.retriangulated = retriangulate(map_, rig_, result.keyframe, options_.retriangulation);  // Figure 7
  adjust(stop, result);                                                                          // 3.2.2
  map_.set_features(result.keyframe,
                    describe(map_, *map_.find(result.keyframe), extractor_, options_.features));
  if (const Keyframe& keyframe = *map_.find(result.keyframe);
      options_.features.image_quality > 0 && !keyframe.left.empty())
    map_.set_image(keyframe.id, compress(keyframe.left.level(0), options_.features.image_quality));
  result.triangulated = add_landmarks_between(map_, rig_, result.keyframe, extractor_.options().scale,
                                              options_.triangulation, next_landmark_);
  result.fused = fuse_duplicates(map_, rig_, result.keyframe, options_.duplicates);
  result.culled_landmarks = cull_landmarks(map_, result.keyframe, options_.culling);
  result.culled = cull_keyframes(map_, result.keyframe, options_.culling);
  result.view = view(result.keyframe);
  return result;
}

void LocalMapper::add(KeyframeProposal proposal) {
  for (Landmark& landmark : proposal.new_landmarks) map_.add(std::move(landmark));
  for (const Landmark& landmark : proposal.known_landmarks) map_.update(landmark);
  for (const LandmarkId moving : proposal.moving_landmarks)
    if (const LandmarkId id = map_.resolve(moving); map_.find(id)) map_.erase(id);
  // The previous keyframe may have been corrected since the tracker measured from it.
  if (const auto previous = map_.camera_from_world(proposal.previous))
    proposal.keyframe.camera_from_world = (proposal.camera_from_previous * *previous).normalized();
  with_images_.push_back(proposal.keyframe.id);
  map_.add(std::move(proposal.keyframe));
}

void LocalMapper::adjust(const std::function<bool()>& stop, MappingResult& result) {
  if (!options_.adjustment.enabled) return;
  AdjustmentProblem local = copy_neighbourhood(map_, rig_, result.keyframe, options_.adjustment);
  result.adjustment = solve(local.problem, options_.adjustment.solver, false, stop);
  if (result.adjustment.status == SolveStatus::kFailed) return;
  write_back(local, map_);
  if (result.adjustment.status == SolveStatus::kStopped) return;  // nobody knows yet who is wrong
  result.outliers = erase_outliers(local, options_.adjustment.outlier_sigmas, map_);
}

LocalMapView LocalMapper::correct(const std::function<void(Map&)>& write) {
  write(map_);
  LocalMapView out = view(map_.keyframes().rbegin()->first);
  out.corrected = true;
  return out;
}

LocalMapView LocalMapper::view(KeyframeId newest) {
  std::vector<KeyframeId> ids = {newest};
  for (const Covisible& other : map_.covisible(newest))
    if (static_cast<int>(ids.size()) < options_.view_keyframes) ids.push_back(other.id);
  std::sort(ids.begin(), ids.end());
  std::erase_if(with_images_, [&](KeyframeId id) {
    const bool needed = std::binary_search(ids.begin(), ids.end(), id);
    if (!needed) map_.drop_pyramid(id);
    return !needed;
  });
  LocalMapView out;
  out.revision = ++revision_;
  out.corrected = options_.adjustment.enabled || options_.retriangulation.enabled;
  for (const KeyframeId id : ids) {
    const Keyframe& keyframe = *map_.find(id);
    out.keyframes.push_back(
        {id, keyframe.frame, keyframe.timestamp, keyframe.camera_from_world, keyframe.left});
    for (const Sighting& sighting : keyframe.sightings)
      if (const Landmark& landmark = *map_.find(sighting.landmark); landmark.host == id)
        out.landmarks.push_back(landmark);
  }
  std::sort(out.landmarks.begin(), out.landmarks.end(),
            [](const Landmark& a, const Landmark& b) { return a.id < b.id; });
  return out;
}

}  // namespace spslam
