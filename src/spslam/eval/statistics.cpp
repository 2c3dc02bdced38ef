// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/eval/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spslam {

Statistics statistics_of(std::vector<double> values) {
  Statistics s;
  s.count = values.size();
  if (values.empty()) {
    s.mean = s.maximum = s.rmse = s.deviation = s.median = std::numeric_limits<double>::quiet_NaN();
    return s;
  }
  std::sort(values.begin(), values.end());  // small ones first also makes the sums more exact
  const double n = static_cast<double>(values.size());
  double sum = 0, squares = 0, spread = 0;
  for (const double x : values) sum += x, squares += x * x;
  s.mean = sum / n;
  for (const double x : values) spread += (x - s.mean) * (x - s.mean);
  s.maximum = values.back();
  s.rmse = std::sqrt(squares / n);
  s.deviation = std::sqrt(spread / n);
  const std::size_t middle = values.size() / 2;
  s.median = values.size() % 2 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
  return s;
}

}  // namespace spslam
