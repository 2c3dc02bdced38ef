// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/eval/trajectory_pair.h"

#include "spslam/base/error.h"
#include "spslam/io/text.h"

namespace spslam {
namespace {

struct TimedFile {
  Trajectory trajectory;
  bool kitti = false;
  bool has_times = true;
};

// What `spslam run` writes beside its trajectory_kitti.txt.
std::filesystem::path times_beside(const std::filesystem::path& path) {
  return path.parent_path() / (path.stem().string() + "_times.txt");
}

TimedFile read_one(const std::filesystem::path& path, TrajectoryFormat format,
                   const std::filesystem::path& given_times) {
  if (std::filesystem::is_directory(path))
    throw InputError(path.string() + " is a folder; give the trajectory file in it");
  // One file of times is given for two trajectories; what lies beside one of them is surely its own.
  const std::filesystem::path times =
      std::filesystem::exists(times_beside(path)) ? times_beside(path) : given_times;
  TimedFile file;
  const TrajectoryFormat known =
      format == TrajectoryFormat::kAuto ? recognise_trajectory(read_text_file(path)) : format;
  file.trajectory = read_trajectory(path, {known, times, {}});
  file.kitti = known == TrajectoryFormat::kKitti;
  file.has_times = !file.kitti || !times.empty() || std::filesystem::exists(path.parent_path() / "times.txt");
  return file;
}

void lend_times(const TimedFile& timed, TimedFile& untimed, const std::filesystem::path& path) {
  if (!timed.kitti || timed.trajectory.size() != untimed.trajectory.size())
    throw InputError(path.string() + " has " + std::to_string(untimed.trajectory.size()) +
                     " poses without times and the other trajectory " +
                     std::to_string(timed.trajectory.size()) +
                     " with times; give the times of the KITTI rows (--times FILE, one a line)");
  for (std::size_t i = 0; i < timed.trajectory.size(); ++i)
    untimed.trajectory[i].timestamp = timed.trajectory[i].timestamp;
}

}  // namespace

TrajectoryPair read_trajectory_pair(const TrajectoryPairFiles& files) {
  TimedFile estimate = read_one(files.estimate, files.estimate_format, files.times);
  TimedFile truth = read_one(files.truth, files.truth_format, files.times);
  if (estimate.has_times && !truth.has_times) lend_times(estimate, truth, files.truth);
  if (truth.has_times && !estimate.has_times) lend_times(truth, estimate, files.estimate);
  const bool by_index = !estimate.has_times && !truth.has_times;
  return {std::move(estimate.trajectory), std::move(truth.trajectory), by_index};
}

}  // namespace spslam
