// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Files read in place, as memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>

namespace spslam {

// The content of a file, read from the disk where it is touched; copies share it. The file must not be
// shortened while it is mapped; to be replaced as a whole (write_file_atomically) does it no harm.
class MappedFile {
 public:
  MappedFile() = default;
  // Throws InputError that says why the file cannot be read.
  explicit MappedFile(const std::filesystem::path& path);

  // Begins at a multiple of 64; lives as long as a copy of this.
  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::shared_ptr<const void> mapping_;
  std::span<const std::byte> bytes_;
};

}  // namespace spslam
