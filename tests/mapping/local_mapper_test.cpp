// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/mapping/local_mapper.h"

#include <gmock/gmock.h>

#include "mapping/feature_world.h"

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

const StereoRig kRig = [] {
  StereoRig rig;
  rig.fx = rig.fy = 100;
  rig.cx = 80, rig.cy = 60;
  rig.baseline = 0.1;
  rig.width = 160, rig.height = 120;
  return rig;
}();

LocalMapper make_mapper(int view_keyframes = 20) {
  LocalMapperOptions options;
  options.view_keyframes = view_keyframes;
  options.culling.enabled = false;
  return {kRig, OrbOptions{}, options};
}

TEST(LocalMapper, LandmarksThatMoveAreTakenOut) {
  LocalMapper mapper = make_mapper();
  mapper.insert(proposal(0));
  KeyframeProposal second = proposal(1);
  second.moving_landmarks = {{0}, {77}};  // one of the first keyframe's, and one that never came here
  mapper.insert(second);
  EXPECT_FALSE(mapper.map().find(LandmarkId{0}));
  EXPECT_TRUE(mapper.map().find(LandmarkId{1}));
  for (const Sighting& s : mapper.map().find(KeyframeId{0})->sightings) EXPECT_NE(s.landmark, LandmarkId{0});
}

// Before anything was solved nobody knows which sightings are wrong.
TEST(LocalMapper, AnAdjustmentThatWasStoppedTakesNothingOut) {
  KeyframeProposal second = proposal(1);
  second.keyframe.sightings.back().measured = {150, 10, 0};
  second.keyframe.sightings.back().inverse_sigma = {5, 5, 0};
  const LandmarkId known = second.keyframe.sightings.back().landmark;
  LocalMapper mapper = make_mapper();
  mapper.insert(proposal(0));
  const MappingResult result = mapper.insert(second, [] { return true; });
  EXPECT_EQ(result.adjustment.status, SolveStatus::kStopped);
  EXPECT_EQ(result.outliers, 0);
  EXPECT_TRUE(find_sighting(*mapper.map().find(KeyframeId{1}), known));
}

TEST(LocalMapper, InsertPublishesTheNeighbourhood) {
  LocalMapper mapper = make_mapper();
  const LocalMapView first = mapper.insert(proposal(0)).view, second = mapper.insert(proposal(1)).view;
  EXPECT_GT(second.revision, first.revision);
  EXPECT_EQ(first.keyframes.size(), 1U);
  ASSERT_EQ(second.keyframes.size(), 2U);
  EXPECT_EQ(second.landmarks.size(), 4U);
  EXPECT_FALSE(second.keyframes.back().left.empty());  // whose patches the tracker may look for again
}

TEST(LocalMapper, TakesOverTheTrackersEstimates) {
  LocalMapper mapper = make_mapper();
  mapper.insert(proposal(0));
  EXPECT_EQ(mapper.map().find(LandmarkId{1})->inverse_depth, 0.1);
  mapper.insert(proposal(1));
  EXPECT_EQ(mapper.map().find(LandmarkId{1})->information, 50);
  EXPECT_EQ(mapper.map().find(LandmarkId{0})->inverse_depth, 0.1);
}

TEST(LocalMapper, EstimatesForAnotherHostAreNotTakenOver) {
  LocalMapper mapper = make_mapper();
  mapper.insert(proposal(0));
  KeyframeProposal second = proposal(1);
  second.known_landmarks.front().host = {1};
  mapper.insert(std::move(second));
  EXPECT_EQ(mapper.map().find(LandmarkId{1})->information, 0);
}

// The tracker measured from a keyframe that has been corrected since.
TEST(LocalMapper, NewKeyframesMoveWithTheCorrectionsTheyDoNotKnow) {
  LocalMapper mapper = make_mapper();
  mapper.insert(proposal(0));
  KeyframeProposal second = proposal(1);
  second.previous = {0};
  second.camera_from_previous.translation = {0, 0, -2};
  mapper.insert(std::move(second));
  const SE3 expected = second.camera_from_previous * mapper.map().find(KeyframeId{0})->camera_from_world;
  const SE3& found = mapper.map().find(KeyframeId{1})->camera_from_world;
  EXPECT_LT((found.translation - expected.translation).norm(), 1e-9);
}

TEST(LocalMapper, KeyframesAreDescribed) {
  LocalMapper mapper = make_mapper();
  KeyframeProposal first = proposal(0);
  for (Sighting& s : first.keyframe.sightings) s.measured = {80, 60, 1};
  first.keyframe.sightings.back().measured.x() = 100;
  mapper.insert(std::move(first));
  const auto features = mapper.map().find(KeyframeId{0})->features;
  ASSERT_TRUE(features);
  ASSERT_EQ(features->size(), 2U);
  EXPECT_EQ(features->keypoints[0].x, 80);
  EXPECT_NEAR(features->inverse_depths[1], 0.1, 1e-6);
  EXPECT_EQ(features->descriptors.size(), 2U);
  EXPECT_EQ(features->information.size(), 2U);
}

TEST(LocalMapper, TheViewIsBoundedAndOldKeyframesKeepNoImages) {
  LocalMapper mapper = make_mapper(2);
  LocalMapView view;
  for (int i = 0; i < 8; ++i) view = mapper.insert(proposal(i)).view;
  std::vector<std::int64_t> ids;
  for (const Keyframe& keyframe : view.keyframes) ids.push_back(keyframe.id.value);
  EXPECT_THAT(ids, testing::ElementsAre(6, 7));
  for (const Landmark& landmark : view.landmarks) EXPECT_GE(landmark.host.value, 6);
  EXPECT_EQ(mapper.map().keyframes().size(), 8U);
  for (const auto& [id, keyframe] : mapper.map().keyframes()) EXPECT_EQ(keyframe.left.empty(), id.value < 6);
}

