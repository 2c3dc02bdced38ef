// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The scenes of config/scenes, compiled in, so that a named scene needs no path and no installed file.
#pragma once

#include <span>

namespace spslam::sim {

struct NamedScene {
  const char* name;
  const char* yaml;
};

std::span<const NamedScene> named_scenes();

}  // namespace spslam::sim
