// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Every option of the system, its presets, and how they are read and written.
#pragma once

#include <filesystem>

#include "spslam/loop/essential_graph.h"
#include "spslam/loop/full_adjustment.h"
#include "spslam/loop/fusion.h"
#include "spslam/loop/localization.h"
#include "spslam/loop/loop_closer.h"
#include "spslam/loop/relocalizer.h"
#include "spslam/mapping/local_mapper.h"
#include "spslam/odometry/options.h"

namespace spslam {

// Whether the stages run in threads of their own, or in order in the caller's thread with the same bits on
// every run.
enum class Threads { kParallel, kSequential };

inline std::span<const char* const> option_names(Threads) {
  static constexpr const char* names[] = {"parallel", "sequential"};
  return names;
}

struct LoopOptions {
  bool enabled = true;
  DetectionOptions detection;
  VerificationOptions verification;
  PatchPoseOptions patches;
  EssentialGraphOptions graph;
  FusionOptions fusion;
  FullAdjustmentOptions full_adjustment;
  RelocalizationOptions relocalization;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.enabled, {"enabled", "", "close loops"});
    visit.group("detection", self.detection);
    visit.group("verification", self.verification);
    visit.group("patches", self.patches);
    visit.group("graph", self.graph);
    visit.group("fusion", self.fusion);
    visit.group("full_adjustment", self.full_adjustment);
    visit.group("relocalization", self.relocalization);
  }
};

struct SlamOptions {
  Threads threads = Threads::kParallel;
  TrackerOptions tracker;
  LocalMapperOptions mapper;
  LoopOptions loop;
  LocalizationOptions localization;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.threads, {"threads", "", "parallel, or sequential for the same bits on every run"});
    visit.group("tracker", self.tracker);
    visit.group("mapper", self.mapper);
    visit.group("loop", self.loop);
    visit.group("localization", self.localization);
  }
};

// sp-slam: what measures best. paper: the paper as written, nothing more. baseline: the feature SLAM that the
// paper starts from.
enum class Preset { kSpSlam, kPaper, kBaseline };

inline std::span<const char* const> option_names(Preset) {
  static constexpr const char* names[] = {"sp-slam", "paper", "baseline"};
  return names;
}

SlamOptions preset_options(Preset preset);

// Sets what a YAML text says, nested or with dotted keys. Throws OptionError: "name: ..." for text that is
// not YAML, for an unknown key (with the nearest known one), for a value that does not fit.
void apply_yaml(SlamOptions& options, const std::string& text, const std::string& name);
void apply_yaml_file(SlamOptions& options, const std::filesystem::path& path);

// All options as YAML, each with its unit and meaning as a comment; apply_yaml() reads it back to the same
// options.
std::string to_yaml(const SlamOptions& options);

}  // namespace spslam
