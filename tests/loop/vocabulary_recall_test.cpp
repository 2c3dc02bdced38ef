// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/loop/vocabulary_recall.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "loop/synthetic_places.h"

namespace spslam {
namespace {

SE3 at(double x, double heading = 0) {
  return {Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitY()).toRotationMatrix(), {x, 0, 0}};
}

class VocabularyRecall : public testing::Test {
 protected:
  // A place every 10 m, an image of one of them each second.
  PlaceView view(int place, int time, int look = 0) const {
    return {static_cast<double>(time), at(10.0 * place), places_.image(place, look)};
  }
  std::vector<PlaceView> twice_round() const {
    std::vector<PlaceView> views;
    for (int time = 0; time < 80; ++time) views.push_back(view(time % 40, time, time / 40));
    return views;
  }

  SyntheticPlaces places_{40, 100};
  Vocabulary vocabulary_ = Vocabulary::train(places_.images_of_all(), {8, 3, 12, 1});
};

TEST_F(VocabularyRecall, CountsWhatIsFoundAgain) {
  const RecallResult result = measure_recall(twice_round(), vocabulary_);
  EXPECT_EQ(result.queries, 80 - 11);
  EXPECT_EQ(result.revisits, 40);
  EXPECT_EQ(result.first, 40);
  EXPECT_EQ(result.among_five, 40);
  EXPECT_EQ(result.certain, 40);
  EXPECT_GT(result.highest_wrong, 0.1);
}

// The poses say that the second round was elsewhere: all answers are wrong.
TEST_F(VocabularyRecall, CountsWrongAnswersAsWrong) {
  std::vector<PlaceView> views = twice_round();
  for (int time = 40; time < 80; ++time) views[time].world_from_camera = at(10.0 * time);
  RecallResult result = measure_recall(views, vocabulary_);
  EXPECT_EQ(result.revisits, 0);
  EXPECT_EQ(result.first, 0);
  EXPECT_EQ(result.certain, 0);
  EXPECT_GT(result.highest_wrong, 0.4);
  // One of them is right, but another wrong answer scores as high: nothing is certain.
  views[60].world_from_camera = at(200);
  views[61].descriptors = views[21].descriptors;
  result = measure_recall(views, vocabulary_);
  EXPECT_EQ(result.revisits, 1);
  EXPECT_EQ(result.first, 1);
  EXPECT_EQ(result.certain, 0);
}

TEST_F(VocabularyRecall, LooksAtDistanceAngleAndGap) {
  const auto revisits = [&](double moved, double turned, int time, const PlaceRecallOptions& options) {
    std::vector<PlaceView> views = {view(0, 0), view(0, time)};
    views[1].world_from_camera = at(moved, turned);
    return measure_recall(views, vocabulary_, options).revisits;
  };
  const PlaceRecallOptions options = {3, 30, 10};
  EXPECT_EQ(revisits(2.9, 0, 11, options), 1);
  EXPECT_EQ(revisits(3.1, 0, 11, options), 0);
  EXPECT_EQ(revisits(0, 0.5, 11, options), 1);
  EXPECT_EQ(revisits(0, 0.55, 11, options), 0);
  EXPECT_EQ(revisits(0, 0, 10, options), 0);
}

TEST_F(VocabularyRecall, AsksAnotherSequence) {
  const std::vector<PlaceView> views = twice_round();
  const RecallResult result =
      measure_recall(std::span(views).first(20), std::span(views).subspan(50, 30), vocabulary_);
  EXPECT_EQ(result.queries, 20);
  EXPECT_EQ(result.revisits, 10);
  EXPECT_EQ(result.first, 10);
  EXPECT_EQ(measure_recall(views, std::span<const PlaceView>(), vocabulary_).queries, 0);
  EXPECT_EQ(measure_recall(std::span<const PlaceView>(), vocabulary_).queries, 0);
}

}  // namespace
}  // namespace spslam
