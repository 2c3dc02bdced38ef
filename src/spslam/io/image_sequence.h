// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// What a format's reader finds in a folder of images; from there on all formats are one Dataset. For io/
// only.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "spslam/io/calibration.h"
#include "spslam/io/dataset.h"
#include "spslam/io/trajectory.h"

namespace spslam {

struct ImageSequence {
  ImageSequence(DatasetFormat its_format, std::filesystem::path its_folder)
      : format(its_format), folder(std::move(its_folder)) {}

  DatasetFormat format;
  std::filesystem::path folder;
  std::vector<double> times;                       // s
  std::vector<std::filesystem::path> left, right;  // as many as times; some files may be missing
  StereoCalibration calibration;
  std::filesystem::path calibration_file;  // for messages
  std::optional<Trajectory> ground_truth;  // of the left camera as calibrated, before rectification
  SE3 truth_body_from_left;                // where the left camera is on what KITTI's and EuRoC's truth is of
  bool planar_ground_truth = false;
  int unpaired = 0;
  std::vector<std::string> warnings;  // one sentence each
};

// One reader a format. Each throws InputError if the folder lacks what it needs.
ImageSequence find_kitti(const std::filesystem::path& folder, const DatasetOptions& options);
ImageSequence find_kitti_raw(const std::filesystem::path& folder, const DatasetOptions& options);
ImageSequence find_euroc(const std::filesystem::path& folder, const DatasetOptions& options);
ImageSequence find_usvinland(const std::filesystem::path& folder, const DatasetOptions& options);
ImageSequence find_plain(const std::filesystem::path& folder, const DatasetOptions& options);

// Fills times, left and right from two folders of images whose names correspond (image_names.h). A hole in
// the middle of one eye is a frame with a missing file; an eye that ends early, or another number of times
// than of frames, is an InputError.
void find_frames(ImageSequence& sequence, const std::filesystem::path& left,
                 const std::filesystem::path& right, const std::filesystem::path& times,
                 const DatasetOptions& options);

// Fills calibration from options.calibration or, without it, the first of the folder's files that exists.
void find_calibration(ImageSequence& sequence, std::span<const std::filesystem::path> candidates,
                      const DatasetOptions& options, KittiPair pair = KittiPair::kGrey);

// Where a folder may have its truth.
struct TruthFile {
  std::filesystem::path path;
  TrajectoryFormat format;
};

// Fills ground_truth, once there are times, from options.truth or, without it, the first of the folder's
// files that exists. A run needs no truth, so whatever is wrong with the folder's own is a warning; what is
// wrong with one that was asked for is an InputError.
void find_truth(ImageSequence& sequence, std::span<const TruthFile> candidates,
                const DatasetOptions& options);

// Checks calibration and first images against each other.
std::unique_ptr<Dataset> make_image_dataset(ImageSequence sequence, const DatasetOptions& options);

}  // namespace spslam
