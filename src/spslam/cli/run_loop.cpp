// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/cli/run_loop.h"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <thread>

#include "spslam/cli/run_signal.h"

namespace spslam {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Sleeps in short pieces, so that a signal ends it.
void wait_until(Clock::time_point time) {
  constexpr auto kPiece = std::chrono::milliseconds(20);
  while (interruption() == 0 && Clock::now() < time)
    std::this_thread::sleep_until(std::min(time, Clock::now() + kPiece));
}

// One line on a terminal, a few times a second.
class ProgressLine {
 public:
  ProgressLine(bool wanted, int frames)
      : shown_(wanted && frames > 0 && isatty(fileno(stderr)) != 0), frames_(frames) {}
  ~ProgressLine() {
    if (shown_) std::fputs("\r\033[K", stderr);
  }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(int done, const TrackResult& result) {
    if (!shown_ || (done < frames_ && seconds_since(last_) < 0.1)) return;
    last_ = Clock::now();
    constexpr int kBar = 24;
    const int filled = kBar * done / frames_;
    const std::string bar = std::string(static_cast<std::size_t>(filled), '#') +
                            std::string(static_cast<std::size_t>(kBar - filled), '.');
    const char* state = state_name(result.status);
    std::fprintf(stderr, "\r[%s] %d/%d  %.1f frames/s  %s  %d near\033[K", bar.c_str(), done, frames_,
                 done / std::max(1e-9, seconds_since(start_)), state, result.near);
    std::fflush(stderr);
  }

 private:
  bool shown_;
  int frames_;
  Clock::time_point start_ = Clock::now(), last_ = {};
};

void log_frame(const FrameRecord& frame, TrackStatus before) {
  const TrackResult& result = frame.result;
  if (result.status != before || !result.reason.empty())
    spdlog::info("frame {}: {}{}{}", frame.index, state_name(result.status),
                 result.reason.empty() ? "" : ": ", result.reason);
}

}  // namespace

std::exception_ptr track_frames(const RunArguments& arguments, const Dataset& dataset, Prefetcher& frames,
                                Slam& slam, Checkpoint& checkpoint, RunRecord& record) {
  ProgressLine progress(!arguments.quiet, std::min(arguments.end, dataset.size()) - arguments.start);
  const Clock::time_point start = Clock::now();
  TrackStatus before = TrackStatus::kInitializing;
  std::exception_ptr failure;
  try {
    while (interruption() == 0) {
      const std::optional<LoadedFrame> frame = frames.next();
      if (!frame) break;
      const double time = frame->pair.timestamp - dataset.timestamp(arguments.start);
      if (arguments.realtime)
        wait_until(start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(time)));
      else if (!arguments.ahead)
        slam.wait_for_map();
      if (interruption() != 0) break;
      record.frames.push_back({frame->index, frame->seconds, slam.track(frame->pair)});
      log_frame(record.frames.back(), before);
      before = record.frames.back().result.status;
      progress.show(static_cast<int>(record.frames.size()), record.frames.back().result);
      checkpoint.write_if_due(slam);
    }
    slam.finish();
  } catch (...) {
    failure = std::current_exception();
  }
  record.wall_seconds = seconds_since(start);
  record.trajectory = slam.trajectory();
  record.keyframes = slam.keyframes();
  record.mapping = slam.mapping();
  record.loops = slam.loops();
  record.landmarks = slam.landmark_count();
  return failure;
}

}  // namespace spslam
