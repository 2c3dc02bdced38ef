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

void check_map_target(const RunArguments& arguments) {
  if (arguments.save_map.empty()) return;
  const fs::path map = fs::absolute(arguments.save_map).lexically_normal();
  std::error_code ignored;
  // The folder of the results is made, and tried, by the run itself.
  const fs::path results = fs::absolute(fs::path(arguments.output) / "").lexically_normal();
  if (!fs::exists(results, ignored) && map.has_filename() && map.parent_path() == results.parent_path())
    return;
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
