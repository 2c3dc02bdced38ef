// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Binary files that are there whole or not at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace spslam {

// Writes a temporary file in the same folder, flushes it to the disk and renames it: whatever happens (full
// disk, kill, power cut), the path holds the old content or the new one, whole. A link is followed. The
// permissions are those of the file replaced, or the process's usual ones. A killed process leaves a
// ".NAME.XXXXXX" behind, which may be deleted. Throws OutputError that names the path and the reason.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> content);

// Tries whether that would do as far as can be known without writing: a folder that is there and can be
// written to, a path that is neither a folder nor a device. Leaves everything as it was. Throws OutputError.
void check_file_writable(const std::filesystem::path& path);

// CRC-32 (IEEE 802.3, as gzip and PNG have it): 0xCBF43926 for "123456789".
std::uint32_t crc32(std::span<const std::byte> bytes);

}  // namespace spslam
