// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// One run as one self-contained page: its way against the truth, its errors, what it saw, how long it took.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "spslam/eval/evaluation.h"

namespace spslam {

// Features of one frame by label, and the tracker's state.
struct ReportFrame {
  double timestamp = 0;  // s
  std::string state;     // "tracking"; any other is shaded in the chart
  double near = 0;       // features labelled near; NaN: not known
  double far = 0;
  bool keyframe = false;
};

// A row of the timing table, in ms a frame.
struct ReportStage {
  std::string name;
  double mean = 0, p50 = 0, p95 = 0, maximum = 0;
};

// A sample frame with its near (green) and far (red) features drawn on it.
struct ReportImage {
  std::string caption;
  std::string png;  // the bytes of the file
};

// Whatever is empty is left out of the page.
struct ReportInput {
  std::string title;
  std::vector<std::pair<std::string, std::string>>
      facts;  // name and value: dataset, preset, peak memory, ...
  Trajectory estimate;
  std::optional<Evaluation>
      evaluation;  // with ground truth; its poses may be missing, and are not drawn then
  std::vector<ReportFrame> frames;
  std::vector<ReportStage> timing;
  std::vector<ReportImage> images;
  std::string config;              // the effective options as text
  std::vector<std::string> notes;  // what is missing in the page, and why
};

// A complete HTML document: no script, nothing loaded from elsewhere, readable in light and dark.
std::string html_report(const ReportInput& input);

}  // namespace spslam
