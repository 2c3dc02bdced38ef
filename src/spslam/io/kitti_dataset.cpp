// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// KITTI odometry (Geiger et al., CVPR 2012): sequences/NN/{image_0, image_1, calib.txt, times.txt} and
// poses/NN.txt, or its colour images, image_2 and image_3. Also what this project's simulator writes, with
// poses.txt in the folder itself. KITTI raw: DATE/DATE_drive_NNNN_sync/{image_00, image_01}/{data,
// timestamps.txt} (colour: image_02, image_03) and DATE/calib_cam_to_cam.txt; its positions by satellite are
// not read.

#include "spslam/io/image_sequence.h"

namespace spslam {
namespace {

namespace fs = std::filesystem;

// The folder by its name, without a slash or dot at its end.
fs::path named(const fs::path& folder) {
  const fs::path here = fs::weakly_canonical(folder / ".").lexically_normal();
  return here.has_filename() ? here : here.parent_path();
}

// Grey images if there are any.
KittiPair pair_of(const fs::path& left, const fs::path& right) {
  return fs::exists(left) || fs::exists(right) ? KittiPair::kGrey : KittiPair::kColour;
}

}  // namespace

ImageSequence find_kitti(const fs::path& folder, const DatasetOptions& options) {
  ImageSequence sequence(DatasetFormat::kKitti, folder);
  const KittiPair pair = pair_of(folder / "image_0", folder / "image_1");
  const bool grey = pair == KittiPair::kGrey;
  const fs::path calibration[] = {folder / "calib.txt"};
  find_calibration(sequence, calibration, options, pair);
  find_frames(sequence, folder / (grey ? "image_0" : "image_2"), folder / (grey ? "image_1" : "image_3"),
              folder / "times.txt", options);
  if (!grey) sequence.truth_body_from_left = sequence.calibration.reference_from_left;
  const fs::path name = named(folder);
  const fs::path shared = name.parent_path().parent_path() / "poses" / (name.filename().string() + ".txt");
  const TruthFile truth[] = {{folder / "poses.txt", TrajectoryFormat::kKitti},
                             {shared, TrajectoryFormat::kKitti}};
  find_truth(sequence, truth, options);
  return sequence;
}

ImageSequence find_kitti_raw(const fs::path& folder, const DatasetOptions& options) {
  ImageSequence sequence(DatasetFormat::kKittiRaw, folder);
  const KittiPair pair = pair_of(folder / "image_00", folder / "image_01");
  const bool grey = pair == KittiPair::kGrey;
  const fs::path calibration[] = {folder / "calib_cam_to_cam.txt",
                                  named(folder).parent_path() / "calib_cam_to_cam.txt"};
  find_calibration(sequence, calibration, options, pair);
  const fs::path left = folder / (grey ? "image_00" : "image_02"),
                 right = folder / (grey ? "image_01" : "image_03");
  find_frames(sequence, left / "data", right / "data", left / "timestamps.txt", options);
  if (!grey) sequence.truth_body_from_left = sequence.calibration.reference_from_left;
  find_truth(sequence, {}, options);
  return sequence;
}

}  // namespace spslam
