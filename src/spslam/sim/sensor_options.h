// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The options of a simulated rig's troubles, its truth and its other sensors. Included by scene_options.h.
#pragma once

#include "spslam/base/options.h"

namespace spslam::sim {

struct SensorOptions {
  double read_noise = 0.5;
  double full_well = 9000;
  double vignetting = 0.18;
  double gain_difference = 0.02;
  double target = 0.47;
  double exposure_delay = 0.25;
  double exposure_step = 0.04;
  double exposure_bias = 0;
  double max_gain = 3;
  double gamma = 2.2;
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.read_noise,
          {"read_noise", "grey", "standard deviation of the noise in the dark, of 255, before gain", 0, 50});
    visit(self.full_well, {"full_well", "e-", "electrons at full scale, from which the shot noise", 10, 1e6});
    visit(self.vignetting, {"vignetting", "", "light lost in the corners", 0, 0.9});
    visit(self.gain_difference, {"gain_difference", "", "right over left eye, minus one", -0.5, 0.5});
    visit(self.target,
          {"target", "", "grey level of 1 that the automatic exposure steers the mean to", 0.05, 0.9});
    visit(self.exposure_delay, {"exposure_delay", "s", "time constant of the automatic exposure", 0, 10});
    visit(self.exposure_step,
          {"exposure_step", "stops", "smallest change of exposure; it jumps by such steps", 0, 2});
    visit(self.exposure_bias, {"exposure_bias", "stops", "over- or underexposure wanted", -6, 6});
    visit(self.max_gain, {"max_gain", "stops", "by which the exposure may rise over a sunny day's", 0, 14});
    visit(self.gamma, {"gamma", "", "of the image values", 0.5, 4});
  }
};

struct MisalignmentOptions {
  double row_offset = 0;
  double disparity_offset = 0;
  double rotation = 0;
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.row_offset, {"row_offset", "px", "rows the right image sits too low", -20, 20});
    visit(self.disparity_offset, {"disparity_offset", "px", "added to every disparity", -20, 20});
    visit(self.rotation, {"rotation", "deg", "of the right eye about its axis", -5, 5});
  }
};

struct TimingOptions {
  double dropped = 0;
  double timestamp_jitter = 0;
  double eye_delay = 0;
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.dropped, {"dropped", "", "share of frames that are lost", 0, 0.9});
    visit(self.timestamp_jitter,
          {"timestamp_jitter", "s", "standard deviation of the written times", 0, 0.5});
    visit(self.eye_delay, {"eye_delay", "s", "by which the right eye exposes later", -0.5, 0.5});
  }
};

struct RainOptions {
  double intensity = 0;
  int lens_drops = 0;
  double drop_size = 14;
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.intensity,
          {"intensity", "", "streaks in the air and rings on the water, 1 = heavy rain", 0, 3});
    visit(self.lens_drops, {"lens_drops", "", "drops on each lens at any time", 0, 100});
    visit(self.drop_size, {"drop_size", "px", "mean radius of such a drop", 1, 200});
  }
};

struct TruthOptions {
  int depth_every = 20;
  int mask_every = 20;
  double far_depth = 40;
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.depth_every, {"depth_every", "frames", "between depth maps, 0 = none", 0, 1000000});
    visit(self.mask_every, {"mask_every", "frames", "between masks, 0 = none", 0, 1000000});
    visit(self.far_depth, {"far_depth", "m", "beyond which a pixel is far in the mask", 1, 10000});
  }
};

struct ImuOptions {
  double rate = 100;
  double gyro_noise = 0.0017;
  double gyro_bias = 0.005;
  double gyro_walk = 2e-5;
  double accel_noise = 0.02;
  double accel_bias = 0.05;
  double accel_walk = 3e-3;
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.rate, {"rate", "Hz", "samples, 0 = no such stream", 0, 1000});
    visit(self.gyro_noise, {"gyro_noise", "rad/s/sqrt(Hz)", "noise density", 0, 1});
    visit(self.gyro_bias, {"gyro_bias", "rad/s", "standard deviation of the bias at the start", 0, 1});
    visit(self.gyro_walk, {"gyro_walk", "rad/s^2/sqrt(Hz)", "random walk of the bias", 0, 1});
    visit(self.accel_noise, {"accel_noise", "m/s^2/sqrt(Hz)", "noise density", 0, 10});
    visit(self.accel_bias, {"accel_bias", "m/s^2", "standard deviation of the bias at the start", 0, 10});
    visit(self.accel_walk, {"accel_walk", "m/s^3/sqrt(Hz)", "random walk of the bias", 0, 10});
  }
};

struct GnssOptions {
  double rate = 5;
  double noise = 0.8;
  double wander = 1.5;
  double wander_time = 30;
  double outages = 0.15;
  double outage_duration = 8;
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.rate, {"rate", "Hz", "fixes, 0 = no such stream", 0, 100});
    visit(self.noise, {"noise", "m", "white noise of a fix, standard deviation per horizontal axis", 0, 100});
    visit(self.wander,
          {"wander", "m", "slow error of a fix, standard deviation per horizontal axis", 0, 100});
    visit(self.wander_time, {"wander_time", "s", "time constant of the slow error", 0.1, 10000});
    visit(self.outages, {"outages", "", "share of the time without a fix", 0, 1});
    visit(self.outage_duration, {"outage_duration", "s", "mean length of an outage", 0.2, 1000});
  }
};

}  // namespace spslam::sim
