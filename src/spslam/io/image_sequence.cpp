// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/io/image_sequence.h"

#include <algorithm>

#include "spslam/base/error.h"
#include "spslam/io/image_names.h"
#include "spslam/io/text.h"

namespace spslam {
namespace {

namespace fs = std::filesystem;

std::vector<double> times_at_rate(std::size_t frames, double rate) {
  std::vector<double> times;
  for (std::size_t i = 0; i < frames; ++i) times.push_back(static_cast<double>(i) / rate);
  return times;
}

std::vector<double> read_times(const fs::path& file) {
  if (!fs::exists(file))
    throw InputError(file.string() +
                     " is missing; it holds the time of each frame in seconds, one a line, or give the frame "
                     "rate (--rate)");
  return parse_times(read_text_file(file), file.string());
}

// KITTI's poses have the times of the frames. They, in KITTI's folders, and EuRoC's are of the body.
void read_truth(ImageSequence& sequence, const TruthFile& file) {
  const std::string text = read_text_file(file.path), name = file.path.string();
  const TrajectoryFormat format =
      file.format == TrajectoryFormat::kAuto ? recognise_trajectory(text) : file.format;
  if (format == TrajectoryFormat::kKitti) {
    sequence.ground_truth = parse_kitti_poses(text, name, sequence.times);
    if (sequence.format == DatasetFormat::kKitti || sequence.format == DatasetFormat::kKittiRaw)
      for (StampedPose& pose : *sequence.ground_truth)
        pose.world_from_camera = pose.world_from_camera * sequence.truth_body_from_left;
  } else {
    sequence.ground_truth = read_trajectory(file.path, {format, {}, sequence.truth_body_from_left});
  }
  sequence.planar_ground_truth = format == TrajectoryFormat::kUsvinland;
}

}  // namespace

void find_frames(ImageSequence& sequence, const fs::path& left, const fs::path& right, const fs::path& times,
                 const DatasetOptions& options) {
  const bool timed = options.rate == 0;
  if (timed) sequence.times = read_times(times);
  ImagePairs pairs = pair_images(left, right, sequence.times.size());
  if (!timed) sequence.times = times_at_rate(pairs.left.size(), options.rate);
  if (sequence.times.size() != pairs.left.size())
    throw InputError(times.string() + " has " + std::to_string(sequence.times.size()) + " times, there are " +
                     std::to_string(pairs.left.size()) + " frames (" + pairs.found +
                     "); each frame needs one line");
  sequence.left = std::move(pairs.left), sequence.right = std::move(pairs.right);
  if (!pairs.warning.empty()) sequence.warnings.push_back(pairs.warning);
}

void find_calibration(ImageSequence& sequence, std::span<const fs::path> candidates,
                      const DatasetOptions& options, KittiPair pair) {
  if (!options.calibration.empty()) {
    sequence.calibration_file = options.calibration;
  } else {
    const auto found = std::find_if(candidates.begin(), candidates.end(),
                                    [](const fs::path& path) { return fs::exists(path); });
    if (found == candidates.end())
      throw InputError("calibration is missing: there is no " + candidates.front().string() +
                       "; add it or give another file with --calibration");
    sequence.calibration_file = *found;
  }
  sequence.calibration = read_calibration(sequence.calibration_file, pair);
}

void find_truth(ImageSequence& sequence, std::span<const TruthFile> candidates,
                const DatasetOptions& options) {
  if (!options.truth.empty()) return read_truth(sequence, {options.truth, TrajectoryFormat::kAuto});
  const auto found = std::find_if(candidates.begin(), candidates.end(),
                                  [](const TruthFile& file) { return fs::exists(file.path); });
  if (found == candidates.end()) return;
  try {
    read_truth(sequence, *found);
  } catch (const InputError& error) {
    sequence.warnings.push_back(std::string("no ground truth, as it cannot be used: ") + error.what());
  }
}

}  // namespace spslam
