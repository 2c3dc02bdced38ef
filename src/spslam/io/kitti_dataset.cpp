// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// KITTI odometry: sequences/NN/{image_0, image_1, calib.txt, times.txt} and poses/NN.txt. Also what this
// project's simulator writes, with poses.txt in the folder itself.

#include "spslam/io/image_sequence.h"
#include "spslam/io/text.h"

namespace spslam {

ImageSequence find_kitti(const std::filesystem::path& folder, const DatasetOptions& options) {
  ImageSequence sequence(DatasetFormat::kKitti, folder);
  const std::filesystem::path calibration[] = {folder / "calib.txt"};
  find_calibration(sequence, calibration, options);
  find_frames(sequence, folder / "image_0", folder / "image_1", folder / "times.txt", options);
  const std::filesystem::path here = std::filesystem::weakly_canonical(folder / ".").lexically_normal();
  const std::filesystem::path named = here.has_filename() ? here : here.parent_path();  // no slash at its end
  const std::filesystem::path shared =
      named.parent_path().parent_path() / "poses" / (named.filename().string() + ".txt");
  for (const std::filesystem::path& file : {folder / "poses.txt", shared}) {
    if (!std::filesystem::exists(file)) continue;
    sequence.ground_truth = parse_kitti_poses(read_text_file(file), file.string(), sequence.times);
    break;
  }
  return sequence;
}

}  // namespace spslam
