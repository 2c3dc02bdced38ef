// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/base/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "spslam/base/error.h"

namespace spslam {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) {
  throw InputError(path.string() + " " + what);
}

[[noreturn]] void fail_with_reason(const std::filesystem::path& path) {
  const int reason = errno;
  if (reason == ENOENT) fail(path, "does not exist; check the path");
  fail(path, std::string("cannot be read (") + std::strerror(reason) + "); check its permissions");
}

struct Handle {
  int value;
  explicit Handle(int opened) : value(opened) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (value >= 0) ::close(value);
  }
};

}  // namespace

MappedFile::MappedFile(const std::filesystem::path& path) {
  // Without waiting for somebody to write, should it be a pipe.
  const Handle file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status = {};
  if (file.value < 0 || ::fstat(file.value, &status) != 0) fail_with_reason(path);
  if (S_ISDIR(status.st_mode)) fail(path, "is a folder, a file is needed");
  if (!S_ISREG(status.st_mode)) fail(path, "is a device or a pipe, a file is needed");
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size == 0) return;
  void* memory = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.value, 0);
  if (memory == MAP_FAILED) fail_with_reason(path);
  mapping_ = std::shared_ptr<const void>(memory, [size](void* mapped) { ::munmap(mapped, size); });
  bytes_ = {static_cast<const std::byte*>(memory), size};
}

}  // namespace spslam
