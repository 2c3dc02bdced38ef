// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/io/point_cloud.h"

#include <gmock/gmock.h>

namespace spslam {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct Seen {
  std::int64_t id;
  double inverse_depth, information;
  Region region = Region::kNear;
  int observers = 2;
};

// Two keyframes 1 m apart on the world's z axis; landmarks straight ahead of the second.
Map map_of(const std::vector<Seen>& landmarks) {
  Map map;
  std::vector<Keyframe> keyframes(2);
  for (int k = 0; k < 2; ++k) {
    keyframes[k].id = {k};
    keyframes[k].frame = {10 * k};
    keyframes[k].timestamp = 0.5 * k;
    keyframes[k].camera_from_world.translation.z() = -k;
  }
  for (const Seen& seen : landmarks) {
    Landmark landmark;
    landmark.id = {seen.id};
    landmark.host = {1};
    landmark.inverse_depth = seen.inverse_depth;
    landmark.information = seen.information;
    landmark.region = seen.region;
    map.add(landmark);
    Sighting sighting;
    sighting.landmark = {seen.id};
    for (int k = 0; k < seen.observers; ++k) keyframes[1 - k].sightings.push_back(sighting);
  }
  for (Keyframe& keyframe : keyframes) map.add(keyframe);
  return map;
}

std::vector<std::int64_t> ids(const std::vector<CloudPoint>& points) {
  std::vector<std::int64_t> out;
  for (const CloudPoint& point : points) out.push_back(point.id.value);
  return out;
}

TEST(PointCloud, PointsLieInTheWorld) {
  const std::vector<CloudPoint> points = cloud_points(map_of({{4, 0.25, 1e6}}));
  ASSERT_EQ(points.size(), 1U);
  EXPECT_LT((points[0].position - Eigen::Vector3d(0, 0, 5)).norm(), 1e-12);  // 4 m ahead of z = 1
  EXPECT_NEAR(points[0].sigma, 4 * 4 * 1e-3, 1e-12);                         // d^2 times that of 1/d
  EXPECT_EQ(points[0].observers, 2);
}

TEST(PointCloud, LeavesOutWhatHasNoUsableDepth) {
  const Map map = map_of({{0, 0.1, 1e6},                      // 1 %
                          {1, 0.1, 2500},                     // 20 %
                          {2, 0.0, 1e6},                      // at infinity
                          {3, -0.01, 1e6},                    // behind
                          {4, 0.1, 0},                        // nothing known
                          {5, 0.1, 1e6, Region::kMirror},     // not where it seems to be
                          {6, 0.1, 1e6, Region::kFar},        //
                          {7, 0.1, 1e6, Region::kNear, 1}});  // seen once
  EXPECT_THAT(ids(cloud_points(map)), ElementsAre(0, 6));
  EXPECT_THAT(ids(cloud_points(map, {.max_uncertainty = 0.3})), ElementsAre(0, 1, 6));
  EXPECT_THAT(ids(cloud_points(map, {.min_observers = 1})), ElementsAre(0, 6, 7));
}

TEST(PointCloud, Ply) {
  const Map map = map_of({{0, 0.5, 1e6}, {1, 0.25, 1e6, Region::kFar}});
  const std::string text = format_ply(cloud_points(map), map);
  EXPECT_THAT(text, testing::StartsWith("ply\nformat ascii 1.0\n"));
  EXPECT_THAT(text, HasSubstr("element vertex 4\n"));
  EXPECT_THAT(text, HasSubstr("element edge 1\n"));
  EXPECT_THAT(text, testing::EndsWith("end_header\n"
                                      "0.0000 0.0000 3.0000 31 157 77 0.004\n"
                                      "0.0000 0.0000 5.0000 214 52 47 0.016\n"
                                      "0.0000 0.0000 0.0000 11 107 203 0\n"
                                      "0.0000 0.0000 1.0000 11 107 203 0\n"
                                      "2 3\n"));
  EXPECT_THAT(format_ply({}, Map()), HasSubstr("element edge 0\n"));
}

TEST(PointCloud, Csv) {
  const Map map = map_of({{8, 0.5, 1e6}});
  EXPECT_EQ(format_points_csv(cloud_points(map)),
            "landmark,x,y,z,sigma,region,observers\n8,0.0000,0.0000,3.0000,0.004,near,2\n");
  EXPECT_THAT(format_keyframe_poses_csv(map),
              testing::EndsWith("\n1,10,0.500000000,0.000000,0.000000,1.000000,0.000000000,0.000000000,"
                                "0.000000000,1.000000000,0\n"));
}

}  // namespace
}  // namespace spslam
