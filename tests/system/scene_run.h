// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// What the tests of whole runs share.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/core.hpp>

#include "base/temporary_folder.h"
#include "spslam/eval/evaluation.h"
#include "spslam/system/map_file.h"
#include "spslam/system/slam.h"
#include "system/synthetic_scene.h"

namespace spslam::test {

// Rendered once for all tests of a program; cv::Mat shares the pixels, nobody writes to them.
inline const std::vector<StereoFrame>& scene_pairs() {
  static const std::vector<StereoFrame> pairs = [] {
    std::vector<StereoFrame> all;
    for (int i = 0; i < kSceneFrames; ++i) all.push_back(scene_pair(i));
    return all;
  }();
  return pairs;
}

inline SlamOptions sequential_options(Preset preset = Preset::kSpSlam) {
  SlamOptions options = preset_options(preset);
  options.threads = Threads::kSequential;
  return options;
}

inline Trajectory poses_of(const Slam& slam) {
  Trajectory trajectory;
  for (const TrajectoryPose& pose : slam.trajectory())
    trajectory.push_back({pose.timestamp, pose.world_from_camera});
  return trajectory;
}

inline StereoFrame at_time(StereoFrame pair, double timestamp) {
  pair.timestamp = timestamp;
  return pair;
}

// Another place that looks as real: the scene in a mirror. New images, for those of the pair are shared.
inline StereoFrame mirrored(const StereoFrame& pair, double timestamp) {
  StereoFrame out;
  out.timestamp = timestamp;
  cv::flip(pair.right, out.left, 1);
  cv::flip(pair.left, out.right, 1);
  return out;
}

// The map of a run over all pairs, after a way through a file.
inline Map saved_and_loaded() {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "scene.map";
  {
    Slam slam(scene_rig(), sequential_options());
    for (const StereoFrame& pair : scene_pairs()) slam.track(pair);
    slam.finish();
    slam.save(path);
  }
  SavedMap saved = load_map(path);
  check_same_rig(saved.rig, scene_rig());
  return std::move(saved.map);
}

inline double distance_from_truth(const SE3& world_from_camera, int index) {
  return (world_from_camera.translation - scene_pose(index).translation).norm();
}

struct SceneRun {
  std::vector<TrackResult> results;
  Trajectory trajectory;  // after finish()
};

inline SceneRun run_pairs(const std::vector<StereoFrame>& pairs, const SlamOptions& options,
                          const StereoRig& rig = scene_rig()) {
  SceneRun run;
  Slam slam(rig, options);
  for (const StereoFrame& pair : pairs) run.results.push_back(slam.track(pair));
  slam.finish();
  run.trajectory = poses_of(slam);
  return run;
}

inline Evaluation evaluate_scene(const Trajectory& trajectory) {
  return evaluate(trajectory, scene_truth(), {});
}

inline std::vector<TrackStatus> statuses(const SceneRun& run) {
  std::vector<TrackStatus> all;
  for (const TrackResult& result : run.results) all.push_back(result.status);
  return all;
}

}  // namespace spslam::test
