// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The files of each layout.

#include <oneapi/tbb/parallel_for.h>

#include <cmath>
#include <cstdio>
#include <opencv2/imgcodecs.hpp>

#include "spslam/base/error.h"
#include "spslam/io/calibration.h"
#include "spslam/io/text.h"
#include "spslam/sim/dataset_writer.h"

namespace spslam::sim {
namespace {

namespace fs = std::filesystem;

void make_folder(const fs::path& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code) throw OutputError("cannot make the folder " + folder.string() + ": " + code.message());
}

void write_image(const fs::path& path, const cv::Mat& image) {
  bool written = false;
  try {
    written = path.extension() == ".jpg"
                  ? cv::imwrite(path.string(), image, {cv::IMWRITE_JPEG_QUALITY, 92})
                  : cv::imwrite(path.string(), image, {cv::IMWRITE_PNG_COMPRESSION, 1});
  } catch (const cv::Exception&) {
    written = false;  // reported below, in this project's words
  }
  std::error_code code;
  // OpenCV does not notice a disk that fills up while the last bytes are flushed: a cut file is shorter than
  // any image.
  if (!written || fs::file_size(path, code) < 60 || code)
    throw OutputError("cannot write " + path.string() + "; is the disk full, or the folder not writable?");
}

std::string numbered(int number, const char* ending) {
  char text[32];
  std::snprintf(text, sizeof text, "%06d%s", number, ending);
  return text;
}

std::int64_t nanoseconds(double time) {
  return std::llround(time * 1e9);
}

Trajectory in_world(std::span<const FrameRecord> records) {
  Trajectory trajectory;
  for (const FrameRecord& record : records) trajectory.push_back({record.timestamp, record.world_from_left});
  return trajectory;
}

Trajectory in_first_camera(std::span<const FrameRecord> records) {
  Trajectory trajectory = in_world(records);
  const SE3 first_from_world = records.empty() ? SE3() : records.front().world_from_left.inverse();
  for (StampedPose& pose : trajectory) pose.world_from_camera = first_from_world * pose.world_from_camera;
  return trajectory;
}

std::string joined(std::initializer_list<double> values, int digits) {
  std::string text;
  for (const double value : values) {
    text += ",";
    text += fixed_text(value, digits);
  }
  return text;
}

std::string sensor_yaml(const StereoRig& rig, const SE3& body_from_camera, double rate) {
  std::string matrix;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      matrix += fixed_text(body_from_camera.rotation(row, column), 12) + ", ";
    matrix += fixed_text(body_from_camera.translation(row), 9) + ", ";
  }
  return "sensor_type: camera\nT_BS:\n  cols: 4\n  rows: 4\n  data: [" + matrix +
         "0.0, 0.0, 0.0, 1.0]\nrate_hz: " + fixed_text(rate, 3) + "\nresolution: [" +
         std::to_string(rig.width) + ", " + std::to_string(rig.height) +
         "]\ncamera_model: pinhole\nintrinsics: [" + fixed_text(rig.fx, 6) + ", " + fixed_text(rig.fy, 6) +
         ", " + fixed_text(rig.cx, 6) + ", " + fixed_text(rig.cy, 6) +
         "]\ndistortion_model: radial-tangential\ndistortion_coefficients: [0.0, 0.0, 0.0, 0.0]\n";
}

std::string imu_csv(std::span<const ImuSample> imu) {
  std::string text = "#timestamp [ns],w_x [rad/s],w_y,w_z,a_x [m/s^2],a_y,a_z (x bow, y left, z up)\n";
  for (const ImuSample& s : imu)
    text += std::to_string(nanoseconds(s.time)) +
            joined({s.angular_rate.x(), s.angular_rate.y(), s.angular_rate.z(), s.acceleration.x(),
                    s.acceleration.y(), s.acceleration.z()},
                   9) +
            "\n";
  return text;
}

}  // namespace

LayoutWriter::LayoutWriter(Layout layout, fs::path folder, const Simulator& simulator)
    : layout_(layout), folder_(std::move(folder)), simulator_(simulator) {
  const char* names[3][2] = {{"image_0", "image_1"},
                             {"mav0/cam0/data", "mav0/cam1/data"},
                             {"PIC_Left_Rectified", "PIC_Right_Rectified"}};
  left_ = folder_ / names[static_cast<int>(layout)][0];
  right_ = folder_ / names[static_cast<int>(layout)][1];
  make_folder(left_);
  make_folder(right_);
  const TruthOptions& truth = simulator.scene().truth;
  if (truth.depth_every > 0) make_folder(folder_ / "depth");
  if (truth.mask_every > 0)
    for (const char* name : {"water_mask", "sky_mask", "far_mask", "moving_mask"})
      make_folder(folder_ / name);
}

std::string LayoutWriter::image_name(const SimulatedFrame& frame) const {
  if (layout_ == Layout::kEuroc) return std::to_string(nanoseconds(frame.images.timestamp)) + ".png";
  return numbered(written_, layout_ == Layout::kKitti ? ".png" : ".jpg");
}

void LayoutWriter::add(const SimulatedFrame& frame) {
  const std::string name = image_name(frame);
  tbb::parallel_for(0, 2, [&](int eye) {
    write_image((eye == 0 ? left_ : right_) / name, eye == 0 ? frame.images.left : frame.images.right);
  });
  write_truth(frame);
  ++written_;
}

