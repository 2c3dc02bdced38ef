// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The binary file. Little-endian, at byte
//    0  "SPSLVOC" and 0x1A
//    8  u32 version        12  u32 CRC-32 of all that follows     16  u64 bytes of the file
//   24  u32 nodes          28  u32 words           32  u32 branching
//   36  u32 levels         40  u32 images          44  20 bytes 0
//   64  nodes x 32 bytes of descriptor; nodes x f32 of weight; (nodes + 1) x u32 of first child
// (VocabularyTree says what these are). Everything is where it can be used in place.

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "spslam/base/atomic_file.h"
#include "spslam/base/error.h"
#include "spslam/base/mapped_file.h"
#include "spslam/loop/vocabulary.h"

namespace spslam {
namespace {

static_assert(std::endian::native == std::endian::little, "files are used in place; they are little-endian");

constexpr std::array<char, 8> kMagic = {'S', 'P', 'S', 'L', 'V', 'O', 'C', '\x1A'};
constexpr std::uint32_t kVersion = 1;

struct Header {
  std::array<char, 8> magic = kMagic;
  std::uint32_t version = kVersion, checksum = 0;
  std::uint64_t size = 0;
  std::uint32_t nodes = 0, words = 0, branching = 0, levels = 0, images = 0;
  std::array<std::uint32_t, 5> unused = {};
};
static_assert(sizeof(Header) == 64);
constexpr std::size_t kChecksumEnd = 16;
constexpr std::uint64_t kBytesANode = sizeof(Descriptor) + sizeof(float) + sizeof(std::uint32_t);

std::uint64_t size_of(std::uint64_t nodes) {
  return sizeof(Header) + nodes * kBytesANode + sizeof(std::uint32_t);
}

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  throw InputError(name + ": " + what);
}

Header check_header(std::span<const std::byte> file, const std::string& name) {
  const std::string damaged = "; the file is damaged, use another copy or train it anew";
  if (file.empty()) refuse(name, "is empty; give a vocabulary that `spslam vocabulary` wrote");
  if (std::memcmp(file.data(), kMagic.data(), std::min(file.size(), kMagic.size())) != 0)
    refuse(name, "is not a vocabulary of SP-SLAM; for one of DBoW2 (text), use `spslam vocabulary convert`");
  if (file.size() < sizeof(Header)) refuse(name, "ends within its header" + damaged);
  Header header;
  std::memcpy(&header, file.data(), sizeof header);
  if (header.version != kVersion)
    refuse(name, fmt::format("is a vocabulary of format {}, this program reads format {}; convert it to text "
                             "with the version of spslam that wrote it, or train it anew",
                             header.version, kVersion));
  if (header.size != file.size())
    refuse(name, fmt::format("has {} bytes, should have {}", file.size(), header.size) + damaged);
  if (crc32(file.subspan(kChecksumEnd)) != header.checksum)
    refuse(name, "does not have the checksum it was written with" + damaged);
  if (header.nodes < 2 || header.size != size_of(header.nodes))
    refuse(name, fmt::format("cannot hold {} nodes in {} bytes", header.nodes, header.size) + damaged);
  return header;
}

// Children follow their parents, and each node but the root is somebody's child, once.
bool is_breadth_first(std::span<const std::uint32_t> first) {
  const std::size_t nodes = first.size() - 1;
  if (first[0] != 1 || first[nodes] != nodes) return false;
  bool good = true;
  for (std::size_t i = 0; i < nodes; ++i) good &= first[i] > i && first[i + 1] >= first[i];
  return good;
}

// Of a tree that is_breadth_first.
std::uint32_t depth_of(std::span<const std::uint32_t> first) {
  std::uint32_t depth = 0, begin = 0, end = 1;
  for (; end < first.size() - 1; ++depth) begin = std::exchange(end, first[end]);
  return begin < end ? depth : 0;
}

struct Shape {
  std::uint32_t words = 0, branching = 0;
};

Shape shape_of(std::span<const std::uint32_t> first) {
  Shape shape;
  for (std::size_t i = 0; i + 1 < first.size(); ++i) {
    const std::uint32_t children = first[i + 1] - first[i];
    shape.words += children == 0;
    shape.branching = std::max(shape.branching, children);
  }
  return shape;
}

void check_tree(const Header& header, std::span<const float> weights, std::span<const std::uint32_t> first,
                const std::string& name) {
  const std::string advice = "; make it anew";
  if (!is_breadth_first(first)) refuse(name, "has nodes that are no tree" + advice);
  const Shape shape = shape_of(first);
  if (shape.words != header.words || depth_of(first) != header.levels || shape.branching > header.branching)
    refuse(name, "has another number of words, levels or branches than it says" + advice);
  if (header.levels > 10 || header.branching > 20)
    refuse(name, fmt::format("has {} levels and {} branches; at most 10 and 20 are used", header.levels,
                             header.branching) +
                     advice);
  bool good = true;
  for (const float weight : weights) good &= weight >= 0 && weight < 1e6F;
  if (!good) refuse(name, "has a weight that is none" + advice);
}

template <class T>
void append(std::vector<std::byte>& out, std::span<const T> values) {
  const auto bytes = std::as_bytes(values);
  out.insert(out.end(), bytes.begin(), bytes.end());
}

std::vector<std::byte> pack(const VocabularyTree& tree) {
  const std::size_t nodes = tree.descriptors.size();
  if (nodes < 2 || nodes > 100'000'000 || tree.weights.size() != nodes ||
      tree.first_child.size() != nodes + 1 || !is_breadth_first(tree.first_child))
    throw InputError("a vocabulary needs a tree of 2 to 100 million nodes, breadth first");
  Header header;
  header.size = size_of(nodes);
  header.nodes = static_cast<std::uint32_t>(nodes);
  header.words = shape_of(tree.first_child).words;
  header.branching = static_cast<std::uint32_t>(tree.branching);
  header.levels = depth_of(tree.first_child);
  header.images = static_cast<std::uint32_t>(tree.images);
  std::vector<std::byte> out;
  out.reserve(header.size);
  append(out, std::span<const Header>(&header, 1));
  append<Descriptor>(out, tree.descriptors);
  append<float>(out, tree.weights);
  append<std::uint32_t>(out, tree.first_child);
  header.checksum = crc32(std::span(out).subspan(kChecksumEnd));
  std::memcpy(out.data(), &header, sizeof header);
  return out;
}

}  // namespace

