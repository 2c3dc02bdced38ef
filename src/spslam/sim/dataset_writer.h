// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Writes a simulated run as a folder of one of the usual layouts, its truth beside it. docs/SIMULATOR.md
// lists the files.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "spslam/io/trajectory.h"
#include "spslam/sim/inertial.h"
#include "spslam/sim/simulator.h"

namespace spslam::sim {

enum class Layout { kKitti, kEuroc, kUsvinland };
std::span<const char* const> option_names(Layout);

struct SimulationRequest {
  SceneDescription scene;
  std::filesystem::path output;
  Layout layout = Layout::kKitti;
  std::uint32_t seed = 1;
  int frames = 0;          // at most so many pairs; 0 = the whole way
  bool overwrite = false;  // replaces what an earlier simulation left in `output`
};

struct SimulationSummary {
  int frames = 0;        // written
  int dropped = 0;       // lost on purpose
  double length = 0;     // m travelled
  double duration = 0;   // s of simulated time
  bool stopped = false;  // by keep_going: the folder holds the marker INCOMPLETE, and the readers refuse it
};

// Called after every pair with the number written and the number wanted; false stops.
using Progress = std::function<bool(int written, int wanted)>;

// Renders and writes. Throws OptionError for a scene that cannot be, OutputError if the folder is not empty
// (and not request.overwrite) or a file cannot be written (a full disk); what is there then holds the marker
// INCOMPLETE.
SimulationSummary simulate_dataset(const SimulationRequest& request, const Progress& keep_going = {});

// What a frame leaves behind for the text files.
struct FrameRecord {
  int index = 0;
  double timestamp = 0;  // s, as written
  SE3 world_from_left;
  double exposure_log2 = 0;
};

// Folders and files of one layout below `folder`.
class LayoutWriter {
 public:
  LayoutWriter(Layout layout, std::filesystem::path folder, const Simulator& simulator);
  void add(const SimulatedFrame& frame);
  // The text files: calibration, times, poses, streams.
  void finish(std::span<const FrameRecord> records, std::span<const ImuSample> imu,
              std::span<const GnssFix> gnss) const;

 private:
  std::string image_name(const SimulatedFrame& frame) const;
  void finish_kitti(std::span<const FrameRecord> records) const;
  void finish_euroc(std::span<const FrameRecord> records, std::span<const ImuSample> imu) const;
  void finish_usvinland(std::span<const FrameRecord> records, std::span<const ImuSample> imu) const;
  void write_truth(const SimulatedFrame& frame) const;

  Layout layout_;
  std::filesystem::path folder_, left_, right_;
  const Simulator& simulator_;
  int written_ = 0;
};

}  // namespace spslam::sim
