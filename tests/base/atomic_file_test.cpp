// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/base/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <fstream>
#include <string>

#include "base/temporary_folder.h"
#include "spslam/base/error.h"

namespace spslam {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class AtomicFile : public testing::Test {
 protected:
  static void write(const fs::path& path, const std::string& text) {
    write_file_atomically(path, std::as_bytes(std::span(text)));
  }
  static std::string read(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {}));
  }
  static std::string message(const fs::path& path, const std::string& text) {
    try {
      write(path, text);
    } catch (const OutputError& error) {
      return error.what();
    }
    return "no error";
  }

  const test::TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
};

TEST_F(AtomicFile, WritesAndReplaces) {
  write(folder_ / "a", "one");
  EXPECT_EQ(read(folder_ / "a"), "one");
  write(folder_ / "a", "");
  EXPECT_EQ(read(folder_ / "a"), "");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(AtomicFile, CanBeTriedBefore) {
  write(folder_ / "a", "one");
  check_file_writable(folder_ / "a");
  check_file_writable(folder_ / "new");
  EXPECT_EQ(entries(), 1u);
  for (const fs::path& bad : {folder_, folder_ / "none" / "a", fs::path("/dev/full"), folder_ / "a" / "b"})
    EXPECT_THROW(check_file_writable(bad), OutputError) << bad;
  EXPECT_EQ(read(folder_ / "a"), "one");
}

TEST_F(AtomicFile, KeepsPermissionsAndFollowsLinks) {
  write(folder_ / "a", "one");
  fs::permissions(folder_ / "a", fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
  fs::create_symlink("a", folder_ / "link");
  write(folder_ / "link", "two");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(read(folder_ / "a"), "two");
  EXPECT_EQ(fs::status(folder_ / "a").permissions(),
            fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
}

TEST_F(AtomicFile, NewFileHasTheUsualPermissions) {
  const mode_t before = ::umask(027);
  write(folder_ / "a", "one");
  ::umask(before);
  EXPECT_EQ(static_cast<unsigned>(fs::status(folder_ / "a").permissions()), 0640u);
}

// A limit on the size of files stands for the full disk: writing stops in the middle all the same.
TEST_F(AtomicFile, FullDiskLeavesTheOldFileWhole) {
  write(folder_ / "a", "the old one");
  rlimit limit = {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small = {4096, limit.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string problem = message(folder_ / "a", std::string(100000, 'x'));
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(problem, HasSubstr("what was there before is unchanged"));
  EXPECT_EQ(read(folder_ / "a"), "the old one");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(AtomicFile, SaysWhatIsWrong) {
  EXPECT_THAT(message(folder_ / "none" / "a", "x"), HasSubstr("No such file or directory"));
  EXPECT_THAT(message(folder_, "x"), HasSubstr("Is a directory"));
  EXPECT_THAT(message("/dev/null", "x"), HasSubstr("is a device or a pipe"));
}

TEST(Crc32, OfTheStandardsExample) {
  EXPECT_EQ(crc32(std::as_bytes(std::span("123456789", 9))), 0xCBF43926u);
  EXPECT_EQ(crc32({}), 0u);
}

}  // namespace
}  // namespace spslam
