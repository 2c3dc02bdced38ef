// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Feeds bytes to the vocabulary's readers, as DBoW2's text and as the binary file, this also with the
// checksum that it should have. What is accepted must be of use.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "spslam/base/atomic_file.h"
#include "spslam/base/error.h"
#include "spslam/loop/vocabulary.h"

namespace {

using spslam::Vocabulary;

void use(const Vocabulary& vocabulary) {
  const spslam::Descriptor descriptors[] = {{}, {1, 2, 3, 4}, {~0ULL, ~0ULL, ~0ULL, ~0ULL}};
  for (const auto& [word, share] : vocabulary.describe(descriptors).words)
    if (word >= static_cast<unsigned>(vocabulary.nodes()) || !(share > 0 && share <= 1)) std::abort();
  if (vocabulary.group(descriptors, 1).nodes.empty()) std::abort();
}

template <class F>
void accept_or_refuse(F read) {
  try {
    use(read());
  } catch (const spslam::InputError&) {
  }
}

void with_right_checksum(std::span<const std::byte> bytes) {
  std::vector<std::byte> file(bytes.begin(), bytes.end());
  const std::uint64_t size = file.size();
  std::memcpy(file.data() + 16, &size, sizeof size);
  const std::uint32_t checksum = spslam::crc32(std::span(file).subspan(16));
  std::memcpy(file.data() + 12, &checksum, sizeof checksum);
  accept_or_refuse([&] { return Vocabulary::parse(file, "fuzz"); });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::byte> bytes(reinterpret_cast<const std::byte*>(data), size);
  accept_or_refuse([&] { return Vocabulary::parse(bytes, "fuzz"); });
  if (size >= 24) with_right_checksum(bytes);
  accept_or_refuse([&] {
    return Vocabulary::parse_dbow2_text({reinterpret_cast<const char*>(data), size}, "fuzz");
  });
  return 0;
}
