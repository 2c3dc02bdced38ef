// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/mapping/local_mapper.h"

#include <gmock/gmock.h>

namespace spslam {
namespace {

// Keyframe `id` with two landmarks of its own, 2 id and 2 id + 1, that sees the previous one's second too.
KeyframeProposal proposal(std::int64_t id) {
  KeyframeProposal out;
  out.keyframe.id = {id};
  out.keyframe.frame = {10 * id};
  out.keyframe.camera_from_world.translation.z() = -static_cast<double>(id);
  out.keyframe.left = AlignmentPyramid(cv::Mat(120, 160, CV_8UC1, cv::Scalar(90)), 2);
  for (const std::int64_t l : {2 * id, 2 * id + 1}) {
    Landmark landmark;
    landmark.id = {l};
    landmark.host = {id};
    landmark.inverse_depth = 0.1;
    out.new_landmarks.push_back(landmark);
    out.keyframe.sightings.push_back({landmark.id});
  }
  if (id == 0) return out;
  Landmark known;
  known.id = {2 * id - 1};
  known.host = {id - 1};
  known.inverse_depth = 0.2, known.information = 50;
  out.known_landmarks.push_back(known);
  out.keyframe.sightings.push_back({known.id});
  return out;
}

TEST(LocalMapper, InsertPublishesTheNeighbourhood) {
  LocalMapper mapper({});
  const LocalMapView first = mapper.insert(proposal(0)), second = mapper.insert(proposal(1));
  EXPECT_GT(second.revision, first.revision);
  EXPECT_EQ(first.keyframes.size(), 1U);
  ASSERT_EQ(second.keyframes.size(), 2U);
  EXPECT_EQ(second.landmarks.size(), 4U);
  for (const Keyframe& keyframe : second.keyframes)
    EXPECT_EQ(keyframe.camera_from_world.translation.z(), -static_cast<double>(keyframe.id.value));
}

TEST(LocalMapper, TakesOverTheTrackersEstimates) {
  LocalMapper mapper({});
  mapper.insert(proposal(0));
  EXPECT_EQ(mapper.map().find(LandmarkId{1})->inverse_depth, 0.1);
  mapper.insert(proposal(1));
  EXPECT_EQ(mapper.map().find(LandmarkId{1})->inverse_depth, 0.2);
  EXPECT_EQ(mapper.map().find(LandmarkId{1})->information, 50);
  EXPECT_EQ(mapper.map().find(LandmarkId{0})->inverse_depth, 0.1);
}

TEST(LocalMapper, KeyframesKeepNoImages) {
  LocalMapper mapper({});
  const LocalMapView view = mapper.insert(proposal(0));
  EXPECT_TRUE(mapper.map().find(KeyframeId{0})->left.empty());
  EXPECT_TRUE(view.keyframes.at(0).left.empty());
}

TEST(LocalMapper, TheViewIsBounded) {
  LocalMapper mapper({.view_keyframes = 3});
  LocalMapView view;
  for (int i = 0; i < 8; ++i) view = mapper.insert(proposal(i));
  std::vector<std::int64_t> ids;
  for (const Keyframe& keyframe : view.keyframes) ids.push_back(keyframe.id.value);
  EXPECT_THAT(ids, testing::UnorderedElementsAre(5, 6, 7));
  for (const Landmark& landmark : view.landmarks) EXPECT_GE(landmark.host.value, 5);
  EXPECT_EQ(mapper.map().keyframes().size(), 8U);
}

TEST(LocalMapper, AnIdThatIsTakenIsRefused) {
  LocalMapper mapper({});
  mapper.insert(proposal(0));
  EXPECT_THROW(mapper.insert(proposal(0)), std::invalid_argument);
}

}  // namespace
}  // namespace spslam
