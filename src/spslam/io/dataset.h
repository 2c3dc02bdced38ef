// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// A recorded sequence: rectified grey pairs with their times, the rig, and the ground truth if there is one.
//
//   const std::unique_ptr<Dataset> dataset = open_dataset("kitti/sequences/06");
//   for (Prefetcher frames(*dataset); const auto frame = frames.next();) slam.track(frame->pair);
//
// Formats (docs of each at its reader, *_dataset.cpp):
//   kitti      image_0/, image_1/ (or, without them, image_2/, image_3/), calib.txt, times.txt;
//              truth in poses.txt or ../../poses/NN.txt
//   kitti-raw  image_00/, image_01/ (or image_02/, image_03/), each with data/ and timestamps.txt;
//              calib_cam_to_cam.txt here or in the folder above
//   euroc      mav0/cam0|cam1/{data.csv, data/, sensor.yaml}; rectified on loading;
//              truth in mav0/state_groundtruth_estimate0/data.csv
//   usvinland  PIC_Left_Rectified/, PIC_Right_Rectified/ (or PIC_Left/, PIC_Right/ with a raw calibration),
//              Stereo_Timestamp.txt, calibration.yaml; truth in GPSBase.csv (planar)
//   plain      left/, right/, calibration.yaml, times.txt or a rate;
//              truth in poses.txt (KITTI) or groundtruth.txt (TUM)
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "spslam/base/options.h"
#include "spslam/camera/stereo_frame.h"
#include "spslam/camera/stereo_rig.h"
#include "spslam/io/trajectory.h"

namespace spslam {

enum class DatasetFormat { kAuto, kKitti, kKittiRaw, kEuroc, kUsvinland, kPlain };
std::span<const char* const> option_names(DatasetFormat);

// Messages call them by their names on the command line: --format, --pair-tolerance, ...
struct DatasetOptions {
  DatasetFormat format = DatasetFormat::kAuto;
  std::string calibration;
  double rate = 0;
  double pair_tolerance = 0.003;  // a third of the frame time of a 100 Hz camera
  int bit_depth = 0;
  std::string truth;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.format, {"format", "",
                        "format of the folder: auto (default), kitti, kitti-raw, euroc, usvinland or plain"});
    visit(self.calibration,
          {"calibration", "",
           "calibration file instead of the folder's own: YAML, or KITTI's if it ends in .txt"});
    visit(self.rate,
          {"rate", "Hz", "frames per second instead of the folder's times; 0: its times", 0, 1000});
    visit(self.pair_tolerance,
          {"pair_tolerance", "s", "largest time between left and right of a pair in EuRoC's folders", 0, 1});
    visit(self.bit_depth,
          {"bit_depth", "bit", "used bits of 16 bit images, all above is white; 0: measured", 0, 16});
    visit(self.truth, {"truth", "",
                       "true trajectory instead of the folder's own: TUM's, KITTI's (a row a frame), EuRoC's "
                       "or USVInland's"});
  }
};

class Dataset {
 public:
  virtual ~Dataset() = default;

  virtual const StereoRig& rig() const = 0;
  virtual int size() const = 0;                   // frames, unusable ones counted
  virtual double timestamp(int index) const = 0;  // s, strictly increasing
  // The frame, rectified. An unusable image is no error: the frame then has its time and a `problem`, and no
  // images. May be called from several threads. Throws InputError if there is no such frame.
  virtual StereoFrame load(int index) const = 0;
  // Of the left camera (of its rectified axes); in the format's own world frame and, mostly, not at the
  // frames' times.
  virtual const std::optional<Trajectory>& ground_truth() const = 0;
  virtual bool planar_ground_truth() const = 0;  // two dimensions and a heading only (GNSS of a boat)
  virtual int unpaired() const = 0;             // images left out because the other eye has none of that time
  virtual std::string description() const = 0;  // one line for people
  // What does not look right but may be so, a sentence each; whoever opens a data set for people logs them.
  virtual const std::vector<std::string>& warnings() const = 0;
};

// Opens a folder and checks at once whatever is cheap to check: that the images of both eyes and the times
// agree in number, that times increase, that the calibration is there and of the images' size. Throws
// InputError (or OptionError) that says what to do.
std::unique_ptr<Dataset> open_dataset(const std::filesystem::path& folder,
                                      const DatasetOptions& options = {});

// The folder's format; InputError that lists what each needs if none fits, or several do.
DatasetFormat recognise_dataset(const std::filesystem::path& folder);

// A folder being written holds a file of this name until it is whole; open_dataset refuses it.
inline constexpr const char* kIncompleteMarker = "INCOMPLETE";

}  // namespace spslam
