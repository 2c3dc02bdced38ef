// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The nearshore simulator: what a stereo rig on a small boat sees, with the truth beside it.
//
//   Simulator simulator(load_scene("bank"), 1);
//   while (auto frame = simulator.next()) slam.track(frame->images.timestamp, frame->images.left,
//   frame->images.right);
//
// The same scene and seed give the same bits at any number of threads (on one kind of processor: Embree
// chooses its code by it).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "spslam/base/se3.h"
#include "spslam/camera/stereo_frame.h"
#include "spslam/camera/stereo_rig.h"
#include "spslam/sim/motion.h"
#include "spslam/sim/scene_description.h"

namespace spslam::sim {

// Depth and masks of a left image.
struct FrameTruth {
  cv::Mat depth;                    // CV_32FC1, m along the optical axis, 0 = sky; on water the calm plane
  cv::Mat water, sky, far, moving;  // CV_8UC1, 255 = yes; far = sky or depth > truth.far_depth
};

struct SimulatedFrame {
  int index = 0;        // of the rig's clock; dropped frames leave gaps
  double time = 0;      // s, when the left eye really exposed
  StereoFrame images;   // with the time as it is written (timing.timestamp_jitter)
  SE3 world_from_left;  // world: z up, calm water at z = 0
  double exposure_log2 = 0;
};

class Simulator {
 public:
  // Throws OptionError for a scene that cannot be.
  Simulator(const SceneDescription& scene, std::uint32_t seed);
  ~Simulator();
  Simulator(Simulator&&) noexcept;

  const SceneDescription& scene() const;
  StereoRig rig() const { return scene().stereo_rig(); }
  const BoatMotion& motion() const;
  int frame_count() const;  // on the whole way, dropped ones counted
  std::size_t quad_count() const;

  // The next frame that is not dropped, or nothing at the end of the way.
  std::optional<SimulatedFrame> next();
  // Exact depth and masks of the left eye at a time, or of a camera anywhere (rig() as its calibration).
  FrameTruth truth(double time) const;
  FrameTruth truth(double time, const SE3& world_from_camera) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace spslam::sim
