// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// What a simulated run consists of: every number of a scene, its boat, its rig and its troubles, as options.
// A named scene is a YAML file of these (config/scenes); `--set shore.right.distance=4` changes one.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "spslam/base/options.h"
#include "spslam/camera/stereo_rig.h"
#include "spslam/sim/scene_options.h"

namespace spslam::sim {

struct SceneDescription {
  std::string title = "a scene without a title";
  int passage = 0;
  PathOptions path;
  ShoreOptions shore;
  BackdropOptions backdrop;
  BridgeOptions bridge;
  SkyOptions sky;
  WaterOptions water;
  AirOptions air;
  TrafficOptions traffic;
  MotionOptions motion;
  RigOptions rig;
  SensorOptions sensor;
  MisalignmentOptions misalignment;
  TimingOptions timing;
  RainOptions rain;
  TruthOptions truth;
  ImuOptions imu;
  GnssOptions gnss;
  RenderOptions render;

  // Throws OptionError for a value out of range or a rig that cannot exist (field of view over 160 degrees).
  void check() const;
  // The calibration that is written: that of the ideal rig, whatever MisalignmentOptions does to the true
  // one.
  StereoRig stereo_rig() const;
  // Of all that differs between two passages of the scene with that seed.
  std::uint32_t passage_seed(std::uint32_t seed) const;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.title, {"title", "", "what the scene shows, one line"});
    visit(self.passage, {"passage", "",
                         "0, or another passage along the same way past the same shores, with waves, motion, "
                         "boats and noise of its own",
                         0, 1e6});
    visit.group("path", self.path);
    visit.group("shore", self.shore);
    visit.group("backdrop", self.backdrop);
    visit.group("bridge", self.bridge);
    visit.group("sky", self.sky);
    visit.group("water", self.water);
    visit.group("air", self.air);
    visit.group("traffic", self.traffic);
    visit.group("motion", self.motion);
    visit.group("rig", self.rig);
    visit.group("sensor", self.sensor);
    visit.group("misalignment", self.misalignment);
    visit.group("timing", self.timing);
    visit.group("rain", self.rain);
    visit.group("truth", self.truth);
    visit.group("imu", self.imu);
    visit.group("gnss", self.gnss);
    visit.group("render", self.render);
  }
};

// Names of the scenes that come with the library, in alphabetical order.
std::vector<std::string> scene_names();

// A named scene, or the YAML file at that path. Throws OptionError with the nearest known scene or key.
SceneDescription load_scene(const std::string& name_or_path);

// The same from text; `source` stands in messages ("scenes/bank.yaml").
SceneDescription parse_scene(const std::string& yaml, const std::string& source);

// Sets "shore.right.distance=4" and the like; does not check ranges (check() does).
void apply_setting(SceneDescription& scene, const std::string& assignment);

}  // namespace spslam::sim
