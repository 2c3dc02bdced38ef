// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Mean, maximum, RMSE, standard deviation and median: the columns of the paper's tables (4.3).
#pragma once

#include <cstddef>
#include <vector>

namespace spslam {

// All in the unit of the values. Every figure of an empty list is NaN.
struct Statistics {
  std::size_t count = 0;
  double mean = 0;
  double maximum = 0;
  double rmse = 0;
  double deviation = 0;  // of the population: sqrt(mean((x - mean)^2))
  double median = 0;     // of an even count: halfway between the two in the middle
};

Statistics statistics_of(std::vector<double> values);

}  // namespace spslam