Vocabulary::Vocabulary(std::shared_ptr<const void> owner, std::span<const std::byte> bytes,
                       const std::string& name)
    : owner_(std::move(owner)), bytes_(bytes) {
  const Header header = check_header(bytes, name);
  const std::byte* at = bytes.data() + sizeof(Header);
  descriptors_ = {reinterpret_cast<const Descriptor*>(at), header.nodes};
  at += descriptors_.size_bytes();
  weights_ = {reinterpret_cast<const float*>(at), header.nodes};
  at += weights_.size_bytes();
  first_child_ = {reinterpret_cast<const std::uint32_t*>(at), header.nodes + 1U};
  check_tree(header, weights_, first_child_, name);
  words_ = static_cast<int>(header.words);
  branching_ = static_cast<int>(header.branching);
  levels_ = static_cast<int>(header.levels);
  images_ = static_cast<int>(header.images);
}

Vocabulary::Vocabulary(const VocabularyTree& tree) : Vocabulary(parse(pack(tree), "vocabulary")) {}

Vocabulary Vocabulary::parse(std::span<const std::byte> file, const std::string& name) {
  // In whole words, for the alignment of what is used in place.
  const auto copy = std::make_shared<std::vector<std::uint64_t>>((file.size() + 7) / 8);
  if (!file.empty()) std::memcpy(copy->data(), file.data(), file.size());
  return {copy, std::as_bytes(std::span(*copy)).first(file.size()), name};
}

Vocabulary Vocabulary::open(const std::filesystem::path& path) {
  const auto file = std::make_shared<MappedFile>(path);
  return {file, file->bytes(), path.string()};
}

void Vocabulary::save(const std::filesystem::path& path) const {
  if (empty()) throw OutputError(path.string() + ": there are no words to write; train the vocabulary first");
  write_file_atomically(path, bytes_);
}

}  // namespace spslam
