// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/odometry/frame_problem.h"

#include <Eigen/Cholesky>

namespace spslam {
namespace {

// A Problem under construction, with the places of the map's parts in it.
class ProblemBuilder {
 public:
  ProblemBuilder(const ActiveMap& map, std::size_t landmarks)
      : map_(map), place_of_(map.landmarks.size(), -1) {
    problem_.rig = map.rig;
    problem_.disparity_offset = map.disparity_offset;
    problem_.landmarks.reserve(landmarks);
  }

  int add_pose(const SE3& camera_from_world, bool fixed) {
    problem_.poses.push_back({camera_from_world, fixed});
    return static_cast<int>(problem_.poses.size()) - 1;
  }
  void set_place(KeyframeId id, int pose) { place_of_host_[id] = pose; }

  bool has_place(KeyframeId id) const { return place_of_host_.contains(id); }

  // The place of landmark i of the map; its host becomes a fixed pose if it is not one of the free ones.
  int landmark(int i, bool from_prior) {
    if (place_of_[i] >= 0) return place_of_[i];
    const ActiveLandmark& active = map_.landmarks[i];
    LandmarkVariable variable;
    variable.host = host(active.landmark.host);
    variable.bearing = active.landmark.bearing;
    variable.inverse_depth = active.landmark.inverse_depth;
    variable.prior_inverse_depth = from_prior ? active.prior_inverse_depth : active.landmark.inverse_depth;
    variable.prior_information = from_prior ? active.prior_information : active.landmark.information;
    problem_.landmarks.push_back(variable);
    return place_of_[i] = static_cast<int>(problem_.landmarks.size()) - 1;
  }
  void observe(int landmark, int pose, const Sighting& sighting) {
    problem_.observations.push_back(
        {landmark, pose, sighting.measured, sighting.inverse_sigma, sighting.weight});
  }
  // Which landmark of the map each of the problem's is.
  const std::vector<int>& places() const { return place_of_; }
  Problem& finish() {
    std::stable_sort(problem_.observations.begin(), problem_.observations.end(),
                     [](const Observation& a, const Observation& b) { return a.landmark < b.landmark; });
    return problem_;
  }

 private:
  int host(KeyframeId id) {
    const auto [it, is_new] = place_of_host_.try_emplace(id, -1);
    if (is_new) it->second = add_pose(map_.hosts.at(id).camera_from_world, true);
    return it->second;
  }

