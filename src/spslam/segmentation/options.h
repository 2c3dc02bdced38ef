// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// What can be set about the distance segmentation (paper 3.1.2 and 4.1).
#pragma once

#include <span>

#include "spslam/base/options.h"

namespace spslam {

// What the far regions are dilated with; the paper's Figure 9 compares the three.
enum class StructuringElement { kDisc25, kDisc15, kRect25x15 };
inline std::span<const char* const> option_names(StructuringElement) {
  static constexpr const char* kNames[] = {"disc25", "disc15", "rect25x15"};
  return kNames;
}

struct SegmentationOptions {
  // Is there a far region?
  double minimum_bimodality = 0.64;
  double minimum_contrast = 25;
  double minimum_share = 0.03;
  // threshold over time
  int window = 10;
  double rate_limit = 4;
  double share_jump = 0.2;
  int hold_frames = 10;
  // regions
  int regions = 2;
  double minimum_region = 0.005;
  StructuringElement element = StructuringElement::kDisc25;
  int downscale = 4;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.minimum_bimodality,
          {"minimum_bimodality", "",
           "between-class over total variance below which all is near; one Gaussian has 2/pi = 0.637", 0, 1});
    visit(self.minimum_contrast, {"minimum_contrast", "grey",
                                  "difference of the two classes' means below which all is near", 0, 255});
    visit(self.minimum_share,
          {"minimum_share", "", "share of the pixels that each class must have, else all is near", 0, 0.5});
    visit(self.window,
          {"window", "frames", "past frames whose histograms are averaged, the present included", 1, 1000});
    visit(self.rate_limit,
          {"rate_limit", "grey", "largest change of the threshold from frame to frame", 0.1, 255});
    visit(self.share_jump,
          {"share_jump", "",
           "change of the bright share at which a frame is taken for overexposed and keeps the last mask",
           0.01, 1});
    visit(self.hold_frames,
          {"hold_frames", "frames", "for so long the last mask is kept; 0 for never", 0, 1000});
    visit(self.regions, {"regions", "", "largest connected bright regions that are kept", 1, 16});
    visit(self.minimum_region,
          {"minimum_region", "", "share of the image below which a bright region is ignored", 0, 1});
    visit(self.element,
          {"element", "", "structuring element of the dilation, its size in px of a 640 px wide image"});
    visit(self.downscale,
          {"downscale", "", "the regions are found in an image smaller by this factor; 1 for every pixel", 1,
           16});
  }
};

}  // namespace spslam
