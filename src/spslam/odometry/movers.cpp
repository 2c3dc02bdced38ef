// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/odometry/movers.h"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace spslam {
namespace {

constexpr double kHostSigma = 0.1;   // px; in its host a patch is where it is by definition
constexpr double kRidge = 1e-9;      // of the mean diagonal: what is not observed at all stays solvable
constexpr int kMaxRounds = 8;        // Gauss-Newton steps of the standing point
constexpr double kConverged = 1e-2;  // chi-square; a step that promises less is the last

// A landmark's sightings in the window, oldest first, each with its frame.
struct TrackedSighting {
  const WindowFrame* frame;
  const Sighting* sighting;
};
using Track = std::vector<TrackedSighting>;

// Normal equations of a point (x, y and inverse depth in the first camera that saw it) and its velocity
// (times the inverse depth, per second, in that camera's axes) at velocity zero.
struct TrackEquations {
  Matrix6d information = Matrix6d::Zero();
  Vector6d vector = Vector6d::Zero();
  double cost = 0;     // chi-square
  int components = 0;  // measured
};

Track track_of(const ActiveMap& map, LandmarkId landmark) {
  Track track;
  for (const WindowFrame& frame : map.window) {
    const auto it = std::lower_bound(frame.sightings.begin(), frame.sightings.end(), landmark,
                                     [](const Sighting& a, LandmarkId b) { return a.landmark < b; });
    if (it != frame.sightings.end() && it->landmark == landmark) track.push_back({&frame, &*it});
  }
  return track;
}

SE3 motion_since_first(const Track& track, const WindowFrame& frame) {
  return frame.camera_from_world * track.front().frame->camera_from_world.inverse();
}

// Nothing if the point is behind a camera.
std::optional<TrackEquations> equations(const ActiveMap& map, const Track& track,
                                        const Eigen::Vector3d& point) {
  TrackEquations out;
  for (const auto& [frame, sighting] : track) {
    const SE3 motion = motion_since_first(track, *frame);
    Linearized at = linearize(map.rig, motion, {point.x(), point.y(), 1}, point.z(), sighting->measured);
    if (!at.in_front) return std::nullopt;
    at.residual.z() += map.disparity_offset.at(map.rig, sighting->measured.x(), sighting->measured.y());
    Eigen::Vector3d inverse_sigma = sighting->inverse_sigma;
    if (inverse_sigma.x() == 0) inverse_sigma.head<2>().setConstant(1 / kHostSigma);
    const Eigen::Matrix3d by_position = at.by_point * motion.rotation;
    Eigen::Matrix<double, 3, 6> jacobian;
    jacobian << by_position.leftCols<2>(), at.by_inverse_depth,
        (frame->timestamp - track.front().frame->timestamp) * by_position;
    jacobian = inverse_sigma.asDiagonal() * jacobian;
    const Eigen::Vector3d residual = inverse_sigma.cwiseProduct(at.residual);
    out.information += jacobian.transpose() * jacobian;
    out.vector -= jacobian.transpose() * residual;
    out.cost += residual.squaredNorm();
    out.components += static_cast<int>((inverse_sigma.array() > 0).count());
  }
  return out;
}

// Step to the minimum in the first `n` unknowns.
Eigen::VectorXd step(const TrackEquations& e, int n) {
  Eigen::MatrixXd information = e.information.topLeftCorner(n, n);
  information.diagonal().array() += kRidge * information.trace() / n;
  return information.ldlt().solve(e.vector.head(n));
}

// By the first disparity that was measured; nothing without two of them.
std::optional<Eigen::Vector3d> first_guess(const ActiveMap& map, const Track& track) {
  const auto has_disparity = [](const TrackedSighting& t) { return t.sighting->inverse_sigma.z() > 0; };
  if (std::count_if(track.begin(), track.end(), has_disparity) < 2) return std::nullopt;
  const Eigen::Vector3d& z = std::find_if(track.begin(), track.end(), has_disparity)->sighting->measured;
  const Eigen::Vector3d& first = track.front().sighting->measured;
  Eigen::Vector3d point = map.rig.bearing(first.x(), first.y());
  point.z() =
      (z.z() - map.disparity_offset.at(map.rig, z.x(), z.y())) / map.rig.disparity_per_inverse_depth();
  return point;
}

// By which alignment is worse than its noise says: patches warp as they come nearer and pass by. The way that
// parallax moves the standing point is where it ends less where a point at infinity would.
double warp_variance(const ActiveMap& map, const Track& track, const Eigen::Vector3d& point, double warp) {
  const SE3 motion = motion_since_first(track, *track.back().frame);
  const Eigen::Vector3d turned = motion.rotation * Eigen::Vector3d(point.x(), point.y(), 1);
  const double moved =
      (map.rig.project(turned + point.z() * motion.translation) - map.rig.project(turned)).norm();
  const double error = warp * moved * track.back().sighting->inverse_sigma.x();
  return 1 + error * error;
}

}  // namespace

std::optional<double> gain_of_moving(const ActiveMap& map, LandmarkId landmark, const MoverOptions& options) {
  const Track track = track_of(map, landmark);
  if (track.empty() || static_cast<int>(track.size()) < options.min_sightings ||
      track.back().frame != &map.window.back())
    return std::nullopt;
  std::optional<Eigen::Vector3d> point = first_guess(map, track);
  if (!point) return std::nullopt;
  std::optional<TrackEquations> e = equations(map, track, *point);
  double promised = 2 * kConverged;
  for (int round = 0; round < kMaxRounds && e && promised > kConverged; ++round) {
    const Eigen::Vector3d change = step(*e, 3);
    promised = e->vector.head<3>().dot(change);
    *point += change;
    e = equations(map, track, *point);
  }
  if (!e || e->components <= 6) return std::nullopt;
  const double standing = e->cost - e->vector.head<3>().dot(step(*e, 3));
  const double moving = e->cost - e->vector.dot(step(*e, 6));
  const double gain = standing - moving;
  // Patches that do not even follow a velocity to within their noise weigh for what they are.
  const double variance = std::max(1.0, moving / (e->components - 6));
  if (!std::isfinite(gain)) return std::nullopt;
  return gain / (variance * warp_variance(map, track, *point, options.warp));
}

std::vector<int> find_movers(const ActiveMap& map, const MoverOptions& options) {
  std::vector<char> moves(map.landmarks.size(), 0);
  tbb::parallel_for(std::size_t{0}, moves.size(), [&](std::size_t i) {
    moves[i] = gain_of_moving(map, map.landmarks[i].landmark.id, options).value_or(0) > options.max_gain;
  });
  std::vector<int> out;
  for (std::size_t i = 0; i < moves.size(); ++i)
    if (moves[i]) out.push_back(static_cast<int>(i));
  return out;
}

}  // namespace spslam
