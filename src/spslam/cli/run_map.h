// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The maps of a run, before it begins: the one to continue, and where the new one will go.
#pragma once

#include "spslam/camera/stereo_rig.h"
#include "spslam/cli/run_arguments.h"
#include "spslam/map/map.h"

namespace spslam {

// The map to continue, if one is given; refused if it is of another rig.
Map known_map(const RunArguments& arguments, const StereoRig& rig);

// A run may take hours, so what can be known of the map's file is asked before it. Throws OutputError.
void check_map_target(const RunArguments& arguments);

}  // namespace spslam
