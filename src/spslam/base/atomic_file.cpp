// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/base/atomic_file.h"

#include <fcntl.h>
#include <spdlog/fmt/fmt.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

#include "spslam/base/error.h"

namespace spslam {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, int reason) {
  const char* advice = reason == ENOSPC || reason == EDQUOT || reason == EFBIG
                           ? "; make room or choose another place; what was there before is unchanged"
                           : "; check the folder and its permissions";
  throw OutputError(path.string() + " cannot be written: " + std::strerror(reason) + advice);
}

// A file descriptor, and the name that it goes under until it is renamed.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& target)
      : name_((target.parent_path() / fmt::format(".{}.XXXXXX", target.filename().string())).string()) {
    descriptor_ = ::mkostemp(name_.data(), O_CLOEXEC);
    if (descriptor_ < 0) fail(target, errno);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!name_.empty()) ::unlink(name_.c_str());
  }

  // Each returns 0, or why it could not.
  int write(std::span<const std::byte> content) const {
    while (!content.empty()) {
      const ssize_t written = ::write(descriptor_, content.data(), content.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return errno;
      content = content.subspan(static_cast<std::size_t>(written));
    }
    return ::fsync(descriptor_) == 0 ? 0 : errno;
  }
  int set_permissions(mode_t mode) const { return ::fchmod(descriptor_, mode) == 0 ? 0 : errno; }
  int rename_to(const fs::path& target) {
    const int closed = ::close(descriptor_);  // some network disks report a full disk only now
    descriptor_ = -1;
    if (closed != 0 || ::rename(name_.c_str(), target.c_str()) != 0) return errno;
    name_.clear();
    return 0;
  }

 private:
  std::string name_;
  int descriptor_ = -1;
};

mode_t permissions_of(const fs::path& target) {
  struct stat status = {};
  if (::stat(target.c_str(), &status) == 0) return status.st_mode & 07777U;
  const mode_t mask = ::umask(0);  // there is no other way to read it
  ::umask(mask);
  return 0666U & ~mask;
}

// So that the new name, too, survives a power cut. What cannot be flushed (some network disks) is left as is.
void flush_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

// The file itself, where the path is a link to it.
fs::path target_of(const fs::path& path) {
  std::error_code error;
  fs::path target = path;
  if (fs::is_symlink(path, error)) {
    target = fs::canonical(path, error);
    if (error) fail(path, error.value());
  }
  if (fs::is_directory(target, error)) fail(path, EISDIR);
  if (fs::exists(target, error) && !fs::is_regular_file(target, error))
    throw OutputError(path.string() + " is a device or a pipe; give the path of a file");
  return target;
}

}  // namespace

void check_file_writable(const fs::path& path) {
  const TemporaryFile removed_at_once(target_of(path));
}

void write_file_atomically(const fs::path& path, std::span<const std::byte> content) {
  const fs::path target = target_of(path);
  TemporaryFile file(target);
  int reason = file.write(content);
  if (reason == 0) reason = file.set_permissions(permissions_of(target));
  if (reason == 0) reason = file.rename_to(target);
  if (reason != 0) fail(path, reason);
  flush_folder(target.parent_path());
}

std::uint32_t crc32(std::span<const std::byte> bytes) {
  return static_cast<std::uint32_t>(::crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace spslam
