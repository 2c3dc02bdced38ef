// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Rain between the camera and the scene, and on the lens.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "spslam/sim/renderer.h"

namespace spslam::sim {

// Streaks of falling drops, bright against dark; the drops are points in space, so both eyes see the same
// ones.
void add_streaks(cv::Mat& radiance, const EyeView& left, const EyeView& view, double intensity,
                 float brightness, std::uint32_t key);

// Drops that sit on the lens for some seconds each: out of focus, showing the scene upside down. `eye` 0
// or 1.
void add_lens_drops(cv::Mat& radiance, const RainOptions& options, double time, std::uint32_t eye,
                    std::uint32_t seed);

}  // namespace spslam::sim
