// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/io/dataset.h"

#include "spslam/base/error.h"
#include "spslam/io/image_sequence.h"

namespace spslam {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNeeds =
    "\n  kitti: image_0/, image_1/ (or image_2/, image_3/), calib.txt, times.txt"
    "\n  kitti-raw: image_00/, image_01/ (or image_02/, image_03/), each with data/, timestamps.txt; "
    "calib_cam_to_cam.txt here or in the folder above"
    "\n  euroc: mav0/cam0/ and mav0/cam1/, each with data/, data.csv, sensor.yaml"
    "\n  usvinland: PIC_Left_Rectified/, PIC_Right_Rectified/, Stereo_Timestamp.txt, calibration.yaml"
    "\n  plain: left/, right/, calibration.yaml, times.txt (or a rate)";

void require_whole_folder(const fs::path& folder) {
  std::error_code code;
  if (!fs::exists(folder, code)) throw InputError(folder.string() + " does not exist; check the path");
  if (!fs::is_directory(folder, code))
    throw InputError(folder.string() + " is a file; give the folder of a sequence");
  if (fs::exists(folder / kIncompleteMarker, code))
    throw InputError(folder.string() + " was only half written (it holds " + kIncompleteMarker +
                     "); write it again, with the same command");
}

}  // namespace

std::span<const char* const> option_names(DatasetFormat) {
  static constexpr const char* names[] = {"auto", "kitti", "kitti-raw", "euroc", "usvinland", "plain"};
  return names;
}

DatasetFormat recognise_dataset(const fs::path& folder) {
  const auto any_of = [&](std::initializer_list<const char*> names) {
    for (const char* name : names)
      if (fs::exists(folder / name)) return true;
    return false;
  };
  std::vector<DatasetFormat> fitting;
  if (any_of({"image_0", "image_1", "image_2", "image_3"})) fitting.push_back(DatasetFormat::kKitti);
  if (any_of({"image_00", "image_01", "image_02", "image_03"})) fitting.push_back(DatasetFormat::kKittiRaw);
  if (any_of({"mav0", "cam0/data.csv"})) fitting.push_back(DatasetFormat::kEuroc);
  if (any_of({"PIC_Left", "PIC_Left_Rectified"})) fitting.push_back(DatasetFormat::kUsvinland);
  if (any_of({"left", "right"})) fitting.push_back(DatasetFormat::kPlain);
  if (fitting.size() == 1) return fitting.front();
  if (fitting.empty())
    throw InputError(folder.string() +
                     " is no sequence that is known; the formats and what each needs:" + kNeeds);
  throw InputError(folder.string() + " fits several formats; say which with --format:" + kNeeds);
}

std::unique_ptr<Dataset> open_dataset(const fs::path& folder, const DatasetOptions& options) {
  check_options(options);
  require_whole_folder(folder);
  const auto sequence = [&]() -> ImageSequence {
    switch (options.format == DatasetFormat::kAuto ? recognise_dataset(folder) : options.format) {
      case DatasetFormat::kKittiRaw:
        return find_kitti_raw(folder, options);
      case DatasetFormat::kEuroc:
        return find_euroc(folder, options);
      case DatasetFormat::kUsvinland:
        return find_usvinland(folder, options);
      case DatasetFormat::kPlain:
        return find_plain(folder, options);
      case DatasetFormat::kKitti:
      case DatasetFormat::kAuto:
        break;
    }
    return find_kitti(folder, options);
  };
  try {
    return make_image_dataset(sequence(), options);
  } catch (const fs::filesystem_error& error) {
    throw InputError(std::string(error.what()) + "; check that the folder can be read");
  }
}

}  // namespace spslam
