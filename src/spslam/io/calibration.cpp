// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/io/calibration.h"

#include <cmath>

#include "spslam/base/error.h"
#include "spslam/base/options.h"
#include "spslam/io/text.h"
#include "spslam/io/yaml_text.h"

namespace spslam {
namespace {

using Projection = std::array<double, 12>;  // 3x4, row by row

// What a KITTI file says of one camera.
struct KittiCamera {
  std::string name;  // "P0", "P_rect_00"
  std::optional<Projection> projection;
  std::optional<std::array<double, 2>> size;  // px
};

// Both cameras must be one rectified pair: StereoRig has one focal length and one principal point.
void check_same(const Projection& left, const Projection& right, const std::string& names,
                const std::string& file) {
  const auto same = [&](std::size_t index, const char* what, const char* advice) {
    if (!(std::abs(left[index] - right[index]) <= 1e-3))
      throw InputError(file + ": " + what + " differs between " + names + ": " + fixed_text(left[index], 4) +
                       " and " + fixed_text(right[index], 4) + " px; " + advice);
  };
  const char* unrectified = "the images of a rectified pair have one; give a calibration of rectified images";
  same(0, "fx", unrectified), same(5, "fy", unrectified);
  same(2, "cx",
       "both must be the same: rectify so that the disparity at infinity is 0 (CALIB_ZERO_DISPARITY in "
       "OpenCV)");
  same(6, "cy", "rows of the two images must correspond; give a calibration of rectified images");
}

StereoRig rig_of_cameras(const KittiCamera& left_camera, const KittiCamera& right_camera,
                         const std::string& file) {
  const Projection &left = *left_camera.projection, &right = *right_camera.projection;
  const std::string names = left_camera.name + " and " + right_camera.name;
  check_same(left, right, names, file);
  if (!(left[0] > 0))
    throw InputError(file + ": fx in " + left_camera.name + " must be positive, is " +
                     fixed_text(left[0], 4) + " px");
  StereoRig rig;
  rig.fx = left[0], rig.fy = left[5], rig.cx = left[2], rig.cy = left[6];
  rig.baseline = (left[3] - right[3]) / left[0];
  if (!(rig.baseline > 0))
    throw InputError(file + ": the baseline from " + names + " is " + fixed_text(rig.baseline, 6) +
                     " m and must be positive; are the eyes swapped?");
  if (left_camera.size)
    rig.width = static_cast<int>((*left_camera.size)[0]),
    rig.height = static_cast<int>((*left_camera.size)[1]);
  return rig;
}

// The last column of a projection is K times the reference camera's origin in this camera.
SE3 reference_from(const Projection& p) {
  const double z = p[11], x = (p[3] - p[2] * z) / p[0], y = (p[7] - p[6] * z) / p[5];
  return {Eigen::Matrix3d::Identity(), -Eigen::Vector3d(x, y, z)};
}

// Takes a line of the camera; false if it is about something else. P0: and P_rect_00: are projections,
// S_rect_00: a size.
bool take_line(const LineReader& reader, int number, KittiCamera& camera) {
  const std::vector<std::string_view> words = reader.fields();
  const std::string digit = std::to_string(number);
  const auto take = [&](auto& value, const char* what) {
    if (value) reader.fail(in_quotes(words[0]) + " is given twice; remove one");
    value.emplace();
    if (words.size() != value->size() + 1)
      reader.fail("has " + std::to_string(words.size() - 1) + " numbers, a " + what + " has " +
                  std::to_string(value->size()));
    for (std::size_t i = 0; i < value->size(); ++i) (*value)[i] = reader.real(words[i + 1]);
    return true;
  };
  if (words[0] == "P" + digit + ":" || words[0] == "P_rect_0" + digit + ":") {
    camera.name = words[0].substr(0, words[0].size() - 1);
    return take(camera.projection, "projection");
  }
  return words[0] == "S_rect_0" + digit + ":" && take(camera.size, "size");
}

SE3 rigid(const YamlMap& map, const std::string& key) {
  const std::vector<double> m = map.reals(key);
  if (m.size() != 12 && m.size() != 16)
    map.fail(key, "must have 16 numbers (4 x 4) or 12 (3 x 4), row by row, has " + std::to_string(m.size()));
  const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> top(m.data());
  const Eigen::Matrix3d rotation = top.leftCols<3>();
  const double error = (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(error < 0.02) || !(rotation.determinant() > 0))
    map.fail(key, "does not hold a rotation in its first three columns");
  return SE3{rotation, top.col(3)}.normalized();
}

void set_intrinsics(RawCamera& camera, const std::array<double, 4>& values) {
  camera.fx = values[0], camera.fy = values[1], camera.cx = values[2], camera.cy = values[3];
}

LensModel lens_of(const YamlMap& map, const std::string& key) {
  const std::string name = map.word(key);
  if (name == "radtan" || name == "radial-tangential" || name == "plumb_bob") return LensModel::kRadtan;
  if (name == "equidistant" || name == "fisheye") return LensModel::kEquidistant;
  if (name == "pinhole" || name == "none") return LensModel::kPinhole;
  map.fail(key, "is " + in_quotes(name) + "; known are radtan, equidistant and pinhole");
}

RawCamera raw_camera(const YamlMap& map, int width, int height) {
  static const std::string known[] = {"fx", "fy", "cx", "cy", "model", "distortion"};
  map.require_known(known);
  RawCamera camera;
  camera.width = width, camera.height = height;
  set_intrinsics(camera, {map.real("fx"), map.real("fy"), map.real("cx"), map.real("cy")});
  camera.lens = lens_of(map, "model");
  if (map.has("distortion")) camera.distortion = map.reals("distortion");
  return camera;
}

StereoRig rectified_rig(const YamlMap& map) {
  static const std::string known[] = {"width", "height", "fx", "fy", "cx", "cy", "baseline"};
  map.require_known(known);
  StereoRig rig;
  rig.width = map.integer("width"), rig.height = map.integer("height");
  rig.fx = map.real("fx"), rig.fy = map.real("fy"), rig.cx = map.real("cx"), rig.cy = map.real("cy");
  rig.baseline = map.real("baseline");
  return rig;
}

RawStereo raw_stereo(const YamlMap& map) {
  static const std::string known[] = {"width", "height", "left", "right", "right_from_left"};
  map.require_known(known);
  const int width = map.integer("width"), height = map.integer("height");
  return {raw_camera(map.map("left"), width, height), raw_camera(map.map("right"), width, height),
          rigid(map, "right_from_left")};
}

// Errors of the geometry get the file's name, too.
template <class F>
auto with_name(const std::string& name, F f) {
  try {
    return f();
  } catch (const InputError& error) {
    const std::string what = error.what();
    throw InputError(what.starts_with(name) ? what : name + ": " + what);
  }
}

}  // namespace

StereoCalibration parse_kitti_calibration(std::string_view text, const std::string& name, KittiPair pair) {
  const int first = static_cast<int>(pair);
  KittiCamera left, right;
  for (LineReader reader(text, name); reader.next();)  // the other cameras, Tr and dates are of other uses
    if (!take_line(reader, first, left)) take_line(reader, first + 1, right);
  for (const int number : {first, first + 1})
    if (const KittiCamera& camera = number == first ? left : right; !camera.projection)
      throw InputError(name + ": has no line 'P" + std::to_string(number) + ":' (or 'P_rect_0" +
                       std::to_string(number) + ":'); the projections of both eyes are needed");
  for (const std::optional<std::array<double, 2>>& size : {left.size, right.size})
    if (size &&
        (!((*size)[0] >= 2 && (*size)[0] < 1e5 && (*size)[1] >= 2 && (*size)[1] < 1e5) || size != left.size))
      throw InputError(name + ": S_rect_0" + std::to_string(first) + " and S_rect_0" +
                       std::to_string(first + 1) + " must be one image size, width and height in px");
  return {rig_of_cameras(left, right, name), std::nullopt, reference_from(*left.projection)};
}

StereoCalibration parse_calibration_yaml(std::string_view text, const std::string& name) {
  const YamlMap map = YamlMap::parse(text, name);
  return with_name(name, [&] {
    StereoCalibration calibration;
    if (map.has("left") || map.has("right")) {
      calibration.raw = raw_stereo(map);
      calibration.raw->check();
    } else {
      calibration.rig = rectified_rig(map);
      calibration.rig.check();
    }
    return calibration;
  });
}

EurocSensor parse_euroc_sensor(std::string_view text, const std::string& name) {
  const YamlMap map = YamlMap::parse(text, name);
  if (map.has("camera_model") && map.word("camera_model") != "pinhole")
    map.fail("camera_model", "must be pinhole");
  const std::vector<double> size = map.reals("resolution"), intrinsics = map.reals("intrinsics");
  if (size.size() != 2 || !(size[0] > 0 && size[0] < 1e5 && size[1] > 0 && size[1] < 1e5))
    map.fail("resolution", "must be [width, height] in px");
  if (intrinsics.size() != 4) map.fail("intrinsics", "must be [fu, fv, cu, cv] in px");
  EurocSensor sensor;
  sensor.camera.width = static_cast<int>(size[0]), sensor.camera.height = static_cast<int>(size[1]);
  set_intrinsics(sensor.camera, {intrinsics[0], intrinsics[1], intrinsics[2], intrinsics[3]});
  sensor.camera.lens = lens_of(map, "distortion_model");
  if (sensor.camera.lens != LensModel::kPinhole)
    sensor.camera.distortion = map.reals("distortion_coefficients");
  sensor.body_from_camera = rigid(map.map("T_BS"), "data");
  return sensor;
}

StereoCalibration read_calibration(const std::filesystem::path& path, KittiPair pair) {
  const std::string text = read_text_file(path);
  if (path.extension() == ".txt") return parse_kitti_calibration(text, path.string(), pair);
  return parse_calibration_yaml(text, path.string());
}

std::string format_kitti_calibration(const StereoRig& rig) {
  std::string text;
  for (const int eye : {0, 1}) {
    const Projection p = {rig.fx, 0, rig.cx, eye == 0 ? 0 : -rig.fx * rig.baseline, 0, rig.fy, rig.cy, 0, 0,
                          0,      1, 0};
    text += eye == 0 ? "P0:" : "P1:";
    for (const double value : p) text.append(" ").append(scientific_text(value, 12));
    text += '\n';
  }
  return text;
}

std::string format_calibration_yaml(const StereoRig& rig) {
  const auto line = [](const char* key, const std::string& value, const char* unit) {
    return std::string(key) + ": " + value + "  # " + unit + "\n";
  };
  return "# Rectified stereo pair. Pixel (0, 0) is the centre of the first pixel.\n" +
         line("width", std::to_string(rig.width), "px") + line("height", std::to_string(rig.height), "px") +
         line("fx", detail::print_double(rig.fx), "px") + line("fy", detail::print_double(rig.fy), "px") +
         line("cx", detail::print_double(rig.cx), "px") + line("cy", detail::print_double(rig.cy), "px") +
         line("baseline", detail::print_double(rig.baseline), "m");
}

}  // namespace spslam
