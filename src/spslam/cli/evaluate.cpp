// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// `spslam evaluate`: how far an estimated trajectory is from the true one.

#include <cstdio>

#include "spslam/base/error.h"
#include "spslam/cli/commands.h"
#include "spslam/eval/evaluation.h"
#include "spslam/eval/trajectory_pair.h"
#include "spslam/io/text.h"

namespace spslam {
namespace {

struct EvaluateArguments {
  TrajectoryPairFiles files;
  EvaluationOptions options;
  std::string origin_estimate, origin_truth;
  TrajectoryPairFiles map;  // of the run that made the map
  bool map_nearest = false;
  bool kitti = false;
  bool json = false;
};

// Of a file of poses; the identity without a file.
SE3 first_pose(const std::string& file) {
  if (file.empty()) return {};
  const Trajectory poses = parse_kitti_poses(read_text_file(file), file);
  if (poses.empty()) throw InputError(file + " has no pose, so it says nothing of an origin");
  return poses.front().world_from_camera;
}

// The run that made the map, laid on its truth.
Evaluation evaluate_map(const EvaluateArguments& arguments) {
  if (arguments.options.align != AlignMode::kNone)
    throw OptionError("--map-estimate: the map lays the estimate on the truth, so give --align none with it");
  TrajectoryPairFiles files = arguments.map;
  files.estimate_format = arguments.files.estimate_format;
  files.truth_format = arguments.files.truth_format;
  const TrajectoryPair pair = read_trajectory_pair(files);
  EvaluationOptions options;
  options.association = arguments.options.association;
  options.association.by_index = pair.by_index;
  return evaluate(pair.estimate, pair.truth, options);
}

int evaluate_files(const EvaluateArguments& arguments) {
  TrajectoryPair pair = read_trajectory_pair(arguments.files);
  Evaluation map;
  if (!arguments.map.estimate.empty()) map = evaluate_map(arguments);
  for (StampedPose& pose : pair.estimate) {
    pose.world_from_camera = map.truth_from_estimate * pose.world_from_camera;
    if (arguments.map_nearest) pose.world_from_camera = laid_by_nearest(map.poses, pose.world_from_camera);
  }
  const SE3 estimate_from_truth =
      first_pose(arguments.origin_estimate).inverse() * first_pose(arguments.origin_truth);
  for (StampedPose& pose : pair.truth) pose.world_from_camera = estimate_from_truth * pose.world_from_camera;
  EvaluationOptions options = arguments.options;
  options.association.by_index = pair.by_index;
  Evaluation evaluation = evaluate(pair.estimate, pair.truth, options);
  for (const std::string& note : map.notes) evaluation.notes.push_back("the map: " + note);
  for (const std::string& warning : map.warnings) evaluation.warnings.push_back("the map: " + warning);
  const std::string text =
      arguments.json ? json_report(evaluation) : brief_report(evaluation, {.kitti_lengths = arguments.kitti});
  std::fputs(text.c_str(), stdout);
  if (arguments.json)  // which is read by programs
    for (const std::string& warning : evaluation.warnings)
      std::fprintf(stderr, "spslam: warning: %s\n", warning.c_str());
  return 0;
}

void add_file_options(CLI::App& command, TrajectoryPairFiles& files) {
  command.add_option("ESTIMATE", files.estimate, "Estimated trajectory")->required();
  command.add_option("GROUNDTRUTH", files.truth, "True trajectory")->required();
  const char* formats = "Format of the estimate: auto, tum, kitti, euroc or usvinland";
  command.add_option("--format-estimate", files.estimate_format, formats)
      ->transform(enum_names<TrajectoryFormat>())
      ->type_name("FORMAT");
  command.add_option("--format-truth", files.truth_format, "Format of the ground truth, likewise")
      ->transform(enum_names<TrajectoryFormat>())
      ->type_name("FORMAT");
  command
      .add_option(
          "--times", files.times,
          "Times of the rows of a KITTI file, one a line (default: NAME_times.txt or times.txt beside it)")
      ->type_name("FILE");
}

void add_metric_options(CLI::App& command, EvaluationOptions& options) {
  command
      .add_option("--align", options.align,
                  "How the estimate is laid on the truth: se3 (default), sim3 or none")
      ->transform(enum_names<AlignMode>())
      ->type_name("MODE");
  command.add_flag("--planar", options.planar, "In the horizontal plane only, for truth without heights");
  const char* up = "Axis that points up in the estimate's world (planar): auto, x, y, z, -x, -y or -z";
  command.add_option("--up-estimate", options.up_estimate, up)
      ->transform(enum_names<UpAxis>())
      ->type_name("AXIS");
  command.add_option("--up-truth", options.up_truth, "The same of the truth's world")
      ->transform(enum_names<UpAxis>())
      ->type_name("AXIS");
  command
      .add_option("--within", options.within,
                  "Print the share of the truth's poses that the estimate is so many metres from at most")
      ->type_name("M");
  AssociationOptions& association = options.association;
  command.add_option("--tolerance", association.tolerance, "Largest difference of the times of a pair in s")
      ->capture_default_str();
  command.add_option("--offset", association.offset, "Seconds to add to the times of the truth")
      ->capture_default_str();
  command.add_flag("--interpolate", association.interpolate,
                   "Interpolate the truth at the estimate's times, for truth slower than the camera");
  command
      .add_option("--rpe-interval", options.rpe_interval, "Seconds over which the relative error is measured")
      ->capture_default_str();
}

}  // namespace

void add_evaluate(CLI::App& app, Command& chosen) {
  CLI::App* command =
      app.add_subcommand("evaluate", "Compare a trajectory with the ground truth: ATE, RPE, KITTI metric");
  const auto arguments = std::make_shared<EvaluateArguments>();
  add_file_options(*command, arguments->files);
  add_metric_options(*command, arguments->options);
  command
      ->add_option(
          "--origin-estimate", arguments->origin_estimate,
          "File of a pose (12 numbers, as in KITTI's): where the estimate's world lies in a world common "
          "to both, for --align none; a simulated run's world_from_first_camera.txt")
      ->type_name("FILE");
  command->add_option("--origin-truth", arguments->origin_truth, "The same for the truth's world")
      ->type_name("FILE");
  auto* map = command
                  ->add_option("--map-estimate", arguments->map.estimate,
                               "Estimated trajectory of the run that made the map in which ESTIMATE was "
                               "localized: lays the map on the world first, for --align none")
                  ->type_name("FILE");
  command->add_option("--map-truth", arguments->map.truth, "Its true trajectory")
      ->type_name("FILE")
      ->needs(map);
  map->needs("--map-truth");
  command
      ->add_flag("--map-nearest", arguments->map_nearest,
                 "Lay the map on the world for each pose anew, by the nearest pose of the run that made it: "
                 "what is measured is localization alone, without the map's own error")
      ->needs(map);
  command->add_flag("--kitti", arguments->kitti, "The KITTI metric of each length too");
  command->add_flag("--json", arguments->json, "Print one JSON object instead of text");
  command->callback([arguments, &chosen] { chosen = [arguments] { return evaluate_files(*arguments); }; });
}

}  // namespace spslam