  const ActiveMap& map_;
  std::vector<int> place_of_;
  std::map<KeyframeId, int> place_of_host_;
  Problem problem_;
};

MotionEstimate newest_estimate(const SolveSummary& summary, const SE3& pose) {
  MotionEstimate estimate;
  estimate.camera_from_world = pose;
  estimate.cost = summary.final_cost;
  const Eigen::Index n = summary.covariance.rows();
  estimate.solved = summary.status != SolveStatus::kFailed && pose.is_finite() && n >= 6;
  if (n >= 6) estimate.covariance = summary.covariance.bottomRightCorner<6, 6>();
  estimate.solved = estimate.solved && estimate.covariance.allFinite();
  return estimate;
}

constexpr int kEnoughProven = 40;  // sightings, to do without those of landmarks on trial

// Which landmarks of the map may say something of the motion, by what the newest frame saw.
std::vector<char> usable_landmarks(const ActiveMap& map, const std::vector<Sighting>& newest) {
  std::vector<char> usable(map.landmarks.size());
  for (std::size_t i = 0; i < usable.size(); ++i) usable[i] = !map.landmarks[i].on_trial;
  const auto is_usable = [&](const Sighting& sighting) {
    const int i = map.index_of(sighting.landmark);
    return i >= 0 && usable[i];
  };
  if (std::count_if(newest.begin(), newest.end(), is_usable) < kEnoughProven)
    std::fill(usable.begin(), usable.end(), 1);
  return usable;
}

enum class Hosts { kAll, kOfWindow };

// All frames of the window, the first one fixed, and what they saw of landmarks with a host among `hosts`.
void add_window(const ActiveMap& map, Hosts hosts, ProblemBuilder& builder) {
  std::size_t first = 0;
  // Frames before the window's first host see none of its landmarks: nothing would hold their poses.
  while (hosts == Hosts::kOfWindow && first < map.window.size() && !map.window[first].keyframe.valid())
    ++first;
  std::vector<int> poses(map.window.size(), -1);
  for (std::size_t f = first; f < map.window.size(); ++f) {
    poses[f] = builder.add_pose(map.window[f].camera_from_world, f == first);
    if (map.window[f].keyframe.valid()) builder.set_place(map.window[f].keyframe, poses[f]);
  }
  if (map.window.empty()) return;
  const std::vector<char> usable = usable_landmarks(map, map.window.back().sightings);
  for (std::size_t f = first; f < map.window.size(); ++f)
    for (const Sighting& sighting : map.window[f].sightings)
      if (const int i = map.index_of(sighting.landmark); i >= 0 && usable[i])
        if (hosts == Hosts::kAll || builder.has_place(map.landmarks[i].landmark.host))
          builder.observe(builder.landmark(i, true), poses[f], sighting);
}

}  // namespace

MotionEstimate estimate_motion(const ActiveMap& map, const std::vector<Sighting>& sightings, const SE3& start,
                               const SolverOptions& options) {
  ProblemBuilder builder(map, sightings.size());
  const int pose = builder.add_pose(start, false);
  const std::vector<char> usable = usable_landmarks(map, sightings);
  for (const Sighting& sighting : sightings)
    if (const int i = map.index_of(sighting.landmark); i >= 0 && usable[i])
      builder.observe(builder.landmark(i, false), pose, sighting);
  Problem& problem = builder.finish();
  if (problem.observations.size() < 3) return {};
  const SolveSummary summary = solve(problem, options, true);
  return newest_estimate(summary, problem.poses[pose].camera_from_world);
}

bool refine_window(ActiveMap& map, const SolverOptions& options) {
  ProblemBuilder builder(map, map.landmarks.size());
  add_window(map, Hosts::kAll, builder);
  Problem& problem = builder.finish();
  if (problem.observations.size() < 3) return false;
  const SolveSummary summary = solve(problem, options);
  bool solved = summary.status != SolveStatus::kFailed;
  for (const PoseVariable& pose : problem.poses) solved = solved && pose.camera_from_world.is_finite();
  if (!solved) return false;
  for (std::size_t f = 0; f < map.window.size(); ++f) {
    WindowFrame& frame = map.window[f];
    frame.camera_from_world = problem.poses[f].camera_from_world;
    if (frame.keyframe.valid()) map.hosts.at(frame.keyframe).camera_from_world = frame.camera_from_world;
  }
  for (std::size_t i = 0; i < map.landmarks.size(); ++i)
    if (const int place = builder.places()[i]; place >= 0)
      map.landmarks[i].landmark.inverse_depth = problem.landmarks[place].inverse_depth;
  return true;
}

SolveSummary solve_for_offset(const ActiveMap& map, const SolverOptions& options, DisparityOffset& offset) {
  ProblemBuilder builder(map, map.landmarks.size());
  // Poses of hosts outside of the window are fixed, at the scale that the offset of their time gave them.
  add_window(map, Hosts::kOfWindow, builder);
  Problem& problem = builder.finish();
  problem.disparity_offset = offset;
  // What earlier frames said of the inverse depths, they said under the offset of their time.
  for (LandmarkVariable& landmark : problem.landmarks) landmark.prior_information = 0;
  if (problem.observations.size() < 3) return {};
  SolveSummary summary = solve(problem, options, true);
  offset = problem.disparity_offset;
  return summary;
}

}  // namespace spslam