void LayoutWriter::write_truth(const SimulatedFrame& frame) const {
  const TruthOptions& options = simulator_.scene().truth;
  const bool depth = options.depth_every > 0 && written_ % options.depth_every == 0;
  const bool masks = options.mask_every > 0 && written_ % options.mask_every == 0;
  if (!depth && !masks) return;
  const FrameTruth truth = simulator_.truth(frame.time, frame.world_from_left);
  const std::string name = numbered(written_, ".png");
  if (depth) {
    cv::Mat centimetres;
    truth.depth.convertTo(centimetres, CV_16UC1, 100);  // rounds, and saturates at 655 m
    write_image(folder_ / "depth" / name, centimetres);
  }
  if (!masks) return;
  write_image(folder_ / "water_mask" / name, truth.water);
  write_image(folder_ / "sky_mask" / name, truth.sky);
  write_image(folder_ / "far_mask" / name, truth.far);
  write_image(folder_ / "moving_mask" / name, truth.moving);
}

void LayoutWriter::finish(std::span<const FrameRecord> records, std::span<const ImuSample> imu,
                          std::span<const GnssFix> gnss) const {
  std::string exposures;
  for (std::size_t i = 0; i < records.size(); ++i)
    exposures += std::to_string(i) + " " + fixed_text(records[i].exposure_log2, 4) + "\n";
  write_text_file(folder_ / "exposure_log2.txt", exposures);
  if (!records.empty()) {
    const std::string first = format_kitti_poses({{0, records.front().world_from_left}});
    write_text_file(folder_ / "world_from_first_camera.txt",
                    "# 3x4 row-major; world z up, water plane z=0\n" + first);
  }
  std::string fixes =
      "#time [s],east [m],north [m],up [m],horizontal deviation [m] (of the boat, not of the camera)\n";
  for (const GnssFix& fix : gnss)
    fixes += fixed_text(fix.time, 6) +
             joined({fix.position.x(), fix.position.y(), fix.position.z(), fix.deviation}, 4) + "\n";
  if (!gnss.empty()) write_text_file(folder_ / "gnss.csv", fixes);
  write_text_file(folder_ / "groundtruth_tum.txt", format_tum(in_first_camera(records)));
  switch (layout_) {
    case Layout::kKitti:
      finish_kitti(records);
      if (!imu.empty()) write_text_file(folder_ / "imu.csv", imu_csv(imu));
      return;
    case Layout::kEuroc:
      return finish_euroc(records, imu);
    case Layout::kUsvinland:
      return finish_usvinland(records, imu);
  }
}

void LayoutWriter::finish_kitti(std::span<const FrameRecord> records) const {
  write_text_file(folder_ / "calib.txt", format_kitti_calibration(simulator_.rig()));
  std::string times;
  for (const FrameRecord& record : records) times += fixed_text(record.timestamp, 9) + "\n";
  write_text_file(folder_ / "times.txt", times);
  write_text_file(folder_ / "poses.txt", format_kitti_poses(in_first_camera(records)));
}

void LayoutWriter::finish_euroc(std::span<const FrameRecord> records, std::span<const ImuSample> imu) const {
  const SE3& body_from_left = simulator_.motion().body_from_left();
  const StereoRig rig = simulator_.rig();
  const SE3 body_from_right = body_from_left * SE3{Eigen::Matrix3d::Identity(), {rig.baseline, 0, 0}};
  std::string list = "#timestamp [ns],filename\n";
  for (const FrameRecord& record : records) {
    const std::string stamp = std::to_string(nanoseconds(record.timestamp));
    list += stamp + "," + stamp + ".png\n";
  }
  const fs::path mav = folder_ / "mav0";
  for (const int eye : {0, 1}) {
    const fs::path camera = mav / (eye == 0 ? "cam0" : "cam1");
    write_text_file(camera / "data.csv", list);
    write_text_file(camera / "sensor.yaml", sensor_yaml(rig, eye == 0 ? body_from_left : body_from_right,
                                                        simulator_.scene().rig.rate));
  }
  make_folder(mav / "state_groundtruth_estimate0");
  write_text_file(mav / "state_groundtruth_estimate0" / "data.csv",
                  format_euroc_ground_truth(in_world(records), body_from_left));
  if (imu.empty()) return;
  make_folder(mav / "imu0");
  write_text_file(mav / "imu0" / "data.csv", imu_csv(imu));
}

void LayoutWriter::finish_usvinland(std::span<const FrameRecord> records,
                                    std::span<const ImuSample> imu) const {
  write_text_file(folder_ / "calibration.yaml", format_calibration_yaml(simulator_.rig()));
  std::string times;
  for (const FrameRecord& record : records) times += fixed_text(record.timestamp, 6) + "\n";
  write_text_file(folder_ / "Stereo_Timestamp.txt", times);
  write_text_file(folder_ / "GPSBase.csv", format_usvinland_gps(in_world(records)));
  if (imu.empty()) return;
  // Seven columns as the boat's own: t, acceleration in g, angular rate in deg/s; then unix seconds (the run
  // starts at 0).
  std::string text;
  for (const ImuSample& s : imu) {
    const Eigen::Vector3d g = s.acceleration / 9.81, rate = s.angular_rate * (180 / M_PI);
    text +=
        fixed_text(s.time, 6) + joined({g.x(), g.y(), g.z(), rate.x(), rate.y(), rate.z(), s.time}, 6) + "\n";
  }
  write_text_file(folder_ / "IMU.csv", text);
}

}  // namespace spslam::sim
