// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include "base/temporary_folder.h"
#include "loop/synthetic_places.h"
#include "spslam/base/atomic_file.h"
#include "spslam/base/error.h"
#include "spslam/loop/vocabulary.h"

namespace spslam {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using Bytes = std::vector<std::byte>;

Vocabulary trained() {
  SyntheticPlaces places(12, 60);
  VocabularyOptions options;
  options.branching = 5;
  options.levels = 3;
  return Vocabulary::train(places.images_of_all(), options);
}

template <class T>
void put(Bytes& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}
// As a writer would who means what is in it.
void seal(Bytes& bytes) {
  put(bytes, 16, std::uint64_t{bytes.size()});
  put(bytes, 12, crc32(std::span(bytes).subspan(16)));
}
std::size_t nodes_in(const Bytes& bytes) {
  return (bytes.size() - 68) / 40;
}
std::size_t weights_at(const Bytes& bytes) {
  return 64 + 32 * nodes_in(bytes);
}
std::size_t children_at(const Bytes& bytes) {
  return 64 + 36 * nodes_in(bytes);
}

TEST(VocabularyFile, RoundTripIsBitExact) {
  const Vocabulary vocabulary = trained();
  const test::TemporaryFolder folder;
  const fs::path path = folder.path() / "trained.spv";
  vocabulary.save(path);
  const Vocabulary opened = Vocabulary::open(path);
  EXPECT_EQ(Bytes(opened.bytes().begin(), opened.bytes().end()),
            Bytes(vocabulary.bytes().begin(), vocabulary.bytes().end()));
  EXPECT_EQ(opened.words(), vocabulary.words());
  EXPECT_EQ(opened.images(), 12);
  SyntheticPlaces places(2, 100, 9);
  const std::vector<Descriptor> image = places.image(1);
  EXPECT_EQ(opened.describe(image), vocabulary.describe(image));
  EXPECT_EQ(opened.group(image, 1), vocabulary.group(image, 1));
}

TEST(VocabularyFile, MappedMemoryOutlivesTheFilesNameAndOtherCopies) {
  const test::TemporaryFolder folder;
  const fs::path path = folder.path() / "trained.spv";
  const Vocabulary vocabulary = trained();
  vocabulary.save(path);
  Vocabulary copy;
  {
    const Vocabulary opened = Vocabulary::open(path);
    copy = opened;
  }
  fs::remove(path);
  const std::vector<Descriptor> image = SyntheticPlaces(1, 100, 9).image(0);
  EXPECT_EQ(copy.describe(image), vocabulary.describe(image));
}

struct Corruption {
  const char* name;
  void (*spoil)(Bytes&);
  const char* message;
};
void PrintTo(const Corruption& corruption, std::ostream* out) {
  *out << corruption.name;
}

class DamagedVocabulary : public testing::TestWithParam<Corruption> {};

TEST_P(DamagedVocabulary, IsRefusedWithTheReason) {
  const Vocabulary vocabulary = trained();
  Bytes bytes(vocabulary.bytes().begin(), vocabulary.bytes().end());
  GetParam().spoil(bytes);
  try {
    (void)Vocabulary::parse(bytes, "some.spv");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(GetParam().message));
    EXPECT_THAT(error.what(), testing::StartsWith("some.spv: "));
  }
}

const Corruption kCorruptions[] = {
    {"empty", [](Bytes& b) { b.clear(); }, "is empty"},
    {"foreign", [](Bytes& b) { b[0] = std::byte{'P'}; }, "is not a vocabulary of SP-SLAM"},
    {"text", [](Bytes& b) { b.assign(100, std::byte{'1'}); }, "use `spslam vocabulary convert`"},
    {"half_a_magic", [](Bytes& b) { b.resize(5); }, "ends within its header"},
    {"half_a_header", [](Bytes& b) { b.resize(63); }, "ends within its header"},
    {"newer", [](Bytes& b) { put(b, 8, 2U); }, "is a vocabulary of format 2, this program reads format 1"},
    {"truncated", [](Bytes& b) { b.resize(b.size() - 1); }, "bytes, should have"},
    {"longer", [](Bytes& b) { b.push_back({}); }, "bytes, should have"},
    {"flipped_bit", [](Bytes& b) { b[b.size() / 2] ^= std::byte{4}; }, "does not have the checksum"},
    {"flipped_count", [](Bytes& b) { b[24] ^= std::byte{1}; }, "does not have the checksum"},
    {"too_many_nodes", [](Bytes& b) { put(b, 24, 0xFFFFFFFFU), seal(b); }, "cannot hold 4294967295 nodes"},
    {"no_nodes", [](Bytes& b) { put(b, 24, 0U), seal(b); }, "cannot hold 0 nodes"},
    {"root_is_own_child", [](Bytes& b) { put(b, children_at(b), 0U), seal(b); }, "no tree"},
    {"child_is_outside", [](Bytes& b) { put(b, children_at(b) + 8, 1U << 30), seal(b); }, "no tree"},
    {"loop", [](Bytes& b) { put(b, children_at(b) + 16, 2U), seal(b); }, "no tree"},
    {"other_words", [](Bytes& b) { put(b, 28, 7U), seal(b); }, "than it says"},
    {"other_levels", [](Bytes& b) { put(b, 36, 9U), seal(b); }, "than it says"},
    {"fewer_branches", [](Bytes& b) { put(b, 32, 2U), seal(b); }, "than it says"},
    {"too_many_branches", [](Bytes& b) { put(b, 32, 21U), seal(b); }, "at most 10 and 20"},
    {"weight_below_0", [](Bytes& b) { put(b, weights_at(b) + 4, -1.0F), seal(b); }, "a weight that is none"},
    {"weight_nan", [](Bytes& b) { put(b, weights_at(b) + 4, 0x7FC00000U), seal(b); },
     "a weight that is none"},
};
INSTANTIATE_TEST_SUITE_P(Each, DamagedVocabulary, testing::ValuesIn(kCorruptions),
                         [](const auto& test) { return test.param.name; });

TEST(VocabularyFile, SaysWhyItCannotBeOpened) {
  EXPECT_THROW(Vocabulary::open("no/such/file.spv"), InputError);
  EXPECT_THROW(Vocabulary::open(test::TemporaryFolder().path()), InputError);
  EXPECT_THROW(trained().save("no/such/folder/file.spv"), OutputError);
}

TEST(VocabularyTree, IsChecked) {
  VocabularyTree tree;
  EXPECT_THROW(Vocabulary{tree}, InputError);
  tree = {{{}, {1}, {2}}, {0, 1, 1}, {1, 3, 3, 3}, 2, 1, 5};
  EXPECT_EQ(Vocabulary(tree).words(), 2);
  tree.first_child = {1, 3, 2, 3};
  EXPECT_THROW(Vocabulary{tree}, InputError);
}

}  // namespace
}  // namespace spslam
