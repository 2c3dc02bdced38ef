// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// From radiance to grey values: automatic exposure, vignetting, noise, gamma.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "spslam/sim/scene_options.h"

namespace spslam::sim {

// Steers the mean grey value to a target, after a delay and in steps, as cameras do.
class AutoExposure {
 public:
  explicit AutoExposure(const SensorOptions& options) : options_(options) {}

  // log2 of the factor from radiance to the sensor's full scale, for an image taken now; the first call
  // settles at once.
  double value() const { return applied_; }
  // Learns from the radiance of an image `elapsed` s after the one before.
  void observe(const cv::Mat& radiance, double elapsed);

 private:
  double wanted(const cv::Mat& radiance) const;

  SensorOptions options_;
  double exact_ = 0, applied_ = 0;
  bool settled_ = false;
};

// CV_8UC1. `gain` is that of this eye, `key` the noise's random number.
cv::Mat expose(const cv::Mat& radiance, double exposure_log2, double gain, const SensorOptions& options,
               std::uint32_t key);

}  // namespace spslam::sim
