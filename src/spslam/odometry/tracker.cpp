// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/odometry/tracker.h"

#include "spslam/odometry/follow.h"
#include "spslam/odometry/new_landmarks.h"

namespace spslam {
namespace {

constexpr double kCertain = 1e-12;  // m^2 and rad^2: where the world begins
constexpr int kPreciseTries = 3;    // after which a place that does not tell the position will do

// Indices into map.landmarks, spread evenly over all of them: every n-th first, then the others.
std::vector<int> scouts_first(std::size_t count, std::size_t scouts) {
  std::vector<int> order;
  const std::size_t stride = scouts == 0 ? count + 1 : (count + scouts - 1) / scouts;
  for (std::size_t i = 0; i < count; i += stride) order.push_back(static_cast<int>(i));
  for (std::size_t i = 0; i < count; ++i)
    if (i % stride != 0) order.push_back(static_cast<int>(i));
  return order;
}

int count_inliers(const ActiveMap& map, const std::vector<Sighting>& sightings, const SE3& pose,
                  double sigmas) {
  int inliers = 0;
  for (const Sighting& s : sightings) {
    const Landmark& landmark = map.landmarks[map.index_of(s.landmark)].landmark;
    const Linearized at = linearize(map, landmark, pose, s);
    // The inverse depth is known only so well: what it adds to the residual is forgiven.
    const double slack =
        landmark.information > 0 ? at.by_inverse_depth.head<2>().norm() / std::sqrt(landmark.information) : 0;
    const double limit = sigmas * (1 / s.inverse_sigma.x() + slack);
    inliers += at.in_front && at.residual.head<2>().norm() < limit;
  }
  return inliers;
}

}  // namespace

Tracker::Tracker(const StereoRig& rig, const TrackerOptions& options)
    : options_(options), front_end_(options), trials_(options.trial) {
  rig.check();
  check_options(options);
  map_.rig = rig;
}

TrackerOutput Tracker::track(const StereoFrame& pair) {
  TrackerOutput out;
  TrackResult& result = out.result;
  StageTimer timer(result.seconds);
  result.frame = {frames_++};
  result.timestamp = pair.timestamp;
  result.reason = FrontEnd::problem_of(pair, map_.rig);
  if (!result.reason.empty()) {
    coast(result.reason, result);
  } else {
    const Frame frame = front_end_.process(pair, result.frame);  // 3.1.1, 3.1.2
    timer.end(&StageTimes::front_end);
    // A window that ended with a loss is no beginning for another, and the map should know of it.
    if (status_ == TrackStatus::kLost) settle(0, out);
    if (status_ == TrackStatus::kInitializing || status_ == TrackStatus::kLost)
      begin(frame, result);
    else if (!measure_pose(frame, result, timer))
      coast(result.reason, result);  // 3.1.3, 3.1.4
    if (status_ == TrackStatus::kTracking) {
      WindowFrame& present = map_.window.back();
      if (!present.keyframe.valid()) {
        result.keyframe = policy_.decide(evidence(present), options_.keyframe);  // 3.2.1
        if (result.keyframe.insert()) make_keyframe(frame, present);
      }
      result.keyframe_id = present.keyframe;
    }
    if (describe_interval_ > 0 && result.frame.value % describe_interval_ == 0)
      out.seen = std::make_shared<const SeenFrame>(see(frame));
  }
  finish_frame(out);
  timer.end(&StageTimes::keyframe);
  return out;
}

bool Tracker::measure_pose(const Frame& frame, TrackResult& result, StageTimer& timer) {
  SE3 predicted = motion_.predict(frame.timestamp);
  std::vector<Sighting> sightings = find_landmarks(frame, predicted, result);
  timer.end(&StageTimes::follow);
  far_points_.weigh(map_, predicted, frame.id, options_.far, sightings);  // (8)
  const MotionEstimate motion =
      estimate_motion(map_, sightings, predicted, options_.motion);  // (6), (7), (9)
  timer.end(&StageTimes::motion);
  result.far_weight = far_points_.weight();
  if (!is_sound(motion, sightings, result)) return false;
  motion_covariance_ = motion.covariance;
  map_.window.push_back({frame.id, frame.timestamp, motion.camera_from_world, {}, std::move(sightings)});
  if (options_.window_frames > 1) refine_window(map_, options_.window);
  result.moving = let_movers_go();
  close_gap(frame.timestamp, map_.window.back().camera_from_world);
  motion_.add(frame.timestamp, map_.window.back().camera_from_world);
  status_ = TrackStatus::kTracking;
  if (options_.rig.estimate && ++frames_since_rig_check_ >= options_.window_frames &&
      options_.window_frames > 2) {
    frames_since_rig_check_ = 0;
    map_.disparity_offset = rig_monitor_.update(map_, options_.window, options_.rig);
  }
  timer.end(&StageTimes::window);
  return true;
}

// A few landmarks are sought widely and correct the prediction; the others are then where they are expected.
std::vector<Sighting> Tracker::find_landmarks(const Frame& frame, SE3& predicted, TrackResult& result) {
  const std::vector<int> order =
      scouts_first(map_.landmarks.size(), static_cast<std::size_t>(options_.follow.scouts));
  const std::size_t scouts = std::min(order.size(), static_cast<std::size_t>(options_.follow.scouts));
  const std::span<const int> first(order.data(), scouts), rest(order.data() + scouts, order.size() - scouts);
  result.followed = static_cast<int>(order.size());
  std::vector<Sighting> sightings;
  if (options_.follow.identity == Identity::kDescriptor) {
    sightings = follow_descriptors(map_, order, frame, predicted, options_);
  } else {
    sightings = follow_patches(map_, first, frame, predicted, options_.follow.scout_levels, options_);
    if (const MotionEstimate scouted = estimate_motion(map_, sightings, predicted, options_.motion);
        scouted.solved)
      predicted = scouted.camera_from_world;
    const std::vector<Sighting> others =
        follow_patches(map_, rest, frame, predicted, options_.follow.levels, options_);
    sightings.insert(sightings.end(), others.begin(), others.end());
  }
  std::sort(sightings.begin(), sightings.end(),
            [](const Sighting& a, const Sighting& b) { return a.landmark < b.landmark; });
  for (const Sighting& sighting : sightings) {
    const ActiveLandmark& active = map_.landmarks[map_.index_of(sighting.landmark)];
    ++(active.landmark.region == Region::kNear ? result.near : result.far);
    result.on_trial += active.on_trial;
    result.with_disparity += sighting.inverse_sigma.z() > 0;
  }
  return sightings;
}

bool Tracker::is_sound(const MotionEstimate& motion, const std::vector<Sighting>& sightings,
                       TrackResult& result) const {
  if (motion.solved)
    result.inliers = count_inliers(map_, sightings, motion.camera_from_world, options_.motion.loss_scale * 2);
  if (!motion.solved)
    result.reason = "no motion fits the " + std::to_string(sightings.size()) + " points found";
  else if (result.inliers < options_.state.min_inliers)
    result.reason = "only " + std::to_string(result.inliers) + " points agree with the motion";
  else if (motion.covariance.topLeftCorner<3, 3>().trace() >
           options_.state.max_covariance * options_.state.max_covariance)
    result.reason = "the points found do not determine the motion";
  return result.reason.empty();
}

SeenFrame Tracker::see(const Frame& frame) {
  return {describe(frame, map_.rig, map_.disparity_offset, front_end_, options_), frame.left};
}

// Where tracking begins: at the origin, or where the map knows the frame to be, or, after a loss in which
// that has failed often enough, where the last known velocity has carried. Nothing: not yet.
std::optional<UncertainPose> Tracker::starting_pose(const Frame& frame, TrackResult& result) {
  const bool was_lost = status_ == TrackStatus::kLost;
  if (!was_lost && !must_localize_) return UncertainPose{{}, kCertain * Matrix6d::Identity()};
  const auto reckoned = [&] {
    return UncertainPose{
        motion_.predict(frame.timestamp),
        motion_covariance_ + coasting_covariance(frame.timestamp - motion_.last_timestamp())};
  };
  if (relocalize_ && (must_localize_ || relocalizations_ < options_.state.relocalization_frames)) {
    ++relocalizations_;
    const std::optional<FoundPose> found = relocalize_(see(frame));
    if (found && found->precise) {
      result.reason = "found in the map";
      return found->pose;
    }
    if (found && was_lost && relocalizations_ > kPreciseTries &&
        squared_distance(reckoned(), found->pose) <= kPoseGate) {
      result.reason = "found in the map with dead reckoning";
      return fused(reckoned(), found->pose);
    }
    result.reason = "not recognized in the map";
    return std::nullopt;
  }
  result.reason = "begun anew where the last known velocity led";
  return reckoned();
}

void Tracker::continue_map(KeyframeId next_keyframe, LandmarkId next_landmark) {
  keyframes_ = next_keyframe.value;
  landmarks_ = next_landmark.value;
  must_localize_ = true;
}

// The first keyframe, or a new one after everything was lost.
void Tracker::begin(const Frame& frame, TrackResult& result) {
  const bool was_lost = status_ == TrackStatus::kLost;
  const std::optional<UncertainPose> start = starting_pose(frame, result);
  if (!start) {
    if (was_lost) coast(result.reason, result);
    return;
  }
  const SE3& pose = start->camera_from_world;
  for (ActiveLandmark& active : map_.landmarks) active.missed = options_.follow.max_missed + 1;
  WindowFrame present{frame.id, frame.timestamp, pose, {}, {}};
  make_keyframe(frame, present);
  if (static_cast<int>(present.sightings.size()) < options_.state.min_inliers) {
    result.reason =
        "only " + std::to_string(present.sightings.size()) + " points with a disparity to begin with";
    std::erase_if(map_.landmarks,
                  [&](const ActiveLandmark& a) { return a.landmark.host == present.keyframe; });
    map_.hosts.erase(present.keyframe);
    if (was_lost) coast(result.reason, result);
    return;
  }
  map_.window.push_back(std::move(present));
  close_gap(frame.timestamp, pose);
  motion_.restart(frame.timestamp, pose);
  motion_covariance_ = start->covariance;
  relocalizations_ = 0;
  status_ = TrackStatus::kTracking;
}

void Tracker::coast(const std::string& reason, TrackResult& result) {
  if (status_ == TrackStatus::kInitializing) return;
  const double time = result.timestamp - motion_.last_timestamp();
  if (status_ != TrackStatus::kLost)
    status_ = time <= options_.state.coast_time ? TrackStatus::kCoasting : TrackStatus::kLost;
  result.reason =
      status_ == TrackStatus::kLost ? "lost for " + std::to_string(time) + " s: " + reason : reason;
}

// Frames that the last velocity carried end where the measured one begins: what it was wrong by is spread
// over them evenly.
void Tracker::close_gap(double timestamp, const SE3& measured) {
  if (unsettled_.empty() || !unsettled_.back().in_open_gap) return;
  const double start = motion_.last_timestamp(), length = timestamp - start;
  const Vector6d off = (measured * motion_.predict(timestamp).inverse()).log();
  for (auto frame = unsettled_.rbegin(); frame != unsettled_.rend() && frame->in_open_gap; ++frame) {
    frame->camera_from_world =
        (SE3::exp(off * ((frame->timestamp - start) / length)) * frame->camera_from_world).normalized();
    frame->in_open_gap = false;
  }
}

// Of constant velocity after so many seconds, of a left perturbation.
Matrix6d Tracker::coasting_covariance(double seconds) const {
  const double half_square = 0.5 * seconds * seconds;
  Vector6d sigma;
  sigma.head<3>().setConstant(options_.state.coast_acceleration * half_square);
  sigma.tail<3>().setConstant(options_.state.coast_turn * half_square);
  return sigma.cwiseAbs2().asDiagonal();
}

void Tracker::finish_frame(TrackerOutput& out) {
  TrackResult& result = out.result;
  result.status = status_;
  if (status_ == TrackStatus::kInitializing) return;
  const bool measured = status_ == TrackStatus::kTracking;
  const SE3 pose = measured ? map_.window.back().camera_from_world : motion_.predict(result.timestamp);
  result.world_from_camera = pose.inverse();
  result.covariance = motion_covariance_;
  if (status_ == TrackStatus::kLost) result.covariance = TrackResult::kLostVariance * Matrix6d::Identity();
  if (status_ == TrackStatus::kCoasting)
    result.covariance += coasting_covariance(result.timestamp - motion_.last_timestamp());
  result.entropy = differential_entropy(result.covariance);
  unsettled_.push_back({result.frame, result.timestamp, status_, pose, measured, !measured});
  if (!measured) return;
  tracked_before_ = static_cast<int>(map_.window.back().sightings.size());
  ++frames_since_keyframe_;
  let_go();
  settle(static_cast<std::size_t>(options_.window_frames), out);
  update_information(map_, options_.window);
}

}  // namespace spslam
