// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/sim/sensor.h"

#include <gtest/gtest.h>

#include <cmath>

namespace spslam::sim {
namespace {

cv::Mat flat(float radiance) {
  return cv::Mat(120, 160, CV_32FC1, cv::Scalar(radiance));
}

SensorOptions quiet() {
  SensorOptions options;
  options.read_noise = 0;
  options.full_well = 1e6;
  options.vignetting = 0;
  return options;
}

TEST(Sensor, ExposureBringsTheMeanToItsTarget) {
  for (const float radiance : {0.3F, 1.0F, 2.5F}) {
    AutoExposure exposure(quiet());
    exposure.observe(flat(radiance), 0);
    const cv::Mat image = expose(flat(radiance), exposure.value(), 1, quiet(), 1);
    EXPECT_NEAR(cv::mean(image)[0], 255 * quiet().target, 2) << radiance;
  }
}

TEST(Sensor, ExposureFollowsLateAndInSteps) {
  SensorOptions options = quiet();
  options.exposure_delay = 0.5;
  options.exposure_step = 0.3;
  AutoExposure exposure(options);
  exposure.observe(flat(1), 0);
  const double before = exposure.value();
  exposure.observe(flat(0.25F), 0.1);
  EXPECT_LT(exposure.value() - before, 1);  // two stops are wanted
  int changes = 0;
  for (int i = 0; i < 60; ++i) {
    const double last = exposure.value();
    exposure.observe(flat(0.25F), 0.1);
    if (exposure.value() != last) {
      ++changes;
      EXPECT_GE(exposure.value() - last, 0.3);
    }
  }
  EXPECT_GE(changes, 2);
  EXPECT_NEAR(exposure.value() - before, 2, 0.35);
}

TEST(Sensor, LittleLightIsDarkAndNoisy) {
  SensorOptions options;
  options.vignetting = 0;
  AutoExposure day(options), night(options);
  day.observe(flat(1), 0);
  night.observe(flat(0.01F), 0);
  const auto spread = [&](float radiance, double exposure) {
    cv::Scalar mean, deviation;
    cv::meanStdDev(expose(flat(radiance), exposure, 1, options, 7), mean, deviation);
    return std::pair(mean[0], deviation[0]);
  };
  const auto [day_mean, day_noise] = spread(1, day.value());
  const auto [night_mean, night_noise] = spread(0.01F, night.value());
  EXPECT_LT(night_mean, day_mean - 20);
  EXPECT_GT(night_noise, 2 * day_noise);
}

TEST(Sensor, NoiseHasTheSizeOfPhotons) {
  SensorOptions options = quiet();
  options.full_well = 1000;
  options.gamma = 1;
  cv::Scalar mean, deviation;
  cv::meanStdDev(expose(flat(0.5F), 0 - 1.2 + 1.2, 1, options, 7), mean, deviation);
  // At exposure 0 the gain over daylight is 2^1.2: variance = signal * gain / full well.
  EXPECT_NEAR(deviation[0], 255 * std::sqrt(0.5 * std::exp2(1.2) / 1000), 0.3);
  EXPECT_NEAR(mean[0], 127, 1);
}

TEST(Sensor, GainAndVignetting) {
  SensorOptions options = quiet();
  options.gamma = 1;
  const cv::Mat plain = expose(flat(0.4F), 0, 1, options, 1), bright = expose(flat(0.4F), 0, 1.1, options, 1);
  EXPECT_NEAR(cv::mean(bright)[0] / cv::mean(plain)[0], 1.1, 0.01);
  options.vignetting = 0.5;
  const cv::Mat shaded = expose(flat(0.4F), 0, 1, options, 1);
  EXPECT_NEAR(shaded.at<std::uint8_t>(0, 0), 51, 2);
  EXPECT_NEAR(shaded.at<std::uint8_t>(60, 80), 102, 2);
}

}  // namespace
}  // namespace spslam::sim
