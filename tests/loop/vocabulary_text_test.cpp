// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "base/temporary_folder.h"
#include "loop/synthetic_places.h"
#include "spslam/base/error.h"
#include "spslam/loop/vocabulary.h"

namespace spslam {
namespace {

using testing::HasSubstr;

// "parent is_leaf", the 32 bytes: one and zeros, and the weight.
std::string node(int parent, int leaf, int first_byte, const std::string& weight) {
  std::string line = std::to_string(parent);
  line.append(" ").append(std::to_string(leaf)).append(" ").append(std::to_string(first_byte));
  for (int i = 1; i < 32; ++i) line += " 0";
  return line + " " + weight + "\n";
}

TEST(Dbow2Text, ReadsATreeInAnyOrderOfLines) {
  // Depth first: 1 has the leaves 2 and 4, 3 is a leaf under the root.
  const std::string text = "10 2 0 0\n" + node(0, 0, 255, "0") + node(1, 1, 254, "1.5") +
                           node(0, 1, 0, "2.25") + node(1, 1, 127, "0.5");
  const Vocabulary vocabulary = Vocabulary::parse_dbow2_text(text, "voc.txt");
  EXPECT_EQ(vocabulary.words(), 3);
  EXPECT_EQ(vocabulary.levels(), 2);
  EXPECT_EQ(vocabulary.branching(), 10);
  EXPECT_EQ(vocabulary.nodes(), 5);
  const auto weight = [&](std::uint64_t first) { return vocabulary.weights()[vocabulary.word({first})]; };
  EXPECT_EQ(weight(254), 1.5F);
  EXPECT_EQ(weight(127), 0.5F);
  EXPECT_EQ(weight(0), 2.25F);
}

// Found by the fuzzer: beside the other weight the share is less than a float can hold, and was 0.
TEST(Dbow2Text, AWordOfNextToNoWeightIsLeftOutOfTheDescription) {
  const std::string text = "2 1 0 0\n" + node(0, 1, 0, "100") + node(0, 1, 255, "1e-45");
  const Vocabulary vocabulary = Vocabulary::parse_dbow2_text(text, "voc.txt");
  const Descriptor heavy = {0}, light = {255};
  const std::vector<Descriptor> both = {heavy, light}, only = {light};
  const std::vector<std::pair<WordId, float>> one = {{vocabulary.word(heavy), 1.0F}};
  EXPECT_EQ(vocabulary.describe(both).words, one);
  EXPECT_EQ(vocabulary.describe(only).words.size(), 1u);
}

TEST(Dbow2Text, BytesStandInTheOrderOfTheBits) {
  std::string line = "0 1";
  for (int i = 0; i < 32; ++i) line.append(" ").append(std::to_string(i));
  const Vocabulary vocabulary =
      Vocabulary::parse_dbow2_text("2 1 0 0\n" + line + " 1\n" + node(0, 1, 0, "1"), "voc.txt");
  EXPECT_EQ(vocabulary.descriptors()[1],
            (Descriptor{0x0706050403020100, 0x0F0E0D0C0B0A0908, 0x1716151413121110, 0x1F1E1D1C1B1A1918}));
}

TEST(Dbow2Text, BlankLinesAndCarriageReturnsAddNoNode) {
  const std::string text = "2 1 0 0 \r\n" + node(0, 1, 1, "1 \r") + node(0, 1, 2, "1") + "\n  \n\n";
  EXPECT_EQ(Vocabulary::parse_dbow2_text(text, "voc.txt").nodes(), 3);
}

TEST(Dbow2Text, RoundTripIsBitExactButForTheImages) {
  SyntheticPlaces places(12, 80);
  VocabularyOptions options;
  options.branching = 5;
  options.levels = 3;
  const Vocabulary vocabulary = Vocabulary::train(places.images_of_all(), options);
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "round_trip.txt";
  vocabulary.write_dbow2_text(path);
  const Vocabulary read = Vocabulary::read_dbow2_text(path);
  EXPECT_TRUE(std::ranges::equal(read.descriptors(), vocabulary.descriptors()));
  EXPECT_TRUE(std::ranges::equal(read.weights(), vocabulary.weights()));
  EXPECT_TRUE(std::ranges::equal(read.first_child(), vocabulary.first_child()));
  EXPECT_EQ(read.images(), 0);
  EXPECT_THROW(Vocabulary().write_dbow2_text(path), OutputError);
}

struct BadText {
  const char* name;
  std::string text;
  const char* message;
};
void PrintTo(const BadText& bad, std::ostream* out) {
  *out << bad.name;
}

class BadDbow2Text : public testing::TestWithParam<BadText> {};

TEST_P(BadDbow2Text, IsRefusedWithTheLineAndTheReason) {
  try {
    (void)Vocabulary::parse_dbow2_text(GetParam().text, "voc.txt");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(GetParam().message));
    EXPECT_THAT(error.what(), testing::StartsWith("voc.txt:"));
  }
}

const std::string kHead = "2 2 0 0\n", kLeaf = node(0, 1, 1, "1");
const BadText kBadTexts[] = {
    {"empty", "", "is empty"},
    {"only_blank_lines", "\n\n", "is empty"},
    {"not_numbers", "SPSLVOC", "voc.txt:1: the branching k (2 to 20) is missing or wrong"},
    {"too_wide", "21 2 0 0\n", "branching k"},
    {"too_deep", "2 11 0 0\n", "levels L"},
    {"unknown_scoring", "2 2 6 0\n", "the scoring"},
    {"binary_weights", "2 2 0 3\n", "weighting 3 is not supported"},
    {"long_head", "2 2 0 0 7\n", "has more numbers"},
    {"no_nodes", kHead, "no leaf but has no children"},
    {"parent_later", kHead + node(1, 1, 1, "1"), "voc.txt:2: node 1 comes before its parent 1"},
    {"parent_negative", kHead + node(-1, 1, 1, "1"), "the parent is missing or wrong"},
    {"child_of_a_leaf", kHead + kLeaf + node(1, 1, 2, "1"), "voc.txt:3: its parent 1 is a leaf by line 2"},
    {"cut_off_after_a_node", kHead + kLeaf + node(0, 0, 2, "0"), "voc.txt:3: node 2 is no leaf"},
    {"cut_off_within_a_line", kHead + kLeaf.substr(0, 40), "is missing or wrong"},
    {"byte_too_big", kHead + node(0, 1, 256, "1"), "a byte (0 to 255) is missing or wrong"},
    {"weight_nan", kHead + node(0, 1, 1, "nan"), "the weight (0 to 1e5) is missing or wrong"},
    {"weight_negative", kHead + node(0, 1, 1, "-1"), "the weight"},
    {"too_many_children", kHead + kLeaf + kLeaf + kLeaf, "node 0 has 3 children, but k is 2"},
    {"long_line", kHead + node(0, 1, 1, "1 1"), "has more numbers"},
    {"letters", kHead + node(0, 1, 1, "1x"), "is not all numbers"},
};
INSTANTIATE_TEST_SUITE_P(Each, BadDbow2Text, testing::ValuesIn(kBadTexts),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace spslam
