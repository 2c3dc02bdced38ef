// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// A map that outlives the run. The file: "SPSLMAP" and 0x1A, version (u32), CRC-32 of the payload (u32), size
// of the payload (u64), payload (map_encoding.h); little-endian.
#pragma once

#include <filesystem>

#include "spslam/system/map_encoding.h"

namespace spslam {

// Everything but the pyramids. The file appears whole, or the one that was there before stays. Throws
// OutputError.
void save_map(const std::filesystem::path& path, const Map& map, const StereoRig& rig);
// Throws InputError that says what is wrong with the file and what to do.
SavedMap load_map(const std::filesystem::path& path);
// The content of a map file; name stands for it in messages.
SavedMap parse_map(std::span<const std::byte> file, const std::string& name);

// A map's bearings and depths hold for the rig that made it. Throws InputError that names both calibrations
// and what differs by more than 0.01 px, or 0.01 % of the baseline.
void check_same_rig(const StereoRig& saved, const StereoRig& present);

}  // namespace spslam
