// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/loop/relocalizer.h"

#include <spdlog/fmt/fmt.h>

namespace spslam {
namespace {

constexpr double kSamePlaceSigmas = 5;
constexpr double kSamePlaceFloor = 0.3;       // m; the map may have drifted between its keyframes
constexpr double kSamePlaceTurn = M_PI / 60;  // rad

bool agree(const Relocalized& a, const Relocalized& b) {
  const SE3 off = a.camera_from_world * b.camera_from_world.inverse();
  const double variance =
      a.covariance.topLeftCorner<3, 3>().trace() + b.covariance.topLeftCorner<3, 3>().trace();
  const double distance = distance_of_centres(a.camera_from_world, b.camera_from_world);
  return distance <= kSamePlaceFloor + kSamePlaceSigmas * std::sqrt(variance) &&
         so3_log(off.rotation).norm() <= kSamePlaceTurn;
}

// By patches, where there are any: what was imprecise may be found then.
void make_precise(const AlignmentPyramid& left, const Map& map, const StereoRig& rig,
                  const RelocalizationOptions& options, const std::set<KeyframeId>& exclude,
                  RelocalizationAttempt& attempt) {
  std::optional<Relocalized>& known = attempt.found ? attempt.found : attempt.imprecise;
  if (!known) return;
  const std::vector<KeyframeId> place =
      keyframes_of_place(map, known->reference, options.patches.keyframes, exclude);
  const auto precise = pose_by_patches(map, rig, left, known->camera_from_world, place, options.patches);
  if (!precise) return;
  known->camera_from_world = precise->camera_from_world, known->covariance = precise->covariance;
  if (attempt.found || precise->position_sigma() > options.verification.max_translation_sigma) return;
  attempt.found = attempt.imprecise;
  attempt.imprecise.reset();
}

}  // namespace

RelocalizationAttempt relocalize(const SeenFrame& query, const Map& map, const StereoRig& rig,
                                 const KeyframeIndex& index, const RelocalizationOptions& options,
                                 const std::set<KeyframeId>& exclude, std::span<const KeyframeId> guesses) {
  RelocalizationAttempt out;
  bool contradiction = false;
  const auto compare = [&](KeyframeId id, double score) {
    const Place place = place_of(map, rig, id, options.verification.neighbours);
    Verification verified = verify(place, query.features, rig, index.vocabulary(), options.verification);
    verified.pairs.clear();
    if (verified.accepted() || verified.stage == VerificationStage::kUncertain) {
      const SE3 pose = (verified.newer_from_older * map.find(id)->camera_from_world).normalized();
      const Relocalized here{pose, verified.covariance, id, verified.inliers};
      std::optional<Relocalized>& best = verified.accepted() ? out.found : out.imprecise;
      if (best && !agree(*best, here)) contradiction = true;
      if (!best || here.inliers > best->inliers) best = here;
    }
    out.tried.push_back({id, score, std::move(verified)});
  };
  for (const KeyframeId id : guesses)
    if (map.find(id)) compare(id, 0);
  if (!out.found) {
    int candidates = 0;
    for (const CandidateGroup& group : group_candidates(index.query(query.features, exclude), map))
      if (candidates++ < options.candidates) compare(group.best, group.score);
  }
  if (contradiction || out.found) out.imprecise.reset();
  if (contradiction) out.found.reset();
  make_precise(query.left, map, rig, options, exclude, out);
  return out;
}

std::string describe_attempt(const RelocalizationAttempt& attempt) {
  std::string text;
  for (const RelocalizationAttempt::Tried& tried : attempt.tried) {
    const Verification& v = tried.verification;
    text += fmt::format("{}keyframe {}: {} ({} matches, {} of one motion, {} inliers, {:.2f} m, {:.2f} deg)",
                        text.empty() ? "" : "; ", tried.keyframe.value,
                        option_names(v.stage)[static_cast<std::size_t>(v.stage)], v.matches, v.consensus,
                        v.inliers, v.translation_sigma, v.rotation_sigma);
  }
  return text.empty() ? "no keyframe looks like it" : text;
}

}  // namespace spslam
