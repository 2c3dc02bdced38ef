// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/camera/rectifier.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "spslam/base/error.h"

namespace spslam {
namespace {

void require(bool ok, const std::string& what) {
  if (!ok) throw InputError("raw stereo calibration: " + what);
}

bool count_fits(LensModel lens, std::size_t count) {
  switch (lens) {
    case LensModel::kPinhole:
      return count == 0;
    case LensModel::kRadtan:
      return count == 4 || count == 5 || count == 8 || count == 12 || count == 14;
    case LensModel::kEquidistant:
      return count == 4;
  }
  return false;
}

void check_camera(const RawCamera& camera, const std::string& eye) {
  require(camera.width > 1 && camera.height > 1 && camera.width <= 1 << 14 && camera.height <= 1 << 14,
          eye + " image size " + std::to_string(camera.width) + " x " + std::to_string(camera.height) +
              " px is not usable; give the size of the raw images");
  require(camera.fx > 0 && camera.fy > 0 && std::isfinite(camera.fx) && std::isfinite(camera.fy),
          eye + " focal length must be positive, is " + std::to_string(camera.fx) + ", " +
              std::to_string(camera.fy) + " px");
  require(camera.cx > 0 && camera.cx < camera.width && camera.cy > 0 && camera.cy < camera.height,
          eye + " principal point " + std::to_string(camera.cx) + ", " + std::to_string(camera.cy) +
              " px lies outside the image; is this the calibration of another image size?");
  require(count_fits(camera.lens, camera.distortion.size()),
          eye + " lens has " + std::to_string(camera.distortion.size()) +
              " distortion coefficients; radtan takes 4, 5, 8, 12 or 14, equidistant 4, pinhole none");
  for (const double k : camera.distortion)
    require(std::isfinite(k), eye + " lens has a distortion coefficient that is not a finite number");
}

cv::Mat intrinsic_matrix(const RawCamera& camera) {
  return (cv::Mat_<double>(3, 3) << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
}

cv::Mat to_cv(const Eigen::Matrix3d& m) {
  return (cv::Mat_<double>(3, 3) << m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1),
          m(2, 2));
}

// Whether the pair is rectified already, to a thousandth of a pixel: resampling it would only blur.
bool is_rectified(const RawStereo& raw) {
  const auto zero = [](double k) { return k == 0; };
  const auto undistorted = [&](const RawCamera& camera) {
    return std::all_of(camera.distortion.begin(), camera.distortion.end(), zero) &&
           (camera.lens != LensModel::kEquidistant);  // whose zero coefficients are a fisheye all the same
  };
  const RawCamera &a = raw.left, &b = raw.right;
  const double intrinsics =
      std::max({std::abs(a.fx - b.fx), std::abs(a.fy - b.fy), std::abs(a.cx - b.cx), std::abs(a.cy - b.cy)});
  const Eigen::Vector3d& t = raw.right_from_left.translation;
  const double turned = so3_log(raw.right_from_left.rotation).norm() * a.fx;
  const double skew = std::hypot(t.y(), t.z()) / std::abs(t.x()) * a.fx;
  return undistorted(a) && undistorted(b) && std::max({intrinsics, turned, skew}) < 1e-3;
}

struct Rectification {
  cv::Mat left_rotation, right_rotation;      // 3x3, rectified from raw
  cv::Mat left_projection, right_projection;  // 3x4, px
};

Rectification stereo_rectify(const RawStereo& raw) {
  const cv::Size size(raw.left.width, raw.left.height);
  const cv::Mat left = intrinsic_matrix(raw.left), right = intrinsic_matrix(raw.right);
  const cv::Mat rotation = to_cv(raw.right_from_left.rotation);
  const Eigen::Vector3d& t = raw.right_from_left.translation;
  const cv::Mat translation = (cv::Mat_<double>(3, 1) << t.x(), t.y(), t.z());
  Rectification r;
  cv::Mat disparity_to_depth;
  if (raw.left.lens == LensModel::kEquidistant) {
    cv::fisheye::stereoRectify(left, raw.left.distortion, right, raw.right.distortion, size, rotation,
                               translation, r.left_rotation, r.right_rotation, r.left_projection,
                               r.right_projection, disparity_to_depth, cv::CALIB_ZERO_DISPARITY, size, 0.0,
                               1.0);
  } else {
    cv::stereoRectify(left, raw.left.distortion, right, raw.right.distortion, size, rotation, translation,
                      r.left_rotation, r.right_rotation, r.left_projection, r.right_projection,
                      disparity_to_depth, cv::CALIB_ZERO_DISPARITY, 0.0, size);
  }
  return r;
}

StereoRig rig_of(const Rectification& r, cv::Size size) {
  const cv::Mat& left = r.left_projection;
  const cv::Mat& right = r.right_projection;
  StereoRig rig;
  rig.fx = left.at<double>(0, 0), rig.fy = left.at<double>(1, 1);
  rig.cx = left.at<double>(0, 2), rig.cy = left.at<double>(1, 2);
  rig.baseline = -right.at<double>(0, 3) / right.at<double>(0, 0);
  rig.width = size.width, rig.height = size.height;
  rig.check();
  return rig;
}

void make_maps(const RawCamera& camera, const cv::Mat& rotation, const cv::Mat& projection, cv::Mat& pixel,
               cv::Mat& fraction) {
  const cv::Size size(camera.width, camera.height);
  const cv::Mat target = projection.colRange(0, 3).clone(), matrix = intrinsic_matrix(camera);
  if (camera.lens == LensModel::kEquidistant)
    cv::fisheye::initUndistortRectifyMap(matrix, camera.distortion, rotation, target, size, CV_16SC2, pixel,
                                         fraction);
  else
    cv::initUndistortRectifyMap(matrix, camera.distortion, rotation, target, size, CV_16SC2, pixel, fraction);
}

}  // namespace

void RawStereo::check() const {
  check_camera(left, "left");
  check_camera(right, "right");
  require(left.width == right.width && left.height == right.height,
          "the two images differ in size: the left one is " + std::to_string(left.width) + " x " +
              std::to_string(left.height) + " px, the right one " + std::to_string(right.width) + " x " +
              std::to_string(right.height) + " px");
  require((left.lens == LensModel::kEquidistant) == (right.lens == LensModel::kEquidistant),
          "one lens is equidistant and the other is not; both eyes must have the same kind");
  require(right_from_left.is_finite(), "right_from_left holds a number that is not finite");
  const Eigen::Vector3d right_in_left = right_from_left.inverse().translation;
  require(right_in_left.x() > 0 && right_in_left.x() >= std::abs(right_in_left.y()),
          "the right camera must stand at +x of the left one, stands at (" +
              std::to_string(right_in_left.x()) + ", " + std::to_string(right_in_left.y()) + ", " +
              std::to_string(right_in_left.z()) +
              ") m; are the eyes swapped or is right_from_left inverted?");
}

Rectifier::Rectifier(const RawStereo& raw) {
  raw.check();
  if (is_rectified(raw)) {
    const RawCamera& c = raw.left;
    rig_ = {c.fx, c.fy, c.cx, c.cy, -raw.right_from_left.translation.x(), c.width, c.height};
    rig_.check();
    return;
  }
  try {
    const Rectification r = stereo_rectify(raw);
    rig_ = rig_of(r, {raw.left.width, raw.left.height});
    for (int row = 0; row < 3; ++row)  // the inverse of the rectifying rotation
      for (int column = 0; column < 3; ++column)
        raw_left_from_rectified_.rotation(row, column) = r.left_rotation.at<double>(column, row);
    make_maps(raw.left, r.left_rotation, r.left_projection, left_.pixel, left_.fraction);
    make_maps(raw.right, r.right_rotation, r.right_projection, right_.pixel, right_.fraction);
  } catch (const cv::Exception& error) {
    throw InputError(std::string("raw stereo calibration cannot be rectified (") + error.what() +
                     "); check its distortion coefficients and right_from_left");
  }
}

cv::Mat Rectifier::rectify(const cv::Mat& raw, const Maps& maps) const {
  if (raw.type() != CV_8UC1 || raw.cols != rig_.width || raw.rows != rig_.height)
    throw InputError("rectification takes grey 8 bit images of " + std::to_string(rig_.width) + " x " +
                     std::to_string(rig_.height) + " px, the calibrated size; got " +
                     std::to_string(raw.cols) + " x " + std::to_string(raw.rows) + " px");
  if (maps.pixel.empty()) return raw;
  cv::Mat rectified;
  cv::remap(raw, rectified, maps.pixel, maps.fraction, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return rectified;
}

}  // namespace spslam
