// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/sim/scene_description.h"

#include <gmock/gmock.h>

#include "spslam/sim/motion.h"

namespace spslam::sim {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const OptionError& error) {
    return error.what();
  }
  return "no error";
}

TEST(SceneDescription, TheNamedScenesAreThere) {
  EXPECT_THAT(scene_names(), testing::ElementsAre("bank", "bridge_turn", "canal", "fog_traffic", "glare",
                                                  "lake_loop", "open_water", "rain"));
}

TEST(SceneDescription, NamedScenesAreSound) {
  for (const std::string& name : scene_names()) {
    const SceneDescription scene = load_scene(name);
    EXPECT_NO_THROW(scene.check()) << name;
    EXPECT_GE(scene.path.length, 60) << name;
    EXPECT_LE(scene.path.length, 400) << name;
    EXPECT_DOUBLE_EQ(scene.stereo_rig().baseline, 0.08) << name;
    EXPECT_DOUBLE_EQ(scene.stereo_rig().cx, 319.5) << name;
    EXPECT_NE(scene.title, SceneDescription().title) << name;
  }
}

TEST(SceneDescription, SuggestsTheNearestScene) {
  EXPECT_THAT(message_of([] { load_scene("lake_lop"); }),
              AllOf(HasSubstr("'lake_lop'"), HasSubstr("did you mean 'lake_loop'")));
  EXPECT_THAT(message_of([] { load_scene("nonsense_of_another_kind"); }), HasSubstr("open_water"));
}

TEST(SceneDescription, AnUnknownKeyNamesFileLineAndNeighbour) {
  EXPECT_THAT(message_of([] { parse_scene("title: a\nshore:\n  left: {hight: 2}\n", "my.yaml"); }),
              AllOf(HasSubstr("my.yaml:3"), HasSubstr("shore.left.hight"), HasSubstr("shore.left.height")));
}

TEST(SceneDescription, BadYamlNamesTheLine) {
  EXPECT_THAT(message_of([] { parse_scene("title: a\npath: [1, 2\n", "my.yaml"); }), HasSubstr("my.yaml:"));
  EXPECT_THAT(message_of([] { parse_scene("path: {length: [1, 2]}\n", "my.yaml"); }),
              HasSubstr("path.length"));
  EXPECT_THAT(message_of([] { parse_scene("- 1\n- 2\n", "my.yaml"); }), HasSubstr("my.yaml"));
}

TEST(SceneDescription, Settings) {
  SceneDescription scene;
  apply_setting(scene, "shore.right.distance=4.5");
  apply_setting(scene, "shore.right.kind=brick");
  EXPECT_EQ(scene.shore.right.distance, 4.5);
  EXPECT_EQ(scene.shore.right.kind, BankKind::kBrick);
  EXPECT_THAT(message_of([&] { apply_setting(scene, "air.visiblity=9"); }), HasSubstr("air.visibility"));
  EXPECT_THAT(message_of([&] { apply_setting(scene, "air.visibility"); }), HasSubstr("key=value"));
  EXPECT_THAT(message_of([&] { apply_setting(scene, "shore.left.kind=mud"); }), HasSubstr("rubble"));
}

TEST(SceneDescription, ImpossibleRigs) {
  const auto with = [](const std::string& setting) {
    return message_of([&] {
      SceneDescription scene;
      apply_setting(scene, setting);
      scene.check();
    });
  };
  EXPECT_THAT(with("rig.baseline=0"), HasSubstr("rig.baseline"));
  EXPECT_THAT(with("rig.focal=40"), AllOf(HasSubstr("rig.focal"), HasSubstr("160")));
  EXPECT_THAT(with("rig.width=0"), HasSubstr("rig.width"));
  EXPECT_THAT(with("rig.baseline=nan"), HasSubstr("rig.baseline"));
  EXPECT_EQ(with("rig.focal=300"), "no error");
}

TEST(SceneDescription, NamedScenesMoveAsABoatDoes) {
  for (const std::string& name : scene_names()) {
    const SceneDescription scene = load_scene(name);
    const BoatMotion motion(scene, 1);
    double fastest = 0;
    for (double t = 0; t < motion.duration(); t += 0.5) fastest = std::max(fastest, motion.speed(t));
    EXPECT_LE(fastest, 2.2) << name;
    EXPECT_GE(fastest, 0.5) << name;
    EXPECT_NEAR(motion.travelled(motion.duration()), scene.path.length, 0.1) << name;
  }
}

}  // namespace
}  // namespace spslam::sim
