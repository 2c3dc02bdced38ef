// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/loop/loop_closer.h"

#include <gtest/gtest.h>

#include "loop/place_world.h"

namespace spslam {
namespace {

using namespace test;

constexpr int kKeyframes = 30;
constexpr int kShared = 20;  // landmarks that a keyframe shares with the next

KeyframeId id_of(int i) {
  return {i};
}

// A keyframe that sees the world from a place, and shares landmarks with the one before.
void add_keyframe(Map& map, int i, const SE3& pose, const std::vector<WorldPoint>& world) {
  Keyframe keyframe{id_of(i), {i}, 0.5 * i, pose};
  ViewOptions view;
  view.flipped_bits = 4, view.seed = static_cast<std::uint64_t>(100 + i);
  keyframe.features = see(world, pose, view).features;
  for (int k = -kShared; k < kShared; ++k) {
    const LandmarkId landmark{static_cast<std::int64_t>(kShared) * i + k};
    if (landmark.value < 0) continue;
    if (k >= 0) {
      Landmark made;
      made.id = landmark, made.host = keyframe.id;
      map.add(made);
    }
    keyframe.sightings.push_back({landmark, {10, 10, 1}, {1, 1, 1}});
  }
  map.add(std::move(keyframe));
}

// All attempts along a way with odometry that does not err; z of each keyframe, heading along z.
// As long as corrections fail, none is closed.
std::vector<LoopAttempt> attempts(const std::vector<double>& way, const DetectionOptions& options,
                                  const SE3& error_of_odometry = {}, bool corrections_fail = false) {
  const auto world = make_world({.points = 900, .nearest = 6});
  const Vocabulary vocabulary = built_in_vocabulary();
  LoopCloser closer(boat_rig(), options, {}, {}, vocabulary);
  Map map;
  std::vector<LoopAttempt> out;
  for (std::size_t i = 0; i < way.size(); ++i) {
    const SE3 true_pose = camera_at(0, way[i], 0);
    add_keyframe(map, static_cast<int>(i), true_pose, world);
    if (i >= way.size() / 2) map.set_pose(id_of(static_cast<int>(i)), error_of_odometry * true_pose);
    out.push_back(closer.detect(map, id_of(static_cast<int>(i))));
    if (out.back().closure && !corrections_fail) closer.closed(*out.back().closure);
  }
  return out;
}

std::vector<double> there_and_back(double step) {
  std::vector<double> out;
  for (int i = 0; i < kKeyframes; ++i) out.push_back(step * std::min(i, kKeyframes - i));
  return out;
}

std::vector<double> straight_on(double step) {
  std::vector<double> out;
  for (int i = 0; i < kKeyframes; ++i) out.push_back(step * i);
  return out;
}

int closed(const std::vector<LoopAttempt>& all) {
  return static_cast<int>(
      std::count_if(all.begin(), all.end(), [](const LoopAttempt& a) { return a.closure.has_value(); }));
}

int refused(const std::vector<LoopAttempt>& all, LoopStage stage) {
  int count = 0;
  for (const LoopAttempt& attempt : all)
    for (const LoopCandidate& candidate : attempt.candidates) count += candidate.stage == stage;
  return count;
}

TEST(LoopCloser, FindsThePlaceItComesBackTo) {
  const std::vector<double> way = there_and_back(0.3);
  const std::vector<LoopAttempt> all = attempts(way, {});
  ASSERT_GE(closed(all), 1);
  for (const LoopAttempt& attempt : all) {
    if (!attempt.closure) continue;
    const LoopEdge& edge = attempt.closure->edge;
    EXPECT_EQ(edge.newer, attempt.keyframe);
    const double claimed = -edge.newer_from_older.translation.z();
    EXPECT_NEAR(claimed, way[edge.newer.value] - way[edge.older.value], 0.3);
  }
}

// A slow boat that goes straight on still sees what it saw twenty keyframes ago. It has not come back.
TEST(LoopCloser, GoingOnIsNoLoop) {
  const std::vector<LoopAttempt> all = attempts(straight_on(0.1), {});
  EXPECT_EQ(closed(all), 0);
  EXPECT_GT(refused(all, LoopStage::kNoReturn), 0);
  DetectionOptions any;
  any.min_detour = 1;
  EXPECT_GT(closed(attempts(straight_on(0.1), any)), 0);
}

TEST(LoopCloser, AfterALoopItPausesUnlessTheCorrectionFailed) {
  DetectionOptions patient;
  patient.pause = 1000;
  EXPECT_EQ(closed(attempts(there_and_back(0.3), patient)), 1);
  EXPECT_GT(closed(attempts(there_and_back(0.3), patient, {}, true)), 1);
}

TEST(LoopCloser, ALoopThatOdometryCannotHaveMissedByIsImplausible) {
  const SE3 sideways{Eigen::Matrix3d::Identity(), {2.4, 0, 0}};  // over 9 m
  DetectionOptions strict;
  strict.max_drift = 0.01;
  const std::vector<LoopAttempt> all = attempts(there_and_back(0.3), strict, sideways);
  EXPECT_EQ(closed(all), 0);
  EXPECT_GT(refused(all, LoopStage::kImplausible), 0);
  EXPECT_GE(closed(attempts(there_and_back(0.3), {}, sideways)), 1);
}

TEST(LoopCloser, AKeyframeWithoutFeaturesIsNoCandidateAndNoCrash) {
  Map map;
  map.add(Keyframe{id_of(0), {0}, 0, {}});
  const Vocabulary vocabulary = built_in_vocabulary();
  LoopCloser closer(boat_rig(), {}, {}, {}, vocabulary);
  EXPECT_TRUE(closer.detect(map, id_of(0)).candidates.empty());
  EXPECT_TRUE(closer.detect(map, id_of(7)).candidates.empty());
}

}  // namespace
}  // namespace spslam
