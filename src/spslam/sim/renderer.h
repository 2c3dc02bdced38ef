// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Images and truth of one eye at one instant.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "spslam/base/se3.h"
#include "spslam/sim/scene_description.h"
#include "spslam/sim/tracer.h"

namespace spslam::sim {

struct EyeView {
  SE3 world_from_eye;
  double focal = 0, cx = 0, cy = 0;  // px
  int width = 0, height = 0;         // px
};

struct TruthImages {
  cv::Mat depth;                    // CV_32FC1, m along the optical axis, 0 = sky; on water the calm plane
  cv::Mat water, sky, far, moving;  // CV_8UC1, 255 = yes
};

// Linear radiance, CV_32FC1. `key` sets the noise of the sampling; the result does not depend on the number
// of threads.
cv::Mat render_view(const Tracer& tracer, const Instant& instant, const EyeView& view,
                    const RenderOptions& options, std::uint32_t key);

// Through the centres of the pixels, exact.
TruthImages render_truth(const Tracer& tracer, const Instant& instant, const EyeView& view, double far_depth);

}  // namespace spslam::sim
