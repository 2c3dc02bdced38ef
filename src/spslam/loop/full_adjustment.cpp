// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/loop/full_adjustment.h"

namespace spslam {

AdjustmentProblem copy_full_problem(const Map& map, const StereoRig& rig,
                                    const FullAdjustmentOptions& options) {
  const auto count = static_cast<int>(map.keyframes().size());
  if (!options.enabled || count < 2 || count > options.max_keyframes) return {};
  std::vector<KeyframeId> all;
  for (const auto& [id, keyframe] : map.keyframes()) all.push_back(id);
  AdjustmentProblem out = copy_problem(map, rig, all, all, true);
  out.problem.poses.front().fixed = true;
  return out;
}

MapCorrection solve_full_problem(AdjustmentProblem problem, const FullAdjustmentOptions& options,
                                 const std::function<bool()>& stop) {
  if (problem.keyframes.empty()) return {};
  const SolveSummary summary = solve(problem.problem, options.solver, false, stop);
  if (summary.status == SolveStatus::kFailed || summary.status == SolveStatus::kStopped) return {};
  MapCorrection out;
  for (std::size_t i = 0; i < problem.keyframes.size(); ++i)
    out.camera_from_world.emplace_back(problem.keyframes[i], problem.problem.poses[i].camera_from_world);
  for (std::size_t i = 0; i < problem.landmarks.size(); ++i) {
    const LandmarkVariable& solved = problem.problem.landmarks[i];
    out.inverse_depths.push_back(
        {problem.landmarks[i], problem.keyframes[solved.host], solved.inverse_depth});
  }
  return out;
}

}  // namespace spslam
