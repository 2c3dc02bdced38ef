// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The options of the system as `spslam run` and `spslam config` take them from the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "spslam/system/slam_options.h"

namespace spslam {

struct OptionArguments {
  Preset preset = Preset::kSpSlam;
  std::string config;                 // YAML file; empty: none
  std::vector<std::string> settings;  // key=value
};

// Adds --preset, --config and --set.
void add_option_arguments(CLI::App& command, OptionArguments& arguments);

// The preset, changed by the file, changed by the settings. Throws OptionError for what is unknown (with the
// nearest known key) or out of range.
SlamOptions effective_options(const OptionArguments& arguments);

// The preset's name as the command line has it.
const char* preset_name(Preset preset);

}  // namespace spslam
