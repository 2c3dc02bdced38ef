// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/sim/simulator.h"

#include <algorithm>
#include <cmath>

#include "spslam/sim/hash.h"
#include "spslam/sim/rain.h"
#include "spslam/sim/renderer.h"
#include "spslam/sim/sensor.h"

namespace spslam::sim {
namespace {

SceneDescription checked(const SceneDescription& scene) {
  scene.check();
  return scene;
}

EyeView left_view(const SceneDescription& scene, const SE3& world_from_left) {
  const StereoRig rig = scene.stereo_rig();
  return {world_from_left, rig.fx, rig.cx, rig.cy, rig.width, rig.height};
}

// The right eye as it really sits: a knock shifts and turns its image against what the calibration says.
EyeView right_view(const SceneDescription& scene, const SE3& world_from_left) {
  EyeView view = left_view(scene, world_from_left);
  const SE3 left_from_right{so3_exp({0, 0, scene.misalignment.rotation * M_PI / 180}),
                            {scene.rig.baseline, 0, 0}};
  view.world_from_eye = world_from_left * left_from_right;
  view.cx -= scene.misalignment.disparity_offset;
  view.cy += scene.misalignment.row_offset;
  return view;
}

}  // namespace

struct Simulator::Parts {
  Parts(const SceneDescription& description, std::uint32_t the_seed)
      : scene(checked(description)),
        seed(scene.passage_seed(the_seed)),
        motion(scene, the_seed),
        tracer(scene, build_world(scene, motion, the_seed), motion.way(), the_seed),
        exposure(scene.sensor) {}

  cv::Mat view_radiance(const EyeView& view, const EyeView& left, double time, std::uint32_t eye,
                        int index) const {
    const std::uint32_t key = mix(seed, static_cast<std::uint32_t>(index), eye);
    cv::Mat image = render_view(tracer, tracer.instant(time), view, scene.render, key);
    if (scene.rain.intensity > 0)
      add_streaks(image, left, view, scene.rain.intensity, static_cast<float>(1.1 * scene.sky.brightness),
                  mix(seed, static_cast<std::uint32_t>(index), 9));
    add_lens_drops(image, scene.rain, time, eye, seed);
    return image;
  }

  bool dropped(int index) const {
    return index > 0 &&
           unit(mix(seed, static_cast<std::uint32_t>(index), 21)) < static_cast<float>(scene.timing.dropped);
  }

  double written_time(int index) const {
    const double period = 1 / scene.rig.rate;
    const auto error = static_cast<double>(normal(mix(seed, static_cast<std::uint32_t>(index), 22)));
    // Clocks are bad, but not so bad as to run backwards.
    const double jitter = std::clamp(scene.timing.timestamp_jitter * error, -0.4 * period, 0.4 * period);
    return index == 0 ? 0 : index * period + jitter;
  }

  SimulatedFrame make(int index) {
    SimulatedFrame result;
    result.index = index;
    result.time = index / scene.rig.rate;
    result.images.timestamp = written_time(index);
    result.world_from_left = motion.world_from_left(result.time);
    const double right_time = result.time + scene.timing.eye_delay;
    const EyeView left = left_view(scene, result.world_from_left);
    const cv::Mat left_light = view_radiance(left, left, result.time, 0, index);
    const SE3 left_then =
        scene.timing.eye_delay == 0 ? result.world_from_left : motion.world_from_left(right_time);
    const cv::Mat right_light =
        view_radiance(right_view(scene, left_then), left_view(scene, left_then), right_time, 1, index);
    if (index == 0) exposure.observe(left_light, 0);
    result.exposure_log2 = exposure.value();
    const std::uint32_t key = mix(seed, static_cast<std::uint32_t>(index), 31);
    result.images.left = expose(left_light, result.exposure_log2, 1, scene.sensor, key);
    result.images.right = expose(right_light, result.exposure_log2, 1 + scene.sensor.gain_difference,
                                 scene.sensor, mix(key, 1));
    exposure.observe(left_light, result.time - last_time);
    last_time = result.time;
    return result;
  }

  SceneDescription scene;
  std::uint32_t seed;  // of this passage
  BoatMotion motion;
  Tracer tracer;
  AutoExposure exposure;
  int frame = 0;
  double last_time = 0;
};

Simulator::Simulator(const SceneDescription& scene, std::uint32_t seed)
    : parts_(std::make_unique<Parts>(scene, seed)) {}
Simulator::~Simulator() = default;
Simulator::Simulator(Simulator&&) noexcept = default;

const SceneDescription& Simulator::scene() const {
  return parts_->scene;
}
const BoatMotion& Simulator::motion() const {
  return parts_->motion;
}
std::size_t Simulator::quad_count() const {
  return parts_->tracer.quad_count();
}

int Simulator::frame_count() const {
  return static_cast<int>(std::floor(parts_->motion.duration() * parts_->scene.rig.rate)) + 1;
}

std::optional<SimulatedFrame> Simulator::next() {
  while (parts_->frame < frame_count()) {
    const int frame = parts_->frame++;
    if (!parts_->dropped(frame)) return parts_->make(frame);
  }
  return std::nullopt;
}

FrameTruth Simulator::truth(double time) const {
  return truth(time, parts_->motion.world_from_left(time));
}

FrameTruth Simulator::truth(double time, const SE3& world_from_camera) const {
  TruthImages images =
      render_truth(parts_->tracer, parts_->tracer.instant(time), left_view(parts_->scene, world_from_camera),
                   parts_->scene.truth.far_depth);
  return {images.depth, images.water, images.sky, images.far, images.moving};
}

}  // namespace spslam::sim
