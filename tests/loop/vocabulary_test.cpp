// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/loop/vocabulary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/temporary_folder.h"
#include "loop/synthetic_places.h"
#include "spslam/base/error.h"

namespace spslam {
namespace {

using testing::HasSubstr;

VocabularyOptions small() {
  VocabularyOptions options;
  options.branching = 8;
  options.levels = 3;
  return options;
}

std::vector<std::byte> bytes_of(const Vocabulary& vocabulary) {
  return {vocabulary.bytes().begin(), vocabulary.bytes().end()};
}

class VocabularyTest : public testing::Test {
 protected:
  SyntheticPlaces places_{40, 100};
  Vocabulary vocabulary_ = Vocabulary::train(places_.images_of_all(), small());
};

TEST_F(VocabularyTest, HasTheShapeAskedFor) {
  EXPECT_FALSE(vocabulary_.empty());
  EXPECT_EQ(vocabulary_.branching(), 8);
  EXPECT_EQ(vocabulary_.levels(), 3);
  EXPECT_EQ(vocabulary_.images(), 40);
  EXPECT_GT(vocabulary_.words(), 400);
  EXPECT_LE(vocabulary_.words(), 512);
  EXPECT_LE(vocabulary_.nodes(), 1 + 8 + 64 + 512);
}

TEST(VocabularyTraining, SameBitsAtAnyNumberOfThreads) {
  SyntheticPlaces places(20, 400);
  const auto images = places.images_of_all();
  std::vector<std::byte> first;
  for (const std::size_t threads : {1, 2, 5}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const std::vector<std::byte> bytes = bytes_of(Vocabulary::train(images, small()));
    if (first.empty()) first = bytes;
    EXPECT_EQ(bytes, first) << threads << " threads";
  }
  VocabularyOptions other = small();
  other.seed = 2;
  EXPECT_NE(bytes_of(Vocabulary::train(images, other)), first);
}

// Four patterns with little noise: the tree must find these and no others.
TEST(VocabularyTraining, FindsTheClusters) {
  Random random(3);
  std::vector<Descriptor> centres(4);
  for (Descriptor& centre : centres) centre = test::random_descriptor(random);
  std::vector<std::vector<Descriptor>> images(2);
  for (int i = 0; i < 400; ++i) images[i % 2].push_back(test::flip_bits(centres[i % 4], 10, random));
  VocabularyOptions options;
  options.branching = 4;
  options.levels = 1;
  const Vocabulary vocabulary = Vocabulary::train(images, options);
  ASSERT_EQ(vocabulary.words(), 4);
  for (const Descriptor& centre : centres)
    EXPECT_EQ(hamming(vocabulary.descriptors()[vocabulary.word(centre)], centre), 0);
}

TEST(VocabularyTraining, WeighsWordsByTheImagesThatHaveThem) {
  Random random(4);
  const Descriptor everywhere = test::random_descriptor(random), once = test::random_descriptor(random);
  const std::vector<std::vector<Descriptor>> images = {{everywhere, once}, {everywhere}, {everywhere}, {}};
  VocabularyOptions options;
  options.branching = 2;
  options.levels = 1;
  const Vocabulary vocabulary = Vocabulary::train(images, options);
  EXPECT_EQ(vocabulary.images(), 3);
  EXPECT_FLOAT_EQ(vocabulary.weights()[vocabulary.word(once)], std::log(3.0F));
  EXPECT_EQ(vocabulary.weights()[vocabulary.word(everywhere)], 0);
  EXPECT_TRUE(vocabulary.describe(images[1]).empty());
  EXPECT_THAT(vocabulary.describe(images[0]).words,
              testing::ElementsAre(std::pair(vocabulary.word(once), 1.0F)));
}

TEST(VocabularyTraining, RefusesWhatItCannotLearnFrom) {
  const Descriptor one = {1, 2, 3, 4};
  using Images = std::vector<std::vector<Descriptor>>;
  EXPECT_THROW(Vocabulary::train(Images{}), InputError);
  EXPECT_THROW(Vocabulary::train(Images{{one, Descriptor{}}, {}}), InputError);
  EXPECT_THROW(Vocabulary::train(Images{{one, one}, {one}}), InputError);
  VocabularyOptions options;
  options.branching = 21;
  EXPECT_THROW(Vocabulary::train(Images{{one}, {Descriptor{}}}, options), OptionError);
}

TEST_F(VocabularyTest, EqualDescriptorsHaveEqualWordsAndNearOnesMostly) {
  Random random(5);
  int same = 0, all = 0;
  for (const Descriptor& descriptor : places_.image(0)) {
    EXPECT_EQ(vocabulary_.word(descriptor), vocabulary_.word(Descriptor(descriptor)));
    same += vocabulary_.word(descriptor) == vocabulary_.word(test::flip_bits(descriptor, 5, random));
    ++all;
  }
  EXPECT_GT(same, 0.6 * all);
}

TEST_F(VocabularyTest, WordsAreSortedLeavesWhoseSharesAddUpToOne) {
  const WordVector words = vocabulary_.describe(places_.image(3));
  double sum = 0;
  for (std::size_t i = 0; i < words.words.size(); ++i) {
    const auto [word, share] = words.words[i];
    EXPECT_TRUE(i == 0 || words.words[i - 1].first < word);
    EXPECT_EQ(vocabulary_.first_child()[word], vocabulary_.first_child()[word + 1]);
    EXPECT_GT(share, 0);
    sum += share;
  }
  EXPECT_NEAR(sum, 1, 1e-5);
  EXPECT_TRUE(vocabulary_.describe({}).empty());
}

TEST_F(VocabularyTest, SimilarityIsSymmetricOneForItselfAndHigherForTheSamePlace) {
  const WordVector a = vocabulary_.describe(places_.image(3)),
                   again = vocabulary_.describe(places_.image(3, 1)),
                   other = vocabulary_.describe(places_.image(4, 1));
  EXPECT_NEAR(similarity(a, a), 1, 1e-5);
  EXPECT_EQ(similarity(a, again), similarity(again, a));
  EXPECT_EQ(similarity(a, other), similarity(other, a));
  EXPECT_GT(similarity(a, again), 1.5 * similarity(a, other));
  EXPECT_EQ(similarity(a, {}), 0);
  EXPECT_NEAR(similarity({{{1, 0.5F}, {2, 0.5F}}}, {{{2, 0.25F}, {7, 0.75F}}}), 0.25, 1e-9);
}

TEST_F(VocabularyTest, GroupsByTheNodeAboveTheWord) {
  const std::vector<Descriptor> image = places_.image(7);
  const NodeFeatures words = vocabulary_.group(image, 0), upper = vocabulary_.group(image, 2),
                     root = vocabulary_.group(image, 3);
  for (const auto& [node, features] : words.nodes)
    for (const int feature : features) EXPECT_EQ(vocabulary_.word(image[feature]), node);
  EXPECT_GT(words.nodes.size(), upper.nodes.size());
  for (const auto& [node, features] : upper.nodes) {
    EXPECT_GE(node, vocabulary_.first_child()[0]);
    EXPECT_LT(node, vocabulary_.first_child()[1]);
    EXPECT_TRUE(std::is_sorted(features.begin(), features.end()));
  }
  ASSERT_EQ(root.nodes.size(), 1u);
  EXPECT_EQ(root.nodes[0].second.size(), image.size());
  EXPECT_EQ(vocabulary_.group(image, 99), root);
  EXPECT_EQ(vocabulary_.group(image, -5), words);
}

TEST(EmptyVocabulary, AnswersAllTheSame) {
  const Vocabulary none;
  const std::vector<Descriptor> two = {{1}, {2}};
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(none.word(two[0]), 0u);
  EXPECT_TRUE(none.describe(two).empty());
  ASSERT_EQ(none.group(two, 1).nodes.size(), 1u);
  EXPECT_THROW(none.save(test::TemporaryFolder().path() / "none.spv"), OutputError);
}

}  // namespace
}  // namespace spslam
