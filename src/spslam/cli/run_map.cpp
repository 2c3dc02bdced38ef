// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/cli/run_map.h"

#include <filesystem>

#include "spslam/base/atomic_file.h"
#include "spslam/base/error.h"
#include "spslam/system/map_file.h"

namespace spslam {

namespace fs = std::filesystem;

Map known_map(const RunArguments& arguments, const StereoRig& rig) {
  if (arguments.load_map.empty()) return {};
  SavedMap saved = load_map(arguments.load_map);
  check_same_rig(saved.rig, rig);
  return std::move(saved.map);
}

namespace {

// The folder of the results, and those above it, are made and tried by the run itself.
bool is_made_by_the_run(const fs::path& map, const fs::path& output) {
  if (!map.has_filename()) return false;
  fs::path folder = fs::absolute(output / "").lexically_normal().parent_path();
  while (folder != map.parent_path() && folder.has_relative_path()) folder = folder.parent_path();
  return folder == map.parent_path();
}

}  // namespace

void check_map_target(const RunArguments& arguments) {
  if (arguments.save_map.empty()) return;
  const fs::path map = fs::absolute(arguments.save_map).lexically_normal();
  std::error_code ignored;
  if (!fs::exists(map.parent_path(), ignored) && is_made_by_the_run(map, arguments.output)) return;
  try {
    check_file_writable(map);
  } catch (const OutputError& error) {
    throw OutputError(std::string("--save-map: ") + error.what());
  }
  if (fs::exists(map, ignored) && !arguments.overwrite)
    throw OutputError(
        "--save-map: " + arguments.save_map +
        " exists; give another file, or --overwrite to replace it (and the results that are in " +
        arguments.output + ")");
}

}  // namespace spslam
