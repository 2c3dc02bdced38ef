// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// What a map is made of, by value and by id. Images are shared (cv::Mat counts references) and never written
// to.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "spslam/alignment/pyramid.h"
#include "spslam/base/ids.h"
#include "spslam/base/se3.h"
#include "spslam/features/types.h"
#include "spslam/segmentation/regions.h"

namespace spslam {

struct Landmark {
  LandmarkId id;
  KeyframeId host;  // the keyframe it was first seen from; what follows is in its left camera
  Eigen::Vector2f pixel = Eigen::Vector2f::Zero();     // px
  Eigen::Vector3d bearing = Eigen::Vector3d::UnitZ();  // (x, y, 1)
  double inverse_depth = 0;  // 1/m along z; near or below 0: a direction without a depth
  double information = 0;    // m^2, of the inverse depth
  // What stereo alone said of the inverse depth in frames that did not become keyframes.
  double stereo_inverse_depth = 0, stereo_information = 0;
  Region region = Region::kNear;
  Descriptor descriptor = {};
  std::uint8_t octave = 0;
};

// Where a landmark was seen: u, v, disparity in px, and the inverse of each one's standard deviation, 0 if
// not measured.
struct Sighting {
  LandmarkId landmark;
  Eigen::Vector3d measured = Eigen::Vector3d::Zero();
  Eigen::Vector3d inverse_sigma = Eigen::Vector3d::Zero();
  double weight = 1;  // w_t of equation (8) for far points, else 1
};

// ORB features of a keyframe, over all levels of the pyramid: what it is recognized by. All vectors are of
// one length.
struct KeyframeFeatures {
  std::vector<Keypoint> keypoints;
  std::vector<Descriptor> descriptors;
  std::vector<float> inverse_depths;  // 1/m along z of the left camera
  std::vector<float> information;     // m^2, of the inverse depth; 0 where none was measured
  float level_scale = 1.2F;  // of the pyramid: a corner of level n is known level_scale^n times worse

  std::size_t size() const { return keypoints.size(); }
};

// What a frame is recognized by, and what then tells where it is.
struct SeenFrame {
  KeyframeFeatures features;
  AlignmentPyramid left;
};

using ImageBytes = std::vector<std::uint8_t>;  // of an image file (keyframe_image.h)

struct Keyframe {
  KeyframeId id;
  FrameId frame;
  double timestamp = 0;  // s
  SE3 camera_from_world;
  AlignmentPyramid left = {};            // as long as somebody follows its patches; empty in an old keyframe
  std::vector<Sighting> sightings = {};  // ascending, one a landmark it saw, its own among them
  std::shared_ptr<const KeyframeFeatures> features = {};  // null until the mapper has described it
  std::shared_ptr<const ImageBytes> image = {};           // what stays of `left`; null if not wanted
  KeyframeId parent = {};                                 // in the spanning tree; not valid for its root
};

// The motion between two keyframes as a recognized place gave it.
struct LoopEdge {
  KeyframeId older, newer;
  SE3 newer_from_older;
  double weight = 1;  // inliers that it rests on
};

// What the tracker hands to the mapper when it wants a keyframe: the keyframe with all it saw, the landmarks
// that it is the first to see, and the present estimates of the others it saw.
struct KeyframeProposal {
  Keyframe keyframe;  // its sightings' disparities without the rig's offset
  // The keyframe handed over before it and the motion from there, so that corrections that the tracker does
  // not know yet move the new one along. Not valid for the first.
  KeyframeId previous;
  SE3 camera_from_previous;
  std::vector<Landmark> new_landmarks;
  std::vector<Landmark> known_landmarks;
  std::vector<LandmarkId> moving_landmarks;  // that turned out to move by themselves since the one before
};

// What the mapper publishes for the tracker: the corrected neighbourhood of the newest keyframe. Immutable.
struct LocalMapView {
  std::int64_t revision = 0;        // grows with every publication
  bool corrected = false;           // poses or landmarks differ from what the tracker proposed
  std::vector<Keyframe> keyframes;  // ascending; without sightings and features
  std::vector<Landmark> landmarks;  // hosted by these keyframes; ascending
};

}  // namespace spslam
