// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/cli/run_checkpoint.h"

#include <spdlog/spdlog.h>

#include "spslam/base/atomic_file.h"
#include "spslam/base/error.h"
#include "spslam/cli/run_tables.h"

namespace spslam {
namespace {

constexpr double kMostShare = 0.05;  // of a run's time that goes into them, on a slow disk too

}  // namespace

Checkpoint::Checkpoint(double seconds, std::filesystem::path trajectory, std::filesystem::path map)
    : interval_(seconds), trajectory_(std::move(trajectory)), map_(std::move(map)) {}

void Checkpoint::write_if_due(const Slam& slam) {
  if (interval_.count() <= 0) return;
  const Clock::time_point start = Clock::now();
  if (start - last_ < std::max(interval_, cost_ / kMostShare)) return;
  const Trajectory so_far = stamped_trajectory(slam.trajectory());
  if (so_far.empty()) return;
  try {
    const std::string text = format_tum(so_far);
    write_file_atomically(trajectory_, std::as_bytes(std::span(text)));
    if (!map_.empty()) slam.save(map_);
  } catch (const OutputError& error) {
    if (!has_failed_) spdlog::warn("checkpoint: {}", error.what());
    has_failed_ = true;
  }
  last_ = Clock::now();
  cost_ = last_ - start;
}

}  // namespace spslam
