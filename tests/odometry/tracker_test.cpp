// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The tracker's contract on a rendered plane; whole sequences are in tests/system.

#include "spslam/odometry/tracker.h"

#include <gtest/gtest.h>

#include <map>

#include "odometry/plane_scene.h"

namespace spslam {
namespace {

TrackerOptions small_options() {
  TrackerOptions options;
  options.segment = false;
  options.landmarks.count = 300;
  options.keyframe.min_tracked = 20;
  options.window_frames = 5;
  return options;
}

// Sideways and a little forward, turning, at 10 Hz.
SE3 pose_at(int i) {
  return SE3{so3_exp({0.002 * i, -0.003 * i, 0.004 * i}), {-0.02 * i, 0.005 * i, -0.03 * i}};
}

double position_error(const TrackResult& result, int i) {
  return (result.world_from_camera.translation - pose_at(i).inverse().translation).norm();
}

StereoFrame broken(double timestamp) {
  return {timestamp, {}, {}, "left image truncated"};
}

TEST(Tracker, FollowsARenderedPlane) {
  const test::PlaneScene scene(11);
  Tracker tracker(scene.rig(), small_options());
  for (int i = 0; i < 12; ++i) {
    const TrackResult result = tracker.track(scene.pair(0.1 * i, pose_at(i))).result;
    EXPECT_EQ(result.status, TrackStatus::kTracking) << result.reason;
    EXPECT_EQ(result.frame.value, i);
    EXPECT_LT(position_error(result, i), 0.01) << i;
    EXPECT_EQ(result.keyframe_id.valid(), i == 0 || result.keyframe.insert());
  }
}

// Landmarks in the lower third of the image that come into the map after the first frames, when that third is
// another surface at every moment, if the same for both eyes.
int landmarks_of_water(const TrackerOptions& options) {
  constexpr int kWaterline = 160, kLearnt = 8;  // row, frame
  const test::PlaneScene scene(11), water(21);
  const auto wet = [&](double timestamp, int i) {
    StereoFrame out = scene.pair(timestamp, pose_at(i));
    const SE3 elsewhere{Eigen::Matrix3d::Identity(), {7.3 * i, 3.1 * i, 0}};
    const cv::Range rows(kWaterline, scene.rig().height);
    water.render(elsewhere).rowRange(rows).copyTo(out.left.rowRange(rows));
    water.render(elsewhere, water.rig().baseline).rowRange(rows).copyTo(out.right.rowRange(rows));
    return out;
  };
  Tracker tracker(scene.rig(), options);
  int count = 0;
  const auto note = [&](const TrackerOutput& out) {
    for (const KeyframeProposal& proposal : out.proposals)
      for (const Landmark& landmark : proposal.new_landmarks)
        count += proposal.keyframe.frame.value >= kLearnt && landmark.pixel.y() > kWaterline + 10;
  };
  for (int i = 0; i < 13; ++i) {
    const TrackerOutput out = tracker.track(wet(0.1 * i, i));
    EXPECT_EQ(out.result.status, TrackStatus::kTracking) << out.result.reason;
    EXPECT_LT(position_error(out.result, i), 0.02) << i;
    note(out);
  }
  note(tracker.finish());
  return count;
}

TEST(Tracker, LandmarksOfWaterDoNotComeIntoTheMap) {
  TrackerOptions options = small_options();
  options.keyframe.max_frames = 3, options.landmarks.count = 800;
  const int found_out = landmarks_of_water(options);
  options.trial.enabled = false;
  const int trusted = landmarks_of_water(options);
  EXPECT_GT(trusted, 100);
  EXPECT_LT(found_out, trusted / 10) << found_out << " of " << trusted;
}

// Landmarks that were handed to the map and not taken back, by whether they are on a boat that crosses.
struct HandedOver {
  int boat = 0, rest = 0, moving = 0;
  double error = 0;  // m, of the last pose
};

HandedOver passing_a_boat(bool find_movers) {
  const cv::Rect place(90, 70, 110, 90);
  constexpr int kFrames = 24;
  const test::PlaneScene shore(11), boat(21, 3);
  TrackerOptions options = small_options();
  options.window_frames = 10;
  options.movers.enabled = find_movers;
  Tracker tracker(shore.rig(), options);
  HandedOver out;
  std::map<LandmarkId, bool> known;  // whether it is on the boat
  for (int i = 0; i < kFrames; ++i) {
    StereoFrame pair = shore.pair(0.1 * i, pose_at(i));
    const SE3 from_boat = pose_at(i) * SE3{Eigen::Matrix3d::Identity(), {0.015 * i, 0.01 * i, 0}};
    boat.render(from_boat)(place).copyTo(pair.left(place));
    boat.render(from_boat, boat.rig().baseline)(place).copyTo(pair.right(place));
    const TrackerOutput output = tracker.track(pair);
    EXPECT_EQ(output.result.status, TrackStatus::kTracking);
    out.moving += output.result.moving;
    out.error = position_error(output.result, i);
    for (const KeyframeProposal& proposal : output.proposals) {
      for (const Landmark& l : proposal.new_landmarks)
        known[l.id] = place.contains({static_cast<int>(l.pixel.x()), static_cast<int>(l.pixel.y())});
      for (const LandmarkId id : proposal.moving_landmarks) known.erase(id);
    }
  }
  for (const auto& [id, on_boat] : known) ++(on_boat ? out.boat : out.rest);
  return out;
}

TEST(Tracker, LandmarksThatMoveAreLetGoAndTakenBackFromTheMap) {
  const HandedOver all = passing_a_boat(false), standing = passing_a_boat(true);
  EXPECT_EQ(all.moving, 0);
  EXPECT_GT(all.boat, 20);
  EXPECT_GT(standing.moving, 10);
  EXPECT_LT(standing.boat, 0.7 * all.boat) << standing.boat << " of " << all.boat;
  EXPECT_GT(standing.rest, 0.8 * all.rest);
  EXPECT_LT(standing.error, 0.01);
}

// Culling may give a landmark that is still followed another host: what the map says of it then holds there.
TEST(Tracker, DepthsInAnotherHostAreNotTakenOver) {
  const test::PlaneScene scene(11);
  Tracker tracker(scene.rig(), small_options());
  LocalMapView view;
  for (int i = 0; i < 20; ++i) {
    if (!view.keyframes.empty()) tracker.adopt(view);
    const TrackerOutput output = tracker.track(scene.pair(0.1 * i, pose_at(i)));
    ASSERT_EQ(output.result.status, TrackStatus::kTracking);
    EXPECT_LT(position_error(output.result, i), 0.01);
    for (const KeyframeProposal& proposal : output.proposals) {
      view = {view.revision + 1, true, {proposal.keyframe}, proposal.new_landmarks};
      for (Landmark& landmark : view.landmarks) landmark.host = {77}, landmark.inverse_depth *= 3;
    }
  }
  EXPECT_GT(view.revision, 0);
}

TEST(Tracker, EveryFrameSettlesOnceAndInOrder) {
  const test::PlaneScene scene(12);
  Tracker tracker(scene.rig(), small_options());
  std::vector<std::int64_t> settled;
  std::size_t keyframes = 0, proposals = 0;
  const auto note = [&](const TrackerOutput& out) {
    for (const FramePose& pose : out.settled) settled.push_back(pose.frame.value);
    proposals += out.proposals.size();
    keyframes += out.result.keyframe_id.valid();
  };
  for (int i = 0; i < 12; ++i)
    note(tracker.track(i == 6 ? broken(0.1 * i) : scene.pair(0.1 * i, pose_at(i))));
  note(tracker.finish());
  ASSERT_EQ(settled.size(), 12U);
  for (int i = 0; i < 12; ++i) EXPECT_EQ(settled[i], i);
  EXPECT_EQ(proposals, keyframes);
}

TEST(Tracker, CoastsOverABadPairAndIsLostAfterTooLong) {
  const test::PlaneScene scene(13);
  const TrackerOptions options = small_options();
  Tracker tracker(scene.rig(), options);
  for (int i = 0; i < 4; ++i) tracker.track(scene.pair(0.1 * i, pose_at(i)));
  const TrackResult coasting = tracker.track(broken(0.4)).result;
  EXPECT_EQ(coasting.status, TrackStatus::kCoasting);
  EXPECT_EQ(coasting.reason, "left image truncated");
  EXPECT_LT(position_error(coasting, 4), 0.01);  // constant velocity carries
  const TrackResult later = tracker.track(broken(0.8)).result;
  EXPECT_GT(later.covariance.trace(), coasting.covariance.trace());
  EXPECT_GT(later.entropy, coasting.entropy);
  const TrackResult lost = tracker.track(broken(0.4 + options.state.coast_time + 0.1)).result;
  EXPECT_EQ(lost.status, TrackStatus::kLost);
  EXPECT_GT(lost.covariance(0, 0), 1e3);
}

TEST(Tracker, RecoversAfterABadPair) {
  const test::PlaneScene scene(14);
  Tracker tracker(scene.rig(), small_options());
  for (int i = 0; i < 4; ++i) tracker.track(scene.pair(0.1 * i, pose_at(i)));
  tracker.track(broken(0.4));
  const TrackResult after = tracker.track(scene.pair(0.5, pose_at(5))).result;
  EXPECT_EQ(after.status, TrackStatus::kTracking);
  EXPECT_LT(position_error(after, 5), 0.01);
}

TEST(Tracker, WithoutAnythingToSeeItDoesNotBegin) {
  const test::PlaneScene scene(15);
  Tracker tracker(scene.rig(), small_options());
  const cv::Mat blank(240, 320, CV_8UC1, cv::Scalar(100));
  const TrackResult result = tracker.track({0, blank, blank, ""}).result;
  EXPECT_EQ(result.status, TrackStatus::kInitializing);
  EXPECT_FALSE(result.reason.empty());
  EXPECT_EQ(tracker.track(broken(0.1)).result.status, TrackStatus::kInitializing);
  EXPECT_EQ(tracker.track(scene.pair(0.2, pose_at(0))).result.status, TrackStatus::kTracking);
}

TEST(Tracker, ImagesOfAnotherSizeAreNamed) {
  const test::PlaneScene scene(16);
  Tracker tracker(scene.rig(), small_options());
  const cv::Mat wide(240, 640, CV_8UC1, cv::Scalar(100));
  EXPECT_NE(tracker.track({0, wide, wide, ""}).result.reason.find("640 x 240"), std::string::npos);
}

}  // namespace
}  // namespace spslam
