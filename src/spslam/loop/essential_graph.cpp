// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/loop/essential_graph.h"

#include <Eigen/LU>
#include <set>
#include <stdexcept>

namespace spslam {
namespace {

constexpr double kLeastSigma = 0.003;      // m, of any edge
constexpr double kDeadReckoned = 1;        // m, of an edge that nothing seen supports, and as much a metre
constexpr double kDeadReckonedTurn = 0.2;  // rad
constexpr double kOldLoopSigma = 0.1;      // m, of loops closed before: their covariance was not kept
constexpr double kOldLoopTurn = 0.005;     // rad

struct Shared {
  int count = 0;
  double disparity = 0;  // px, as it weighs in the translation: by its square
};

// The landmarks that both saw, by their disparities in the first.
Shared shared_landmarks(const Map& map, const StereoRig& rig, const Keyframe& first, const Keyframe& second) {
  Shared out;
  double sum = 0, squares = 0;
  for (const Sighting& sighting : first.sightings) {
    if (!find_sighting(second, sighting.landmark)) continue;
    const Landmark& landmark = *map.find(sighting.landmark);
    const Keyframe* host = map.find(landmark.host);
    if (!host) continue;
    ++out.count;
    const SE3 motion = first.camera_from_world * host->camera_from_world.inverse();
    const double z = (motion.rotation * landmark.bearing + landmark.inverse_depth * motion.translation).z();
    if (!(z > 1e-3)) continue;
    const double d = std::max(0.0, rig.disparity_per_inverse_depth() * landmark.inverse_depth / z);
    sum += d, squares += d * d;
  }
  out.disparity = sum > 0 ? squares / sum : 0;
  return out;
}

Matrix6d covariance_of(const Eigen::Matrix3d& translation, double turn) {
  Matrix6d out = Matrix6d::Zero();
  out.topLeftCorner<3, 3>() = translation;
  out.bottomRightCorner<3, 3>() = Eigen::Matrix3d::Identity() * (turn * turn);
  return out;
}

Matrix6d diagonal_covariance(double sigma, double turn) {
  return covariance_of(Eigen::Matrix3d::Identity() * (sigma * sigma), turn);
}

class GraphBuilder {
 public:
  GraphBuilder(const Map& map, const StereoRig& rig, const EssentialGraphOptions& options)
      : map_(map), rig_(rig), options_(options) {
    for (const auto& [id, keyframe] : map.keyframes()) {
      place_[id] = static_cast<int>(out_.keyframes.size());
      out_.keyframes.push_back(id);
      out_.graph.poses.push_back({keyframe.camera_from_world, out_.graph.poses.empty()});
    }
  }

  void add_odometry() {
    for (const auto& [id, keyframe] : map_.keyframes()) {
      if (const Keyframe* parent = map_.find(keyframe.parent)) add_odometry(*parent, keyframe);
      for (const Covisible& other : map_.covisible(id, options_.min_shared))
        if (other.id < id) add_odometry(*map_.find(other.id), keyframe);
    }
  }
  // In the older's camera lengths of time gone by may have had another scale; their covariance was not kept.
  void add_old_loops() {
    for (const LoopEdge& loop : map_.loops())
      if (place_.contains(loop.older) && place_.contains(loop.newer))
        add_edge(loop.older, loop.newer, loop.newer_from_older,
                 diagonal_covariance(kOldLoopSigma, kOldLoopTurn));
  }
  void add_closure(const LoopClosure& closure) {
    if (!place_.contains(closure.edge.older) || !place_.contains(closure.edge.newer))
      throw std::invalid_argument("a loop between keyframes that the map does not have");
    out_.edge = closure.edge;
    const Matrix6d least = diagonal_covariance(kLeastSigma, 1e-4);
    add_edge(closure.edge.older, closure.edge.newer, closure.edge.newer_from_older,
             closure.covariance + least);
  }
  EssentialGraph finish() { return std::move(out_); }

 private:
  void add_odometry(const Keyframe& first, const Keyframe& second) {
    if (!connected_.insert({first.id, second.id}).second) return;
    add_edge(first.id, second.id, second.camera_from_world * first.camera_from_world.inverse(),
             odometry_covariance(map_, rig_, first, second, options_));
  }
  void add_edge(KeyframeId i, KeyframeId j, const SE3& motion, const Matrix6d& covariance) {
    out_.graph.edges.push_back({place_.at(i), place_.at(j), motion, covariance.inverse(), false});
  }

  const Map& map_;
  const StereoRig& rig_;
  const EssentialGraphOptions& options_;
  EssentialGraph out_;
  std::map<KeyframeId, int> place_;
  std::set<std::pair<KeyframeId, KeyframeId>> connected_;
};

}  // namespace

Matrix6d odometry_covariance(const Map& map, const StereoRig& rig, const Keyframe& first,
                             const Keyframe& second, const EssentialGraphOptions& options) {
  const Eigen::Vector3d t = (second.camera_from_world * first.camera_from_world.inverse()).translation;
  const double length = t.norm();
  const Shared shared = shared_landmarks(map, rig, first, second);
  if (shared.count < options.least_connected)
    return diagonal_covariance(kDeadReckoned * (1 + length), kDeadReckonedTurn);
  const double share = std::clamp(options.disparity_error / std::max(shared.disparity, 1e-3),
                                  options.least_share, options.greatest_share);
  const double across = options.across_share * length;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity() * (kLeastSigma * kLeastSigma + across * across);
  covariance += share * share * t * t.transpose();
  const double turn = std::hypot(options.rotation_sigma, options.rotation_per_metre * std::sqrt(length));
  return covariance_of(covariance, turn * M_PI / 180);
}

EssentialGraph essential_graph(const Map& map, const StereoRig& rig, const LoopClosure& closure,
                               const EssentialGraphOptions& options) {
  GraphBuilder builder(map, rig, options);
  builder.add_odometry();
  builder.add_old_loops();
  builder.add_closure(closure);
  return builder.finish();
}

MapCorrection solve_essential_graph(EssentialGraph graph, const EssentialGraphOptions& options,
                                    const std::function<bool()>& stop) {
  const SolveSummary summary = solve(graph.graph, options.solver, stop);
  if (summary.status == SolveStatus::kFailed || summary.status == SolveStatus::kStopped) return {};
  MapCorrection out;
  for (std::size_t i = 0; i < graph.keyframes.size(); ++i)
    out.camera_from_world.emplace_back(graph.keyframes[i], graph.graph.poses[i].camera_from_world);
  out.edge = graph.edge;
  return out;
}

}  // namespace spslam
