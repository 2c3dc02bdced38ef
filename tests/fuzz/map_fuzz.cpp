// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Feeds bytes to the map file's reader, and, since hardly any get past the checksum, to what reads the
// payload. What is accepted must be a map: it can be written and read again.

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "spslam/base/error.h"
#include "spslam/system/map_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::byte> bytes(reinterpret_cast<const std::byte*>(data), size);
  try {
    (void)spslam::parse_map(bytes, "fuzz");
  } catch (const spslam::InputError&) {
  }
  try {
    const spslam::SavedMap saved = spslam::decode_map(bytes, "fuzz");
    const std::vector<std::byte> again = spslam::encode_map(saved.map, saved.rig);
    if (spslam::encode_map(spslam::decode_map(again, "again").map, saved.rig) != again) std::abort();
  } catch (const spslam::InputError&) {
  }
  return 0;
}
