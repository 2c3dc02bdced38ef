// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include "loop/synthetic_places.h"
#include "spslam/loop/vocabulary.h"

namespace spslam {
namespace {

TEST(BuiltInVocabulary, IsThereAndSmallEnough) {
  const Vocabulary vocabulary = built_in_vocabulary();
  EXPECT_GT(vocabulary.words(), 10000);
  EXPECT_GT(vocabulary.images(), 300);
  EXPECT_LE(vocabulary.bytes().size(), 3'000'000u);
}

TEST(BuiltInVocabulary, IsUsedInPlaceByAll) {
  EXPECT_EQ(built_in_vocabulary().bytes().data(), built_in_vocabulary().bytes().data());
}

// A word's own descriptor need not reach it (the way down is greedy), but nearly all do.
TEST(BuiltInVocabulary, WordsAreFoundFromTheRoot) {
  const Vocabulary vocabulary = built_in_vocabulary();
  int words = 0, reached = 0;
  for (int node = 1; node < vocabulary.nodes(); node += 7) {
    if (vocabulary.first_child()[node] != vocabulary.first_child()[node + 1]) continue;
    ++words;
    reached += vocabulary.word(vocabulary.descriptors()[node]) == static_cast<WordId>(node);
  }
  EXPECT_GT(reached, 0.7 * words);
}

TEST(BuiltInVocabulary, TellsPlacesApartThatItWasNotTrainedOn) {
  const Vocabulary vocabulary = built_in_vocabulary();
  const SyntheticPlaces places(2, 200);
  const WordVector a = vocabulary.describe(places.image(0)), again = vocabulary.describe(places.image(0, 1)),
                   other = vocabulary.describe(places.image(1));
  EXPECT_GT(similarity(a, again), 3 * similarity(a, other));
}

}  // namespace
}  // namespace spslam
