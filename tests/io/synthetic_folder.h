// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Small sequences on disk for tests, one writer a format.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "base/temporary_folder.h"
#include "spslam/base/error.h"
#include "spslam/base/random.h"
#include "spslam/io/calibration.h"
#include "spslam/io/text.h"

namespace spslam::test {

namespace fs = std::filesystem;

inline constexpr int kWidth = 64, kHeight = 48, kFrames = 6;

inline StereoRig small_rig() {
  return {.fx = 50, .fy = 50, .cx = 31.5, .cy = 23.5, .baseline = 0.08, .width = kWidth, .height = kHeight};
}

// Noise: no two images are alike, so that a mix-up of frames or eyes shows.
inline cv::Mat noise_image(std::uint64_t seed, int width = kWidth, int height = kHeight) {
  Random random(seed);
  cv::Mat image(height, width, CV_8UC1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(random.below(256));
  return image;
}

inline std::string frame_name(int index, const std::string& extension = ".png") {
  const std::string digits = std::to_string(index);
  return std::string(6 - digits.size(), '0') + digits + extension;
}

inline void write_image(const fs::path& path, const cv::Mat& image) {
  fs::create_directories(path.parent_path());
  ASSERT_TRUE(cv::imwrite(path.string(), image)) << path;
}

// The images of the i-th pair of every writer below.
inline cv::Mat left_image(int index) {
  return noise_image(static_cast<std::uint64_t>(2 * index));
}
inline cv::Mat right_image(int index) {
  return noise_image(static_cast<std::uint64_t>(2 * index + 1));
}

inline void write_images(const fs::path& left, const fs::path& right) {
  for (int i = 0; i < kFrames; ++i) {
    write_image(left / frame_name(i), left_image(i));
    write_image(right / frame_name(i), right_image(i));
  }
}

inline std::string times_text(const std::string& end_of_line = "\n") {
  std::string text;
  for (int i = 0; i < kFrames; ++i) text += fixed_text(0.1 * i, 6) + end_of_line;
  return text;
}

inline fs::path write_kitti(const fs::path& folder) {
  write_images(folder / "image_0", folder / "image_1");
  write_text_file(folder / "calib.txt", format_kitti_calibration(small_rig()));
  write_text_file(folder / "times.txt", times_text());
  return folder;
}

inline fs::path write_plain(const fs::path& folder) {
  write_images(folder / "left", folder / "right");
  write_text_file(folder / "calibration.yaml", format_calibration_yaml(small_rig()));
  write_text_file(folder / "times.txt", times_text());
  return folder;
}

inline fs::path write_usvinland(const fs::path& folder) {
  write_images(folder / "PIC_Left_Rectified", folder / "PIC_Right_Rectified");
  write_text_file(folder / "calibration.yaml", format_calibration_yaml(small_rig()));
  write_text_file(folder / "Stereo_Timestamp.txt", times_text());
  return folder;
}

// One EuRoC sensor.yaml of an undistorted camera at `x` m along the body's x axis.
inline std::string euroc_sensor_text(double x) {
  return "%YAML:1.0\nsensor_type: camera\nT_BS:\n  cols: 4\n  rows: 4\n  data: [1, 0, 0, " +
         fixed_text(x, 3) +
         ",\n         0, 1, 0, 0,\n         0, 0, 1, 0.25,\n         0, 0, 0, 1]\nrate_hz: 20\nresolution: "
         "[64, 48]\n" +
         "camera_model: pinhole\nintrinsics: [50, 50, 31.5, 23.5] #fu, fv, cu, cv\n" +
         "distortion_model: radial-tangential\ndistortion_coefficients: [0, 0, 0, 0]\n";
}

inline constexpr std::int64_t kEurocStart = 1403715273262142976;  // ns

inline fs::path write_euroc(const fs::path& folder) {
  for (const int eye : {0, 1}) {
    const fs::path camera = folder / "mav0" / ("cam" + std::to_string(eye));
    std::string list = "#timestamp [ns],filename\r\n";
    for (int i = 0; i < kFrames; ++i) {
      const std::string time = std::to_string(kEurocStart + i * 50'000'000LL);
      write_image(camera / "data" / (time + ".png"), eye == 0 ? left_image(i) : right_image(i));
      list.append(time).append(",").append(time).append(".png\r\n");
    }
    write_text_file(camera / "data.csv", list);
    write_text_file(camera / "sensor.yaml", euroc_sensor_text(0.08 * eye));
  }
  return folder;
}

template <class F>
std::string message_of(F f) {
  try {
    f();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was thrown";
}

inline bool same_pixels(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

}  // namespace spslam::test
