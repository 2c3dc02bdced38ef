// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/loop/relocalizer.h"

namespace spslam {
namespace {

constexpr double kAgreementSigmas = 5;
constexpr double kAgreementFloor = 0.3;       // m; the map may have drifted between its keyframes
constexpr double kAgreementTurn = M_PI / 60;  // rad

bool agree(const Relocalized& a, const Relocalized& b) {
  const SE3 off = a.camera_from_world * b.camera_from_world.inverse();
  const double variance =
      a.covariance.topLeftCorner<3, 3>().trace() + b.covariance.topLeftCorner<3, 3>().trace();
  const double distance =
      (a.camera_from_world.inverse().translation - b.camera_from_world.inverse().translation).norm();
  return distance <= kAgreementFloor + kAgreementSigmas * std::sqrt(variance) &&
         so3_log(off.rotation).norm() <= kAgreementTurn;
}

}  // namespace

RelocalizationAttempt relocalize(const KeyframeFeatures& query, const Map& map, const StereoRig& rig,
                                 const KeyframeIndex& index, const RelocalizationOptions& options,
                                 const std::set<KeyframeId>& exclude, std::span<const KeyframeId> guesses) {
  RelocalizationAttempt out;
  bool contradiction = false;
  const auto compare = [&](KeyframeId id, double score) {
    const Place place = place_of(map, rig, id, options.verification.neighbours);
    Verification verified = verify(place, query, rig, index.vocabulary(), options.verification);
    verified.pairs.clear();
    if (verified.accepted()) {
      const SE3 pose = (verified.newer_from_older * map.find(id)->camera_from_world).normalized();
      const Relocalized here{pose, verified.covariance, id, verified.inliers};
      if (out.found && !agree(*out.found, here)) contradiction = true;
      if (!out.found || here.inliers > out.found->inliers) out.found = here;
    }
    out.tried.push_back({id, score, std::move(verified)});
  };
  for (const KeyframeId id : guesses)
    if (map.find(id)) compare(id, 0);
  if (!out.found) {
    int candidates = 0;
    for (const CandidateGroup& group : group_candidates(index.query(query, exclude), map))
      if (candidates++ < options.candidates) compare(group.best, group.score);
  }
  if (contradiction) out.found.reset();
  return out;
}

}  // namespace spslam
