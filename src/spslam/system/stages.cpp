// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/system/stages.h"

#include <chrono>

#include "spslam/base/log.h"

namespace spslam {
namespace {

// Keyframes that may wait to be recognized while the whole map is adjusted; more, and there may be another
// loop.
constexpr std::size_t kMayWait = 10;

}  // namespace

Stages::Stages(const StereoRig& rig, const SlamOptions& options, Map map, const Vocabulary& vocabulary)
    : rig_(rig),
      options_(options),
      tracker_(rig, options.tracker),
      mapper_(rig, options.tracker.orb, options.mapper, std::move(map)),
      closer_(rig, options.loop.detection, options.loop.verification, options.loop.patches, vocabulary) {
  const Map& known = mapper_.map();
  if (!known.keyframes().empty()) {
    tracker_.continue_map({known.keyframes().rbegin()->first.value + 1},
                          {known.landmarks().empty() ? 0 : known.landmarks().rbegin()->first.value + 1});
    for (const auto& [id, keyframe] : known.keyframes()) closer_.add(known, id);
  }
  if (options.localization.enabled) tracker_.set_describe_interval(options.localization.interval);
  tracker_.set_relocalizer([this](const SeenFrame& frame) { return relocalize(frame); });
  if (is_parallel()) start_threads();
}

void Stages::start_threads() {
  // Nobody shall wait for what will not come.
  const auto give_up = [this] {
    const std::scoped_lock lock(view_mutex_);
    proposals_.close();
    described_.close();
    mapped_.notify_all();
  };
  mapping_.start(
      [this] {
        while (auto proposal = proposals_.pop()) insert(std::move(*proposal));
        described_.close();
      },
      give_up);
  loop_closing_.start(
      [this] {
        while (const auto id = described_.pop()) close_loop(*id);
      },
      give_up);
}

void Stages::rethrow_failure() const {
  mapping_.rethrow();
  loop_closing_.rethrow();
}

void Stages::adopt_view() {
  LocalMapView view;
  {
    const std::scoped_lock lock(view_mutex_);
    std::swap(view, view_);
  }
  if (view.revision > 0) tracker_.adopt(view);
}

TrackerOutput Stages::track(const StereoFrame& pair) {
  rethrow_failure();
  adopt_view();
  tracker_.set_mapper_busy(mapper_is_behind());
  TrackerOutput output = tracker_.track(pair);
  take(output);
  return output;
}

void Stages::take(TrackerOutput& output) {
  settled_.insert(settled_.end(), output.settled.begin(), output.settled.end());
  for (KeyframeProposal& proposal : output.proposals) {
    {
      const std::scoped_lock lock(view_mutex_);
      ++unmapped_;
    }
    if (is_parallel())
      proposals_.push(std::move(proposal));
    else
      insert(std::move(proposal));
  }
}

void Stages::wait_for_map() {
  if (!is_parallel()) return;
  std::unique_lock lock(view_mutex_);
  mapped_.wait(lock, [&] { return unmapped_ == 0 || mapping_.has_failed() || loop_closing_.has_failed(); });
  rethrow_failure();
}

void Stages::insert(KeyframeProposal proposal) {
  const auto start = std::chrono::steady_clock::now();
  const KeyframeId id = proposal.keyframe.id;
  {
    const std::scoped_lock lock(map_mutex_);
    MappingResult done = mapper_.insert(std::move(proposal), [this] { return mapper_is_behind(); });
    for (const KeyframeId gone : done.culled) closer_.erase(gone);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    mapping_log_.push_back({id, time.count(), done.retriangulated, done.outliers, done.culled_landmarks,
                            static_cast<int>(done.culled.size()), done.adjustment.iterations,
                            done.adjustment.initial_cost, done.adjustment.final_cost,
                            mapper_.map().keyframes().size(), mapper_.map().landmarks().size(),
                            done.triangulated, done.fused});
    publish_mapped(std::move(done.view));
  }
  if (!options_.loop.enabled) return;
  if (is_parallel())
    described_.push(id);
  else
    close_loop(id);
}

void Stages::publish_mapped(LocalMapView view) {
  publish(std::move(view));
  const std::scoped_lock lock(view_mutex_);
  if (--unmapped_ == 0) mapped_.notify_all();
}

void Stages::publish(LocalMapView view) {
  const std::scoped_lock lock(view_mutex_);
  view.corrected = view.corrected || view_.corrected;  // nobody has looked at that one
  view_ = std::move(view);
}

// What takes long is done on copies, without the lock.
void Stages::close_loop(KeyframeId id) {
  LoopAttempt attempt;
  Map map;
  {
    const std::scoped_lock lock(map_mutex_);
    attempt = closer_.detect(mapper_.map(), id);
    loop_log_.push_back(attempt);
    if (!attempt.closure) return;
    map = mapper_.map();
  }
  MapCorrection correction = solve_essential_graph(
      essential_graph(map, rig_, *attempt.closure, options_.loop.graph), options_.loop.graph);
  if (correction.empty()) return;
  AdjustmentProblem whole;
  {
    const std::scoped_lock lock(map_mutex_);
    fuse_across(mapper_.map(), rig_, *attempt.closure, options_.loop.fusion, correction);
    write(correction);
    closer_.closed(*attempt.closure);
    whole = copy_full_problem(mapper_.map(), rig_, options_.loop.full_adjustment);
  }
  spdlog::info("loop closed: keyframe {} sees the place of keyframe {}", attempt.closure->edge.newer.value,
               attempt.closure->edge.older.value);
  const MapCorrection adjusted = solve_full_problem(std::move(whole), options_.loop.full_adjustment,
                                                    [this] { return described_.size() > kMayWait; });
  if (adjusted.empty()) return;
  const std::scoped_lock lock(map_mutex_);
  write(adjusted);
}

// The map's lock is held.
void Stages::write(MapCorrection correction) {
  extend(correction, mapper_.map());
  publish(mapper_.correct([&](Map& map) { apply(correction, map); }));
}

std::optional<FoundPose> Stages::relocalize(const SeenFrame& frame) {
  const std::scoped_lock lock(map_mutex_);
  adopt_view();  // what is found is found in the map as it is now
  const RelocalizationAttempt attempt =
      spslam::relocalize(frame, mapper_.map(), rig_, closer_.index(), options_.loop.relocalization);
  const std::optional<Relocalized>& found = attempt.found ? attempt.found : attempt.imprecise;
  if (!found) {
    spdlog::info("not recognized in the map: {}", describe_attempt(attempt));
    return std::nullopt;
  }
  spdlog::info("found in the map: {} points agree with keyframe {}, uncertainty {:.2f} m", found->inliers,
               found->reference.value, std::sqrt(found->covariance.topLeftCorner<3, 3>().trace()));
  return FoundPose{{found->camera_from_world, found->covariance}, attempt.found.has_value()};
}

void Stages::finish() {
  if (std::exchange(is_finished_, true)) return;
  TrackerOutput rest = tracker_.finish();
  take(rest);
  stop();
  rethrow_failure();
}

void Stages::stop() {
  proposals_.close();
  mapping_.join();
  described_.close();
  loop_closing_.join();
}

std::vector<MappingInfo> Stages::mapping_log() const {
  const std::scoped_lock lock(map_mutex_);
  return mapping_log_;
}

std::vector<LoopAttempt> Stages::loop_log() const {
  const std::scoped_lock lock(map_mutex_);
  return loop_log_;
}

}  // namespace spslam
