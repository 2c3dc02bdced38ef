// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Maps of any size: keyframes in a row, each the host of new landmarks and looking back at
// old ones.
#pragma once

#include "features/made_up_descriptors.h"
#include "spslam/base/random.h"
#include "spslam/camera/stereo_rig.h"
#include "spslam/map/map.h"

namespace spslam::test {

struct MadeUpMap {
  int keyframes = 6, features = 5, sightings = 8, image_bytes = 5;  // a keyframe
  std::uint64_t seed = 1;
};

inline StereoRig made_up_rig() {
  return {.fx = 360, .fy = 361, .cx = 319.5, .cy = 159.25, .baseline = 0.08, .width = 640, .height = 320};
}

inline std::shared_ptr<const KeyframeFeatures> made_up_features(int count, Random& random) {
  auto features = std::make_shared<KeyframeFeatures>();
  features->level_scale = 1.25F;
  const auto number = [&](double scale) { return static_cast<float>(scale * random.uniform()); };
  for (int i = 0; i < count; ++i) {
    features->keypoints.push_back(
        {number(640), number(320), number(3), number(100), static_cast<std::uint8_t>(i % 8)});
    features->descriptors.push_back(random_descriptor(random));
    features->inverse_depths.push_back(number(0.2));
    features->information.push_back(i % 3 == 0 ? 0 : number(1e4));
  }
  return features;
}

inline Landmark made_up_landmark(LandmarkId id, KeyframeId host, Random& random) {
  Landmark landmark;
  landmark.id = id;
  landmark.host = host;
  landmark.pixel = {static_cast<float>(640 * random.uniform()), static_cast<float>(320 * random.uniform())};
  landmark.bearing = made_up_rig().bearing(landmark.pixel.x(), landmark.pixel.y());
  landmark.inverse_depth = 0.01 + 0.2 * random.uniform();
  landmark.information = 1e6 * random.uniform();
  landmark.stereo_inverse_depth = 0.3 * random.uniform();
  landmark.stereo_information = 1e3 * random.uniform();
  landmark.region = static_cast<Region>(id.value % 3);
  landmark.descriptor = random_descriptor(random);
  landmark.octave = static_cast<std::uint8_t>(id.value % 8);
  return landmark;
}

inline Sighting made_up_sighting(LandmarkId landmark, Random& random) {
  Sighting sighting;
  sighting.landmark = landmark;
  sighting.measured = {640 * random.uniform(), 320 * random.uniform(), 6 * random.uniform()};
  sighting.inverse_sigma = {1 / (0.1 + random.uniform()), 1 / (0.1 + random.uniform()), 0};
  sighting.weight = random.uniform();
  return sighting;
}

// A quarter of a keyframe's sightings are of landmarks that it is the first to see. The last keyframe has no
// features and no image yet; a loop joins the first and the last.
inline Map made_up_map(const MadeUpMap& wanted = {}) {
  Random random(wanted.seed);
  Map map;
  std::int64_t landmarks = 0;
  for (int k = 0; k < wanted.keyframes; ++k) {
    Keyframe keyframe;
    keyframe.id = {2 * k + 1};  // others were erased
    keyframe.frame = {10 * k};
    keyframe.timestamp = 1.7e9 + 0.1 * k;
    keyframe.camera_from_world =
        SE3::exp((Vector6d() << -0.3 * k, 0, 0.01 * k, 0, 0.02 * k, 0.3 * random.uniform()).finished());
    const std::int64_t fresh = std::max(1, wanted.sightings / 4);
    for (std::int64_t i = 0; i < fresh; ++i)
      map.add(made_up_landmark({3 * landmarks++}, keyframe.id, random));
    const std::int64_t seen = std::min<std::int64_t>(landmarks, wanted.sightings);
    for (std::int64_t i = landmarks - seen; i < landmarks; ++i)
      keyframe.sightings.push_back(made_up_sighting({3 * i}, random));
    if (k + 1 < wanted.keyframes) {
      keyframe.features = made_up_features(wanted.features, random);
      keyframe.image = std::make_shared<const ImageBytes>(wanted.image_bytes, std::uint8_t{7});
    }
    map.add(std::move(keyframe));
  }
  if (wanted.keyframes > 1)
    map.add(LoopEdge{map.keyframes().begin()->first, map.keyframes().rbegin()->first,
                     map.keyframes().begin()->second.camera_from_world, 42});
  return map;
}

}  // namespace spslam::test
