// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// One call from two trajectories to every figure: association, alignment, errors.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "spslam/eval/association.h"
#include "spslam/eval/planar.h"
#include "spslam/eval/trajectory_error.h"
#include "spslam/eval/umeyama.h"

namespace spslam {

struct EvaluationOptions {
  AssociationOptions association;
  AlignMode align = AlignMode::kSe3;
  bool planar = false;
  UpAxis up_estimate = UpAxis::kAuto;
  UpAxis up_truth = UpAxis::kAuto;
  double rpe_interval = 1;
  double within = 0;
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit.group("association", self.association);
    visit(self.align, {"align", "", "none, se3 (rigid) or sim3 (rigid and scale)"});
    visit(self.planar, {"planar", "", "align and measure in the horizontal plane only"});
    visit(self.up_estimate, {"up_estimate", "", "axis that points up in the estimate's world (planar)"});
    visit(self.up_truth, {"up_truth", "", "axis that points up in the truth's world (planar)"});
    visit(self.rpe_interval,
          {"rpe_interval", "s", "time over which the relative error is measured", 1e-3, 1e6});
    visit(self.within,
          {"within", "m", "error up to which a pose counts as right; 0: none is counted", 0, 1e6});
  }
};

struct Evaluation {
  EvaluationOptions options;
  std::size_t estimate_poses = 0;
  std::size_t truth_poses = 0;
  std::size_t associated_poses = 0;
  std::vector<AssociatedPose>
      poses;                       // in the world of the truth (planar: its levelled world), scaled if sim3
  double estimate_length = 0;      // m, of the associated poses, before any scaling
  double truth_length = 0;         // m
  double duration = 0;             // s, from the first associated pose to the last; 0 by index
  Similarity truth_from_estimate;  // as applied; planar: between the levelled worlds
  double scale_ratio = 0;  // the factor by which the estimate would have to be scaled (Sim(3)); NaN: unknown
  AteResult ate;
  double share_within = 0;         // poses within options.within of the truth, over all poses of the truth
  RpeResult rpe_per_second;        // no motion if by index
  RpeResult rpe_per_frame;         // between neighbouring associated poses
  KittiResult kitti;               // always without alignment and scale
  std::vector<std::string> notes;  // what a reader of the figures must know, such as a degenerate alignment
  std::vector<std::string> warnings;  // why they may be figures of nothing: a truth of another sequence
};

// Throws InputError if fewer than three poses can be associated, OptionError if an option is out of range.
Evaluation evaluate(const Trajectory& estimate, const Trajectory& truth, const EvaluationOptions& options);

// A pose that was found in a map, in the world: as the map's nearest pose (by position, of the run that made
// the map, `map` being its Evaluation::poses) lies to its own truth. Without any, the pose as it is.
SE3 laid_by_nearest(std::span<const AssociatedPose> map, const SE3& pose);

struct ReportStyle {
  bool kitti_lengths = false;  // the KITTI metric of each length too
};
// A few lines of text for a terminal.
std::string brief_report(const Evaluation& evaluation, const ReportStyle& style = {});
// One JSON object, indented, with a newline at its end; a figure that does not exist is null.
std::string json_report(const Evaluation& evaluation);
// The figures of such an object (metrics.json); there are no poses and no errors of single ones in it. name
// stands for it in messages. Throws InputError.
Evaluation parse_json_report(std::string_view text, const std::string& name);

}  // namespace spslam
