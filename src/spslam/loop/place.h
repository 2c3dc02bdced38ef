// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// A place of the map as somebody who may be there again compares it with what he sees: the features of a
// keyframe and of those around it, as points in the keyframe's left camera.
#pragma once

#include "spslam/camera/stereo_rig.h"
#include "spslam/map/map.h"

namespace spslam {

struct PlacePoint {
  Eigen::Vector3d bearing = Eigen::Vector3d::UnitZ();  // (x, y, 1) in the place's camera
  double inverse_depth = 0, information = 0;           // 1/m and m^2; 0: the depth is not known
  int source = 0, feature = 0;                         // where it is from
};

struct PlaceSource {
  KeyframeId id;
  std::shared_ptr<const KeyframeFeatures> features;
  std::vector<int> point;  // of each feature, or -1
};

struct Place {
  KeyframeId id;
  std::vector<PlaceSource> sources;  // the keyframe itself first
  std::vector<PlacePoint> points;

  const Keypoint& keypoint(const PlacePoint& p) const {
    return sources[p.source].features->keypoints[p.feature];
  }
  const Descriptor& descriptor(const PlacePoint& p) const {
    return sources[p.source].features->descriptors[p.feature];
  }
};

// The keyframe and at most `neighbours` of those that share most landmarks with it. Features of neighbours
// whose depth is not known have no point, nor have those that are not finite. Without sources if the keyframe
// is not there or not described.
Place place_of(const Map& map, const StereoRig& rig, KeyframeId id, int neighbours);

// A lone keyframe that is in no map.
Place place_of(const StereoRig& rig, KeyframeId id, std::shared_ptr<const KeyframeFeatures> features);

}  // namespace spslam
