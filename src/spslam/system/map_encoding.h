// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// A map and the rig it was made with as bytes, and back: what a map file holds behind its header. The same
// map gives the same bytes; numbers keep all of their bits.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "spslam/camera/stereo_rig.h"
#include "spslam/map/map.h"

namespace spslam {

struct SavedMap {
  Map map;  // its keyframes without images
  StereoRig rig;
};

// Behind so many bytes for a header. Throws OutputError if the map contradicts itself, for nobody could read
// it.
std::vector<std::byte> encode_map(const Map& map, const StereoRig& rig, std::size_t header_bytes = 0);
// Throws InputError if the bytes are no map or one that contradicts itself; name stands for the file.
SavedMap decode_map(std::span<const std::byte> bytes, const std::string& name);

}  // namespace spslam
