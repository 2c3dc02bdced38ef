// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Line charts as inline SVG: no script, no font, no file beside the page.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace spslam {

struct ChartSeries {
  std::string name;
  std::string css_class;  // gives the line its colour in the page's style sheet
  std::vector<Eigen::Vector2d> points;
  bool has_ends = true;  // marked where scales are equal
};

// A range of x shaded behind the lines, such as frames without tracking.
struct ChartBand {
  double from = 0;
  double to = 0;
  std::string name;
  std::string css_class;
};

struct Chart {
  std::string title;  // what a screen reader says
  std::string x_label;
  std::string y_label;
  std::vector<ChartSeries> series;
  std::vector<ChartBand> bands;
  bool equal_scales =
      false;  // one metre is as long along x as along y (maps); marks start and end of a series that has them
  bool from_zero = true;  // y begins at 0 unless equal_scales
  int width = 720;        // px
  int height = 260;       // px
};

// The chart as one <svg> element with axes, ticks at round values and a legend. Points that are not finite
// break the line. Long series are thinned to what the width can show, keeping the extremes.
std::string svg_chart(const Chart& chart);

// The largest of 1, 2, 5 times a power of ten that cuts the range into at least `count` steps.
double tick_step(double range, int count);

}  // namespace spslam
