// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// `spslam export-map`: a saved map as a point cloud that other programs read.

#include <cstdio>
#include <filesystem>
#include <memory>

#include "spslam/base/error.h"
#include "spslam/cli/commands.h"
#include "spslam/io/point_cloud.h"
#include "spslam/io/text.h"
#include "spslam/system/map_file.h"

namespace spslam {
namespace {

namespace fs = std::filesystem;

struct ExportArguments {
  std::string map, output;
  CloudOptions cloud;
};

// river.csv -> river_keyframes.csv
fs::path beside(const fs::path& csv) {
  return csv.parent_path() / (csv.stem().string() + "_keyframes.csv");
}

int export_map(const ExportArguments& arguments) {
  const fs::path output = arguments.output;
  const bool ply = output.extension() == ".ply";
  if (!ply && output.extension() != ".csv")
    throw OptionError("--output " + output.string() + ": the name must end in .ply or .csv");
  const Map map = load_map(arguments.map).map;
  const std::vector<CloudPoint> points = cloud_points(map, arguments.cloud);
  write_text_file(output, ply ? format_ply(points, map) : format_points_csv(points));
  if (!ply) write_text_file(beside(output), format_keyframe_poses_csv(map));
  std::printf("%s: %zu of %zu landmarks, %zu keyframes%s\n", output.c_str(), points.size(),
              map.landmarks().size(), map.keyframes().size(),
              ply ? "" : (" in " + beside(output).string()).c_str());
  return 0;
}

}  // namespace

void add_export_map(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("export-map", "Write a saved map as a point cloud: PLY or CSV");
  const auto arguments = std::make_shared<ExportArguments>();
  command->add_option("MAP", arguments->map, "File that `spslam run --save-map` wrote")->required();
  command
      ->add_option("--output,-o", arguments->output,
                   "FILE.ply: points and the keyframes' way, or FILE.csv: points, and poses in "
                   "FILE_keyframes.csv; world frame, m")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("--max-uncertainty", arguments->cloud.max_uncertainty,
                   "Leave out landmarks whose distance is less certain, as a share of it")
      ->check(above_zero())
      ->capture_default_str();
  command
      ->add_option("--min-observers", arguments->cloud.min_observers,
                   "Leave out landmarks that fewer keyframes saw")
      ->check(CLI::Range(0, 1000000))
      ->capture_default_str();
  command->callback([arguments, &chosen] { chosen = [arguments] { return export_map(*arguments); }; });
}

}  // namespace spslam
