// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/loop/keyframe_index.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "loop/synthetic_places.h"

namespace spslam {
namespace {

using testing::ElementsAre;

KeyframeFeatures features(std::vector<Descriptor> descriptors) {
  KeyframeFeatures out;
  out.keypoints.resize(descriptors.size());
  out.descriptors = std::move(descriptors);
  return out;
}

struct Thousand {
  SyntheticPlaces places{1000, 80};
  KeyframeIndex index{vocabulary()};

  Thousand() {
    for (int place = 0; place < 1000; ++place) index.add(KeyframeId{place}, features(places.image(place)));
  }
  Vocabulary vocabulary() const {
    VocabularyOptions options;
    options.branching = 8;
    options.levels = 4;
    std::vector<std::vector<Descriptor>> some;
    for (int place = 0; place < 1000; place += 10) some.push_back(places.image(place));
    return Vocabulary::train(some, options);
  }
};

class IndexOfThousand : public testing::Test {
 protected:
  static const Thousand& all() {
    static const Thousand thousand;
    return thousand;
  }
  const SyntheticPlaces& places_ = all().places;
  const KeyframeIndex& index_ = all().index;
};

TEST_F(IndexOfThousand, FindsThePlaceAgain) {
  int found = 0;
  for (int place = 3; place < 1000; place += 50) {
    const auto candidates = index_.query(features(places_.image(place, 1)));
    found += candidates.at(0).id == KeyframeId{place};
  }
  EXPECT_EQ(found, 20);
}

TEST_F(IndexOfThousand, ScoresAreThoseOfTheVectorsAndFallOff) {
  const WordVector words = index_.vocabulary().describe(places_.image(17, 1));
  const auto candidates = index_.query(words);
  ASSERT_GT(candidates.size(), 100u);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    EXPECT_EQ(candidates[i].score, similarity(words, *index_.find(candidates[i].id)));
    if (i == 0) continue;
    EXPECT_LE(candidates[i].score, candidates[i - 1].score);
  }
}

TEST_F(IndexOfThousand, LeavesOutWhatIsExcluded) {
  const auto image = features(places_.image(40, 1));
  ASSERT_EQ(index_.query(image).at(0).id, KeyframeId{40});
  for (const Candidate& candidate : index_.query(image, {KeyframeId{40}, KeyframeId{41}}))
    EXPECT_TRUE(candidate.id != KeyframeId{40} && candidate.id != KeyframeId{41});
}

TEST_F(IndexOfThousand, ErasedIsGoneAndItsSlotIsUsedAgain) {
  KeyframeIndex index = index_;
  const auto image = features(places_.image(40, 1));
  index.erase(KeyframeId{40});
  index.erase(KeyframeId{40});
  EXPECT_EQ(index.size(), 999u);
  EXPECT_EQ(index.find(KeyframeId{40}), nullptr);
  for (const Candidate& candidate : index.query(image)) EXPECT_NE(candidate.id, KeyframeId{40});
  index.add(KeyframeId{2000}, image);
  EXPECT_EQ(index.query(image).at(0).id, KeyframeId{2000});
  EXPECT_EQ(index.size(), 1000u);
}

// The order in which keyframes came and went leaves no trace in the answers.
TEST_F(IndexOfThousand, AnswersDoNotDependOnHistory) {
  KeyframeIndex one(index_.vocabulary()), other(index_.vocabulary());
  for (int id = 0; id < 30; ++id) one.add(KeyframeId{id}, *index_.find(KeyframeId{id}));
  for (int id = 59; id >= 0; --id) other.add(KeyframeId{id}, *index_.find(KeyframeId{id}));
  for (int id = 30; id < 60; ++id) other.erase(KeyframeId{id});
  const WordVector words = index_.vocabulary().describe(places_.image(12, 1));
  EXPECT_EQ(one.query(words), other.query(words));
  other.add(KeyframeId{3}, *index_.find(KeyframeId{3}));
  EXPECT_EQ(one.query(words), other.query(words));
}

// Keyframes in a row; each shares landmarks with the next.
Map chain(int keyframes) {
  Map map;
  for (int id = 0; id < keyframes; ++id) {
    Keyframe keyframe;
    keyframe.id = KeyframeId{id};
    map.add(std::move(keyframe));
    Landmark landmark;
    landmark.id = LandmarkId{id};
    landmark.host = KeyframeId{id};
    map.add(landmark);
    for (int seen = std::max(0, id - 1); seen <= id; ++seen)
      map.set_sighting(KeyframeId{id}, {LandmarkId{seen}, {}, {}, 1});
  }
  return map;
}

TEST(CandidateGroups, AddUpCovisibleScores) {
  const Map map = chain(10);
  // 7 is alone but best; 2 and 3 together are better.
  const std::vector<Candidate> candidates = {
      {KeyframeId{7}, 0.30}, {KeyframeId{3}, 0.25}, {KeyframeId{2}, 0.20}, {KeyframeId{20}, 0.1}};
  const auto groups = group_candidates(candidates, map);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].best, KeyframeId{3});
  EXPECT_DOUBLE_EQ(groups[0].score, 0.45);
  EXPECT_DOUBLE_EQ(groups[0].best_score, 0.25);
  EXPECT_THAT(groups[0].members, ElementsAre(KeyframeId{2}, KeyframeId{3}));
  EXPECT_EQ(groups[1].best, KeyframeId{7});
  EXPECT_THAT(groups[1].members, ElementsAre(KeyframeId{7}));
}

TEST(CandidateGroups, KeepToTheirLimits) {
  std::vector<Candidate> alone, in_a_row;
  for (int i = 0; i < 30; ++i) {
    alone.push_back({KeyframeId{2 * i}, 0.3});
    in_a_row.push_back({KeyframeId{i}, 0.3});
  }
  EXPECT_EQ(group_candidates(alone, chain(60)).size(), 20u);
  Map map = chain(30);
  for (int id = 1; id < 30; ++id) map.set_sighting(KeyframeId{id}, {LandmarkId{0}, {}, {}, 1});
  const auto together = group_candidates(in_a_row, map);
  ASSERT_FALSE(together.empty());
  for (const CandidateGroup& group : together) EXPECT_EQ(group.members.size(), 11u);
  EXPECT_TRUE(group_candidates({}, map).empty());
}

}  // namespace
}  // namespace spslam
