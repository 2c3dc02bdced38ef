// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// A folder anyone can make: left/, right/, calibration.yaml (calibration.h), and times.txt or a frame rate.

#include "spslam/io/image_sequence.h"
#include "spslam/io/text.h"

namespace spslam {

ImageSequence find_plain(const std::filesystem::path& folder, const DatasetOptions& options) {
  ImageSequence sequence(DatasetFormat::kPlain, folder);
  const std::filesystem::path calibration[] = {folder / "calibration.yaml", folder / "calibration.yml",
                                               folder / "calib.yaml"};
  find_calibration(sequence, calibration, options);
  find_frames(sequence, folder / "left", folder / "right", folder / "times.txt", options);
  if (const auto poses = folder / "poses.txt"; std::filesystem::exists(poses))
    sequence.ground_truth = parse_kitti_poses(read_text_file(poses), poses.string(), sequence.times);
  else if (const auto tum = folder / "groundtruth.txt"; std::filesystem::exists(tum))
    sequence.ground_truth = parse_tum(read_text_file(tum), tum.string());
  return sequence;
}

}  // namespace spslam
