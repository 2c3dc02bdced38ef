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

}  // namespace spslam
