// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Every default scene but open_water and fog_traffic offers ORB more than 800 keypoints (docs/SIMULATOR.md).

#include <gtest/gtest.h>

#include "spslam/features/orb_extractor.h"
#include "spslam/sim/simulator.h"

namespace spslam::sim {
namespace {

class Corners : public testing::TestWithParam<const char*> {};

TEST_P(Corners, ThereAreMoreThanEightHundred) {
#ifdef SPSLAM_SANITIZED
  GTEST_SKIP() << "a full scene takes minutes under a sanitizer";
#endif
  Simulator simulator(load_scene(GetParam()), 1);
  const SimulatedFrame frame = *simulator.next();
  EXPECT_GT(OrbExtractor().extract(frame.images.left).keypoints.size(), 800U);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Corners,
                         testing::Values("bank", "bridge_turn", "lake_loop", "rain", "glare", "canal"));

TEST(OpenWater, NothingIsNearerThanSixtyMetres) {
  SceneDescription scene = load_scene("open_water");
  scene.render.detail = 0.05;
  scene.rig.focal = 90, scene.rig.width = 160, scene.rig.height = 80;
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    const Simulator simulator(scene, seed);
    for (double t = 0; t < simulator.motion().duration(); t += 8) {
      const FrameTruth truth = simulator.truth(t);
      for (int y = 0; y < truth.depth.rows; ++y)
        for (int x = 0; x < truth.depth.cols; ++x)
          if (truth.water.at<std::uint8_t>(y, x) == 0 && truth.depth.at<float>(y, x) > 0) {
            ASSERT_GT(truth.depth.at<float>(y, x), 60) << "seed " << seed << " at " << t << " s";
          }
    }
  }
}

}  // namespace
}  // namespace spslam::sim
