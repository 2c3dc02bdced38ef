// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The order of a run: folder, marker, frames, texts, marker away.

#include "spslam/sim/dataset_writer.h"

#include "spslam/base/error.h"
#include "spslam/io/dataset.h"
#include "spslam/io/text.h"

namespace spslam::sim {
namespace {

namespace fs = std::filesystem;

// Only what a simulation writes is ever removed, so that --overwrite on the wrong folder does no harm.
constexpr const char* kOwnEntries[] = {"image_0",
                                       "image_1",
                                       "mav0",
                                       "PIC_Left_Rectified",
                                       "PIC_Right_Rectified",
                                       "depth",
                                       "water_mask",
                                       "sky_mask",
                                       "far_mask",
                                       "moving_mask",
                                       "calib.txt",
                                       "calibration.yaml",
                                       "times.txt",
                                       "poses.txt",
                                       "groundtruth_tum.txt",
                                       "Stereo_Timestamp.txt",
                                       "GPSBase.csv",
                                       "IMU.csv",
                                       "imu.csv",
                                       "gnss.csv",
                                       "exposure_log2.txt",
                                       "world_from_first_camera.txt",
                                       "scene.yaml",
                                       "INCOMPLETE"};

void prepare_folder(const fs::path& folder, bool overwrite) {
  std::error_code code;
  if (fs::exists(folder, code) && !fs::is_directory(folder, code))
    throw OutputError(folder.string() + " is a file; give a folder to write the data set to");
  if (fs::is_directory(folder, code) && !fs::is_empty(folder, code)) {
    if (!overwrite)
      throw OutputError(folder.string() +
                        " is not empty; give another folder, or --overwrite to replace the data set in it");
    if (!fs::exists(folder / "scene.yaml", code) && !fs::exists(folder / kIncompleteMarker, code))
      throw OutputError(folder.string() +
                        " holds something that is not a simulated data set; nothing was removed, "
                        "give another folder");
    for (const char* entry : kOwnEntries)
      if (fs::remove_all(folder / entry, code); code)
        throw OutputError("cannot remove " + (folder / entry).string() + ": " + code.message());
  }
  fs::create_directories(folder, code);
  if (code) throw OutputError("cannot make the folder " + folder.string() + ": " + code.message());
}

// The scene with all its options, in YAML that load_scene() reads again.
std::string effective_scene(const SimulationRequest& request) {
  std::string text = "# spslam simulate, seed " + std::to_string(request.seed) + "\n";
  std::vector<std::string> open;
  for (const OptionText& option : list_options(request.scene)) {
    std::vector<std::string> path;
    std::size_t start = 0;
    for (std::size_t dot; (dot = option.key.find('.', start)) != std::string::npos; start = dot + 1)
      path.push_back(option.key.substr(start, dot - start));
    std::size_t same = 0;
    while (same < path.size() && same < open.size() && path[same] == open[same]) ++same;
    for (std::size_t depth = same; depth < path.size(); ++depth)
      text += std::string(2 * depth, ' ') + path[depth] + ":\n";
    open = path;
    const bool words = option.value.find(' ') != std::string::npos;
    text += std::string(2 * path.size(), ' ') + option.key.substr(start) + ": " +
            (words ? "\"" + option.value + "\"" : option.value) + "  # " +
            (option.unit.empty() ? "" : option.unit + "; ") + option.meaning + "\n";
  }
  return text;
}

}  // namespace

std::span<const char* const> option_names(Layout) {
  static constexpr const char* names[] = {"kitti", "euroc", "usvinland"};
  return names;
}

SimulationSummary simulate_dataset(const SimulationRequest& request, const Progress& keep_going) {
  request.scene.check();
  prepare_folder(request.output, request.overwrite);
  const fs::path marker = request.output / kIncompleteMarker;
  write_text_file(marker, "This data set was not written to its end. Simulate it again with --overwrite.\n");
  write_text_file(request.output / "scene.yaml", effective_scene(request));

  Simulator simulator(request.scene, request.seed);
  const int wanted =
      request.frames > 0 ? std::min(request.frames, simulator.frame_count()) : simulator.frame_count();
  SimulationSummary summary;
  std::vector<FrameRecord> records;
  LayoutWriter writer(request.layout, request.output, simulator);
  double until = 0;
  while (summary.frames < wanted) {
    const std::optional<SimulatedFrame> frame = simulator.next();
    if (!frame) break;
    writer.add(*frame);
    records.push_back({frame->index, frame->images.timestamp, frame->world_from_left, frame->exposure_log2});
    until = frame->time;
    ++summary.frames;
    summary.dropped = frame->index + 1 - summary.frames;
    if (keep_going && !keep_going(summary.frames, wanted)) {
      summary.stopped = true;
      return summary;
    }
  }
  const BoatMotion& motion = simulator.motion();
  const std::uint32_t seed = request.scene.passage_seed(request.seed);
  writer.finish(records, simulate_imu(motion, request.scene.imu, until, seed),
                simulate_gnss(motion, request.scene.gnss, until, seed));
  summary.length = motion.travelled(until);
  summary.duration = until;
  std::error_code code;
  fs::remove(marker, code);
  if (code) throw OutputError("cannot remove " + marker.string() + ": " + code.message());
  return summary;
}

}  // namespace spslam::sim
