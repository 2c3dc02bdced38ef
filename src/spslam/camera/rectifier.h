// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// From the raw calibration of two cameras to a rectified rig and back: undistortion and rectification of
// image pairs. (Bouguet's method as OpenCV's stereoRectify has it: half of the rotation to each eye, then the
// baseline to the rows.)
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "spslam/base/se3.h"
#include "spslam/camera/stereo_rig.h"

namespace spslam {

enum class LensModel {
  kPinhole,      // no distortion
  kRadtan,       // k1 k2 p1 p2 [k3 [k4 k5 k6 ...]], Brown and Conrady, the order of OpenCV
  kEquidistant,  // k1 k2 k3 k4, Kannala and Brandt, "fisheye" in OpenCV
};

// One camera as calibrated, not rectified. Pixel (0, 0) is the centre of the first pixel.
struct RawCamera {
  int width = 0, height = 0;  // px
  double fx = 0, fy = 0;      // px
  double cx = 0, cy = 0;      // px
  LensModel lens = LensModel::kPinhole;
  std::vector<double> distortion;  // as many as the lens model takes, no unit
};

struct RawStereo {
  RawCamera left, right;
  SE3 right_from_left;  // m

  // Throws InputError unless both cameras are usable, of one image size, the right one at +x of the left one.
  void check() const;
};

// Immutable once built: rectify() may be called from several threads.
class Rectifier {
 public:
  // Throws InputError if the calibration cannot be rectified. Images are cut to what both eyes see (alpha 0).
  explicit Rectifier(const RawStereo& raw);

  const StereoRig& rig() const { return rig_; }
  // False if the pair is rectified already and images pass as they are.
  bool resamples() const { return !left_.pixel.empty(); }
  // Turns points of the rectified left camera into the raw left camera (a pure rotation).
  const SE3& raw_left_from_rectified() const { return raw_left_from_rectified_; }

  // Grey 8 bit images of the raw size (anything else throws InputError) to images of the rig's size,
  // bilinear. A pair that is rectified already passes unchanged; the result then shares its pixels.
  cv::Mat rectify_left(const cv::Mat& raw) const { return rectify(raw, left_); }
  cv::Mat rectify_right(const cv::Mat& raw) const { return rectify(raw, right_); }

 private:
  struct Maps {
    cv::Mat pixel, fraction;  // fixed point, as cv::remap takes them fastest; 1/32 px steps, as it has anyway
  };
  cv::Mat rectify(const cv::Mat& raw, const Maps& maps) const;

  StereoRig rig_;
  SE3 raw_left_from_rectified_;
  Maps left_, right_;
};

}  // namespace spslam