TEST(LocalMapper, AKeyframeThatSeesNothingKnownIsTakenAllTheSame) {
  LocalMapper mapper = make_mapper();
  mapper.insert(proposal(0));
  KeyframeProposal alone = proposal(1);
  alone.known_landmarks.clear();
  alone.keyframe.sightings.clear();
  alone.new_landmarks.clear();
  const MappingResult result = mapper.insert(std::move(alone));
  EXPECT_EQ(mapper.map().find(KeyframeId{1})->parent, KeyframeId{0});
  EXPECT_EQ(result.view.keyframes.back().id, KeyframeId{1});
}

TEST(LocalMapper, SightingsOfWhatWasCulledAreLeftOut) {
  LocalMapperOptions options;
  options.culling.landmark_trial = 1;
  options.culling.landmark_views = 5;  // all go
  LocalMapper mapper(kRig, OrbOptions{}, options);
  for (int i = 0; i < 6; ++i) mapper.insert(proposal(i));
  for (const auto& [id, keyframe] : mapper.map().keyframes())
    for (const Sighting& s : keyframe.sightings) EXPECT_NE(mapper.map().find(s.landmark), nullptr);
  EXPECT_LT(mapper.map().landmarks().size(), 4U);
}

TEST(LocalMapper, NumbersThatAreNotFiniteDoNotSpread) {
  LocalMapper mapper = make_mapper();
  mapper.insert(proposal(0));
  KeyframeProposal second = proposal(1);
  second.keyframe.sightings.back().measured = {std::nan(""), 3, 1};
  second.keyframe.sightings.back().inverse_sigma = {4, 4, 5};
  mapper.insert(std::move(second));
  EXPECT_TRUE(mapper.map().find(KeyframeId{1})->camera_from_world.is_finite());
  for (const auto& [id, landmark] : mapper.map().landmarks())
    EXPECT_TRUE(std::isfinite(landmark.inverse_depth));
}

constexpr double kWallDepth = 4, kWallStep = 0.1;  // m

// A keyframe before a wall that fills the image, a step to the right of the one before, with what all of them
// see.
KeyframeProposal wall_proposal(const StereoRig& rig, const cv::Mat& wall, int k) {
  KeyframeProposal out;
  const double shift = k * rig.fx * kWallStep / kWallDepth;
  cv::Mat seen;
  cv::warpAffine(wall, seen, cv::Matx23d(1, 0, -shift, 0, 1, 0), wall.size(), cv::INTER_CUBIC);
  out.keyframe.id = {k};
  out.keyframe.camera_from_world.translation.x() = -k * kWallStep;
  out.keyframe.left = AlignmentPyramid(seen, 3);
  for (int l = 0; l < 20; ++l) {
    const double u = 100 + 25 * l, v = 60 + 12 * l,
                 disparity = rig.disparity_per_inverse_depth() / kWallDepth;
    out.keyframe.sightings.push_back({{l}, {u - shift, v, disparity}, {3, 3, 8}, 1});
    if (k > 0) continue;
    Landmark landmark;
    landmark.id = {l};
    landmark.host = {0};
    landmark.pixel = Eigen::Vector2d(u, v).cast<float>();
    landmark.bearing = rig.bearing(u, v);
    landmark.inverse_depth = 1 / kWallDepth;
    landmark.information = 1e4;
    out.new_landmarks.push_back(landmark);
  }
  return out;
}

TEST(LocalMapper, MakesLandmarksBetweenKeyframesUnderIdsOfItsOwn) {
  const StereoRig rig = test::feature_rig();
  const cv::Mat wall = test::textured_wall(rig);
  LocalMapperOptions options;
  options.triangulation.enabled = true;
  LocalMapper mapper(rig, OrbOptions{}, options);
  int made = 0;
  LocalMapView view;
  for (int k = 0; k < 3; ++k) {
    MappingResult result = mapper.insert(wall_proposal(rig, wall, k));
    made += result.triangulated;
    view = std::move(result.view);
  }
  ASSERT_GT(made, 20);
  EXPECT_EQ(mapper.map().landmarks().size(), 20U + static_cast<std::size_t>(made));
  EXPECT_EQ(view.landmarks.size(), 20U + static_cast<std::size_t>(made));  // for the tracker to follow
  constexpr std::int64_t kOwn = std::int64_t{1} << 40;
  std::int64_t next = kOwn;
  for (const auto& [id, landmark] : mapper.map().landmarks()) {
    if (id.value < 20) continue;
    EXPECT_EQ(id.value, next++);
    EXPECT_NEAR(landmark.inverse_depth, 1 / kWallDepth, 4 / std::sqrt(landmark.information));
  }
  // A mapper that goes on with this map does not meet the ids that a tracker counts up from its end.
  Map known = mapper.map();
  LocalMapper second(rig, OrbOptions{}, options, std::move(known));
  KeyframeProposal more = wall_proposal(rig, wall, 4);
  more.keyframe.id = {3};
  if (second.insert(std::move(more)).triangulated > 0) {
    EXPECT_EQ(second.map().landmarks().rbegin()->first.value / kOwn, 2);
  }
}

TEST(LocalMapper, AnIdThatIsTakenIsRefused) {
  LocalMapper mapper = make_mapper();
  mapper.insert(proposal(0));
  EXPECT_THROW(mapper.insert(proposal(0)), std::invalid_argument);
}

}  // namespace
}  // namespace spslam
