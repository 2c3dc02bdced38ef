// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// What stereo says of one left keypoint.
#pragma once

#include <cstdint>

namespace spslam {

enum class StereoStatus : std::uint8_t {
  kNone,          // no right keypoint looks like it
  kOk,            // measured
  kAmbiguous,     // a second place along the row looks as good
  kLeftRight,     // the way back from the right image ends elsewhere
  kOutside,       // its block leaves one of the images
  kWindowEdge,    // the best block lies on the edge of the search window: the minimum is outside
  kNotConvex,     // no minimum: flat, or an edge along the row
  kBlockOutlier,  // its SAD stands out of the frame's
  kOutOfRange,    // disparity or row offset beyond the limits
  kNotAligned,    // gradient alignment did not converge or disagrees
};

// Names for logs and tables, in the order of the values.
inline const char* to_string(StereoStatus status) {
  constexpr const char* kNames[] = {"none",         "ok",          "ambiguous",  "left-right",
                                    "outside",      "window edge", "not convex", "block outlier",
                                    "out of range", "not aligned"};
  return kNames[static_cast<int>(status)];
}

struct StereoMeasurement {
  float disparity = 0;   // px at full size, left x minus right x; SIGNED: noise about zero is kept, never cut
  float sigma = 0;       // px, standard deviation of the disparity; valid if ok
  float row_offset = 0;  // px at full size, right y minus left y; 0 for a perfect rig
  StereoStatus status = StereoStatus::kNone;

  bool ok() const { return status == StereoStatus::kOk; }
};

}  // namespace spslam
