// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Numbers as bytes, little-endian on every machine.
#pragma once

#include <algorithm>
#include <bit>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "spslam/base/error.h"

namespace spslam {

class ByteWriter {
 public:
  explicit ByteWriter(std::size_t expected_size = 0) { bytes_.reserve(expected_size); }

  template <class T>
  void put(T value) {
    static_assert(std::is_arithmetic_v<T>);
    auto bytes = std::bit_cast<std::array<std::byte, sizeof(T)>>(value);
    if constexpr (std::endian::native == std::endian::big) std::reverse(bytes.begin(), bytes.end());
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  void put_bytes(std::span<const std::uint8_t> bytes) {
    const auto raw = std::as_bytes(bytes);
    bytes_.insert(bytes_.end(), raw.begin(), raw.end());
  }
  std::vector<std::byte> bytes() && { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

// Throws InputError that names the file and the place. The bytes must outlive the reader.
class ByteReader {
 public:
  // name stands for the file in messages.
  ByteReader(std::span<const std::byte> bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}

  std::size_t left() const { return bytes_.size() - at_; }

  template <class T>
  T take() {
    static_assert(std::is_arithmetic_v<T>);
    if (left() < sizeof(T)) fail("ends in the middle of a value");
    std::array<std::byte, sizeof(T)> bytes;
    std::memcpy(bytes.data(), bytes_.data() + at_, sizeof(T));
    if constexpr (std::endian::native == std::endian::big) std::reverse(bytes.begin(), bytes.end());
    at_ += sizeof(T);
    return std::bit_cast<T>(bytes);
  }
  std::vector<std::uint8_t> take_bytes(std::size_t count) {
    if (left() < count) fail("ends in the middle of an image");
    std::vector<std::uint8_t> out(count);
    if (count > 0) std::memcpy(out.data(), bytes_.data() + at_, count);
    at_ += count;
    return out;
  }
  // A number of things that take at least so many bytes each: refused if the file is too short to hold them,
  // before anything is allocated for them.
  std::size_t take_count(std::size_t bytes_each, const char* of_what) {
    const auto count = take<std::uint64_t>();
    if (count > left() / bytes_each)
      fail("says " + std::to_string(count) + " " + of_what + ", has bytes for " +
           std::to_string(left() / bytes_each) + " at most");
    return static_cast<std::size_t>(count);
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(name_ + ": byte " + std::to_string(at_) + ": " + what +
                     "; the file is damaged, use another copy or make it anew");
  }

 private:
  std::span<const std::byte> bytes_;
  std::string name_;
  std::size_t at_ = 0;
};

}  // namespace spslam
