// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/system/slam_options.h"

#include <yaml-cpp/yaml.h>

#include <fstream>
#include <set>
#include <sstream>

namespace spslam {
namespace {

// What the feature SLAM of the paper and its starting point have in common.
SlamOptions feature_slam_options() {
  SlamOptions options;
  TrackerOptions& t = options.tracker;
  t.stereo_by_descriptor = true;
  t.follow.identity = Identity::kDescriptor;
  t.follow.align = false;
  t.follow.max_missed = 5;
  t.keyframe.lost_of_keyframe = 0.7;
  t.keyframe.max_frames = 20;
  t.window_frames = 1;
  t.trial.enabled = false;
  t.movers.enabled = false;
  t.alignment.noise_factor = 0;
  t.landmarks.count = 1500;
  t.landmarks.levels = t.orb.levels;
  t.motion.loss = Loss::kHuber;
  t.motion.loss_scale = 2.4;
  return options;
}

// Each key once: of two values one would be forgotten without a word.
void apply_node(SlamOptions& options, const YAML::Node& node, const std::string& prefix,
                std::set<std::string>& given) {
  for (const auto& entry : node) {
    const std::string key = prefix + entry.first.as<std::string>();
    if (entry.second.IsMap())
      apply_node(options, entry.second, key + ".", given);
    else if (!given.insert(key).second)
      throw OptionError("option " + key + ": is given twice; leave one of them out");
    else if (entry.second.IsScalar())
      set_option(options, key, entry.second.as<std::string>());
    else
      throw OptionError("option " + key + ": a single value is expected, not a list or nothing");
  }
}

}  // namespace

SlamOptions preset_options(Preset preset) {
  if (preset == Preset::kSpSlam) return {};
  SlamOptions options = feature_slam_options();
  TrackerOptions& t = options.tracker;
  SolverOptions& adjustment = options.mapper.adjustment.solver;
  if (preset == Preset::kPaper) {
    t.stereo = paper_stereo_options();
    adjustment.loss = Loss::kPseudoHuber;  // 3.2.2
    return options;
  }
  adjustment.loss = Loss::kHuber;
  adjustment.loss_scale = 2.4;
  options.mapper.retriangulation.enabled = false;
  t.stereo = baseline_stereo_options();
  t.segment = false;
  t.far.enabled = false;
  t.keyframe.entropy = false;
  return options;
}

void apply_yaml(SlamOptions& options, const std::string& text, const std::string& name) {
  try {
    const YAML::Node root = YAML::Load(text);
    if (root.IsNull()) return;
    if (!root.IsMap()) throw OptionError("a map of options is expected, like `tracker: {window_frames: 5}`");
    std::set<std::string> given;
    apply_node(options, root, "", given);
  } catch (const YAML::Exception& error) {
    throw OptionError(name + ": not valid YAML: " + error.what());
  } catch (const OptionError& error) {
    throw OptionError(name + ": " + error.what());
  }
}

void apply_yaml_file(SlamOptions& options, const std::filesystem::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf()))
    throw OptionError(path.string() + ": cannot be read; give a YAML file of options");
  apply_yaml(options, text.str(), path.string());
}

std::string to_yaml(const SlamOptions& options) {
  std::ostringstream out;
  for (const OptionText& option : list_options(options)) {
    out << option.key << ": " << option.value << "  # " << option.meaning;
    if (!option.unit.empty()) out << " [" << option.unit << "]";
    out << "\n";
  }
  return out.str();
}

}  // namespace spslam
