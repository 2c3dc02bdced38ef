// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/system/localizer.h"

#include <map>

#include "spslam/base/log.h"

namespace spslam {

Localizer::Localizer(const StereoRig& rig, const SlamOptions& options, Map map, const Vocabulary& vocabulary)
    : rig_(rig), options_(options), map_(std::move(map)), index_(vocabulary), filter_(options.localization) {
  if (map_.keyframes().empty())
    throw OptionError("localization.enabled: there is no map to localize in; give one (--load-map FILE)");
  for (const auto& [id, keyframe] : map_.keyframes())
    if (keyframe.features) index_.add(id, *keyframe.features);
  if (options.threads == Threads::kSequential) return;
  worker_.start(
      [this] {
        while (const auto request = requests_.pop()) {
          const std::optional<Answer> answer = look(*request);
          const std::scoped_lock lock(answers_mutex_);
          if (answer) answers_.push_back(*answer);
        }
      },
      [this] { requests_.close(); });
}

void Localizer::stop() {
  requests_.close();
  worker_.join();
}

void Localizer::finish(const std::vector<TrajectoryPose>& session) {
  if (std::exchange(is_finished_, true)) return;
  stop();
  if (frames_.empty()) return;
  take_answers();
  take_over(session);
  smooth_pieces();
  worker_.rethrow();
}

TrackResult Localizer::place(const TrackerOutput& odometry) {
  worker_.rethrow();
  TrackResult result = odometry.result;
  if (result.status == TrackStatus::kInitializing) return result;
  const SE3 camera_from_session = result.world_from_camera.inverse();
  if (!frames_.empty()) filter_.move(camera_from_session * frames_.back().camera_from_session.inverse());
  if (result.status == TrackStatus::kLost) {
    ++stretch_;
    filter_.forget();
    unused_.clear();
  }
  const int stretch = result.status == TrackStatus::kLost ? kLost : stretch_;
  frames_.push_back({result.frame, result.timestamp, result.status, camera_from_session, stretch, kLost, {}});
  if (odometry.seen && result.status != TrackStatus::kLost) ask(odometry.seen);
  take_answers();

  PlacedFrame& here = frames_.back();
  if (const auto known = filter_.estimate(); known && result.status != TrackStatus::kLost) {
    // Over frames without a pose nobody knows the way that odometry erred on.
    if (frames_.size() < 2 || !frames_[frames_.size() - 2].camera_from_world) ++pieces_;
    here.camera_from_world = known->camera_from_world;
    here.piece = pieces_ - 1;
    result.world_from_camera = known->camera_from_world.inverse();
    result.covariance += known->covariance;
  } else {
    here.status = result.status = TrackStatus::kLost;
    if (result.reason.empty()) result.reason = "not recognized in the map";
    result.covariance = TrackResult::kLostVariance * Matrix6d::Identity();
  }
  result.entropy = differential_entropy(result.covariance);
  return result;
}

void Localizer::ask(std::shared_ptr<const SeenFrame> frame) {
  Request request{frames_.size() - 1, std::move(frame), {}};
  if (const auto known = filter_.estimate()) request.expected = known->camera_from_world;
  if (worker_.is_started()) {
    if (requests_.empty()) requests_.push(std::move(request));  // else the last one still waits
  } else if (const auto answer = look(request)) {
    answers_.push_back(*answer);
  }
}

// Reads what never changes, so it needs no lock.
std::optional<Localizer::Answer> Localizer::look(const Request& request) const {
  std::vector<KeyframeId> guesses;
  if (request.expected) guesses = nearest_keyframes(map_, *request.expected, options_.localization.nearest);
  const RelocalizationAttempt attempt =
      relocalize(*request.frame, map_, rig_, index_, options_.loop.relocalization, {}, guesses);
  // Where everything is far the place is recognized, if not the position to the decimetre.
  const std::optional<Relocalized>& found = attempt.found ? attempt.found : attempt.imprecise;
  if (!found) {
    // Who is lost wants to know why; who is not is only not corrected.
    const auto level = request.expected ? spdlog::level::debug : spdlog::level::info;
    spdlog::log(level, "not recognized in the map: {}", describe_attempt(attempt));
    return std::nullopt;
  }
  return Answer{request.index, {found->camera_from_world, found->covariance}, attempt.found.has_value()};
}

void Localizer::take_answers() {
  std::vector<Answer> answers;
  {
    const std::scoped_lock lock(answers_mutex_);
    answers.swap(answers_);
  }
  for (const Answer& answer : answers) take(answer);
}

// The answer is about a frame that may have passed: odometry since then moves it to the present.
void Localizer::take(const Answer& answer) {
  const PlacedFrame& then = frames_[answer.index];
  const PlacedFrame& now = frames_.back();
  if (then.stretch != now.stretch) return;
  const SE3 motion = now.camera_from_session * then.camera_from_session.inverse();
  const UncertainPose present = moved(answer.pose, motion, drift_covariance(motion, options_.localization));
  const SeenPlace seen{answer.index, answer.pose};
  const FilterAnswer answered = filter_.add(present, answer.precise);
  if (answered == FilterAnswer::kPending) {
    unused_.push_back(seen);
    return;
  }
  if (answered == FilterAnswer::kRestarted)
    std::erase_if(used_, [&](const SeenPlace& other) { return other.frame == seen.frame; });
  used_.push_back(seen);
  if (answered == FilterAnswer::kUsed) return;
  spdlog::info("found in the map at {:.3f} s, uncertainty {:.2f} m", now.timestamp, present.position_sigma());
  place_backwards();
}

// Frames of this stretch from before the camera was found, and the places recognized then that agree.
void Localizer::place_backwards() {
  const std::optional<UncertainPose> known = filter_.estimate();
  if (!known) return;
  ++pieces_;
  frames_.back().camera_from_world.reset();
  const SE3 session_from_world = frames_.back().camera_from_session.inverse() * known->camera_from_world;
  for (auto it = frames_.rbegin(); it != frames_.rend() && it->stretch == stretch_; ++it) {
    if (it->camera_from_world) break;
    it->camera_from_world = it->camera_from_session * session_from_world;
    it->piece = pieces_ - 1;
    it->status = TrackStatus::kTracking;
  }
  for (const SeenPlace& seen : unused_) {
    const PlacedFrame& then = frames_[seen.frame];
    if (then.piece != pieces_ - 1) continue;
    const SE3 motion = then.camera_from_session * frames_.back().camera_from_session.inverse();
    const UncertainPose expected = moved(*known, motion, drift_covariance(motion, options_.localization));
    if (squared_distance(expected, seen.pose) <= options_.localization.gate) used_.push_back(seen);
  }
  unused_.clear();
}

// Odometry's first frames above all: it knows their depths by a single pair, mapping by all frames after it.
void Localizer::take_over(const std::vector<TrajectoryPose>& session) {
  std::map<FrameId, SE3> camera_from_session;
  for (const TrajectoryPose& pose : session)
    camera_from_session[pose.frame] = pose.world_from_camera.inverse();
  for (PlacedFrame& frame : frames_)
    if (const auto corrected = camera_from_session.find(frame.frame); corrected != camera_from_session.end())
      frame.camera_from_session = corrected->second;
}

void Localizer::smooth_pieces() {
  std::vector<PlacedRun> runs(static_cast<std::size_t>(pieces_));
  std::vector<std::vector<std::size_t>> frames(runs.size());  // of each run
  std::stable_sort(used_.begin(), used_.end(),
                   [](const SeenPlace& a, const SeenPlace& b) { return a.frame < b.frame; });
  auto used = used_.begin();
  for (std::size_t f = 0; f < frames_.size(); ++f) {
    const int piece = frames_[f].piece;
    for (; used != used_.end() && used->frame == f; ++used)
      if (piece != kLost) runs[piece].places.push_back({frames[piece].size(), used->pose});
    if (piece == kLost) continue;
    runs[piece].camera_from_session.push_back(frames_[f].camera_from_session);
    frames[piece].push_back(f);
  }
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const std::vector<SE3> smoothed = smooth(runs[r], options_.localization);
    for (std::size_t i = 0; i < smoothed.size(); ++i) frames_[frames[r][i]].camera_from_world = smoothed[i];
  }
}

std::vector<TrajectoryPose> Localizer::trajectory() const {
  std::vector<TrajectoryPose> out;
  for (const PlacedFrame& frame : frames_)
    if (frame.camera_from_world)
      out.push_back({frame.frame, frame.timestamp, frame.status, frame.camera_from_world->inverse()});
  return out;
}

}  // namespace spslam
