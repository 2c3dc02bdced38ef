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

// Both cameras must be one rectified pair: StereoRig has one focal length and one principal point.
StereoRig rig_of_projections(const Projection& left, const Projection& right, const std::string& name) {
  const auto same = [&](int index, const char* what) {
    if (!(std::abs(left[index] - right[index]) <= 1e-3))
      throw InputError(name + ": " + what + " differs between P0 and P1 (" + fixed_text(left[index], 4) +
                       " and " + fixed_text(right[index], 4) +
                       " px), the pair is not rectified; give a calibration of rectified images");
  };
  same(0, "fx"), same(5, "fy"), same(2, "cx"), same(6, "cy");
  if (!(left[0] > 0))
    throw InputError(name + ": fx in P0 must be positive, is " + fixed_text(left[0], 4) + " px");
  StereoRig rig;
  rig.fx = left[0], rig.fy = left[5], rig.cx = left[2], rig.cy = left[6];
  rig.baseline = (left[3] - right[3]) / left[0];
  if (!(rig.baseline > 0))
    throw InputError(name + ": the baseline from P0 and P1 is " + fixed_text(rig.baseline, 6) +
                     " m and must be positive; are the eyes swapped?");
  return rig;
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

StereoRig parse_kitti_calibration(std::string_view text, const std::string& name) {
  std::optional<Projection> projections[2];
  for (LineReader reader(text, name); reader.next();) {
    const std::vector<std::string_view> words = reader.fields();
    if (words[0] != "P0:" && words[0] != "P1:") continue;  // P2, P3, Tr and dates of other uses
    std::optional<Projection>& projection = projections[words[0] == "P1:" ? 1 : 0];
    if (projection) reader.fail(in_quotes(words[0]) + " is given twice; remove one");
    if (words.size() != 13)
      reader.fail("has " + std::to_string(words.size() - 1) + " numbers, a projection has 12");
    projection.emplace();
    for (std::size_t i = 0; i < 12; ++i) (*projection)[i] = reader.real(words[i + 1]);
  }
  for (const int eye : {0, 1})
    if (!projections[eye])
      throw InputError(name + ": has no line 'P" + std::to_string(eye) +
                       ":'; P0 (left) and P1 (right) are needed");
  return rig_of_projections(*projections[0], *projections[1], name);
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

StereoCalibration read_calibration(const std::filesystem::path& path) {
  const std::string text = read_text_file(path);
  if (path.extension() == ".txt") return {parse_kitti_calibration(text, path.string()), std::nullopt};
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
