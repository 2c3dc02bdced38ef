// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// USVInland (Cheng et al., RA-L 2021), the paper's data: PIC_Left_Rectified/ and PIC_Right_Rectified/, or
// PIC_Left/ and PIC_Right/ with a raw calibration; Stereo_Timestamp.txt in seconds from the start;
// GPSBase.csv. The rig's calibration is not public: calibration.yaml must be given.

#include "spslam/base/error.h"
#include "spslam/io/image_sequence.h"

namespace spslam {

ImageSequence find_usvinland(const std::filesystem::path& folder, const DatasetOptions& options) {
  ImageSequence sequence(DatasetFormat::kUsvinland, folder);
  const std::filesystem::path calibration[] = {folder / "calibration.yaml", folder / "calibration.yml"};
  find_calibration(sequence, calibration, options);
  const std::string suffix = sequence.calibration.raw ? "" : "_Rectified";
  const std::filesystem::path left = folder / ("PIC_Left" + suffix), right = folder / ("PIC_Right" + suffix);
  if (!std::filesystem::exists(left))
    throw InputError(left.string() + " is missing; a calibration of a " +
                     (sequence.calibration.raw
                          ? "raw pair goes with PIC_Left, one of a rectified pair with PIC_Left_Rectified"
                          : "rectified pair goes with PIC_Left_Rectified, one of a raw pair with PIC_Left"));
  find_frames(sequence, left, right, folder / "Stereo_Timestamp.txt", options);
  const TruthFile truth[] = {{folder / "GPSBase.csv", TrajectoryFormat::kUsvinland}};
  find_truth(sequence, truth, options);
  return sequence;
}

}  // namespace spslam
