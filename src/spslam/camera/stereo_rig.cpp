// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/camera/stereo_rig.h"

#include "spslam/base/error.h"

namespace spslam {

void StereoRig::check() const {
  const auto require = [](bool ok, const std::string& what) {
    if (!ok) throw InputError("stereo calibration: " + what);
  };
  require(width > 1 && height > 1, "image size " + std::to_string(width) + " x " + std::to_string(height) +
                                       " px is not usable; give the size of the rectified images");
  require(fx > 0 && fy > 0, "focal length must be positive, is " + std::to_string(fx) + ", " +
                                std::to_string(fy) + " px; check the projection matrix");
  require(baseline > 0,
          "baseline must be positive, is " + std::to_string(baseline) +
              " m; it is the distance of the two cameras, the right one at +x (are the eyes swapped?)");
  require(cx > 0 && cx < width && cy > 0 && cy < height,
          "principal point " + std::to_string(cx) + ", " + std::to_string(cy) +
              " px lies outside the image of " + std::to_string(width) + " x " + std::to_string(height) +
              " px; is this the calibration of another image size?");
}

}  // namespace spslam
