// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The procedures behind the textures: masonry, rubble, bark and so on.
#pragma once

#include <cstdint>
#include <vector>

#include "spslam/sim/texture.h"

namespace spslam::sim {

std::vector<float> noise_pattern(std::uint32_t seed);

// One texture a Material, in the enum's order; those that are not used stay empty.
std::vector<Texture> patterns(std::uint32_t seed, const MaterialSet& used);

}  // namespace spslam::sim
