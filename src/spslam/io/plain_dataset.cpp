// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// A folder anyone can make: left/, right/, calibration.yaml (calibration.h), and times.txt or a frame rate.

#include "spslam/io/image_sequence.h"

namespace spslam {

ImageSequence find_plain(const std::filesystem::path& folder, const DatasetOptions& options) {
  ImageSequence sequence(DatasetFormat::kPlain, folder);
  const std::filesystem::path calibration[] = {folder / "calibration.yaml", folder / "calibration.yml",
                                               folder / "calib.yaml"};
  find_calibration(sequence, calibration, options);
  find_frames(sequence, folder / "left", folder / "right", folder / "times.txt", options);
  const TruthFile truth[] = {{folder / "poses.txt", TrajectoryFormat::kKitti},
                             {folder / "groundtruth.txt", TrajectoryFormat::kTum}};
  find_truth(sequence, truth, options);
  return sequence;
}

}  // namespace spslam
