// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/sim/scene_description.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "spslam/sim/hash.h"
#include "spslam/sim/named_scenes.h"

namespace spslam::sim {

std::span<const char* const> option_names(PathShape) {
  static constexpr const char* names[] = {"follow", "turn", "loop"};
  return names;
}

std::span<const char* const> option_names(BankKind) {
  static constexpr const char* names[] = {"none",     "rubble", "masonry", "brick",
                                          "concrete", "timber", "earth",   "mixed"};
  return names;
}

std::span<const char* const> option_names(ShoreShape) {
  static constexpr const char* names[] = {"channel", "lake"};
  return names;
}

namespace {

std::string where(const std::string& source, const YAML::Mark& mark) {
  return source + (mark.is_null() ? "" : ":" + std::to_string(mark.line + 1)) + ": ";
}

// As set_option(), whose message would point to the system's options instead of the scene's.
void set_scene_option(SceneDescription& scene, const std::string& key, const std::string& text) {
  std::vector<std::string> known;
  for (const OptionText& option : list_options(scene)) known.push_back(option.key);
  if (std::find(known.begin(), known.end(), key) != known.end()) return set_option(scene, key, text);
  const std::string nearest = nearest_name(key, known);
  throw OptionError("a scene has no option '" + key + "'" +
                    (nearest.empty() ? "" : "; did you mean '" + nearest + "'?") +
                    " `spslam simulate SCENE --print` lists all");
}

// The YAML tree's leaves are the options' dotted keys.
void read_node(SceneDescription& scene, const YAML::Node& node, const std::string& prefix,
               const std::string& source) {
  for (const auto& entry : node) {
    const std::string key = prefix + entry.first.as<std::string>();
    if (entry.second.IsMap()) {
      read_node(scene, entry.second, key + ".", source);
      continue;
    }
    if (!entry.second.IsScalar())
      throw OptionError(where(source, entry.second.Mark()) + "'" + key +
                        "' needs one value, a list is not one");
    try {
      set_scene_option(scene, key, entry.second.as<std::string>());
    } catch (const OptionError& error) {
      throw OptionError(where(source, entry.first.Mark()) + error.what());
    }
  }
}

std::string read_text(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw OptionError("cannot read the scene '" + path + "'; check the path and its permissions");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace

SceneDescription parse_scene(const std::string& yaml, const std::string& source) {
  SceneDescription scene;
  try {
    const YAML::Node root = YAML::Load(yaml);
    if (!root.IsNull() && !root.IsMap())
      throw OptionError(source + ": a scene is a YAML map such as 'path: {length: 60}', this is not one");
    read_node(scene, root, "", source);
  } catch (const YAML::Exception& error) {
    throw OptionError(where(source, error.mark) + "not valid YAML: " + error.msg);
  }
  return scene;
}

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const NamedScene& scene : named_scenes()) names.emplace_back(scene.name);
  return names;
}

SceneDescription load_scene(const std::string& name_or_path) {
  for (const NamedScene& scene : named_scenes())
    if (name_or_path == scene.name) return parse_scene(scene.yaml, std::string("scene ") + scene.name);
  std::error_code ignored;
  if (std::filesystem::is_regular_file(name_or_path, ignored))
    return parse_scene(read_text(name_or_path), name_or_path);
  const std::vector<std::string> names = scene_names();
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  const std::string nearest = nearest_name(name_or_path, names);
  throw OptionError("there is no scene '" + name_or_path + "'" +
                    (nearest.empty() ? "" : "; did you mean '" + nearest + "'?") + " Scenes: " + list +
                    "; or give the path of a YAML file");
}

void apply_setting(SceneDescription& scene, const std::string& assignment) {
  const std::size_t equal = assignment.find('=');
  if (equal == std::string::npos || equal == 0)
    throw OptionError("'" + assignment +
                      "' is not a setting; write key=value, for example air.visibility=100");
  set_scene_option(scene, assignment.substr(0, equal), assignment.substr(equal + 1));
}

void SceneDescription::check() const {
  check_options(*this);
  const double half = 0.5 * std::hypot(rig.width, rig.height);
  const double view = 2 * std::atan(half / rig.focal) * 180 / M_PI;
  if (view > 160)
    throw OptionError("rig.focal = " + std::to_string(rig.focal) + " px at " + std::to_string(rig.width) +
                      " x " + std::to_string(rig.height) + " px is a field of view of " +
                      std::to_string(view) +
                      " degrees, a pinhole camera has at most 160; give a longer focal length");
  stereo_rig().check();
}

StereoRig SceneDescription::stereo_rig() const {
  StereoRig result;
  result.fx = result.fy = rig.focal;
  result.cx = 0.5 * (rig.width - 1);
  result.cy = 0.5 * (rig.height - 1);
  result.baseline = rig.baseline;
  result.width = rig.width;
  result.height = rig.height;
  return result;
}

std::uint32_t SceneDescription::passage_seed(std::uint32_t seed) const {
  return passage == 0 ? seed : mix(seed, static_cast<std::uint32_t>(passage));
}

}  // namespace spslam::sim
