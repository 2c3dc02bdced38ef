// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "disparity_score.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spslam::bench {
namespace {

double spread(const std::vector<double>& values) {
  const double middle = median(values);
  std::vector<double> away;
  for (const double x : values) away.push_back(std::abs(x - middle));
  return 1.4826 * median(away);
}

std::string row(const std::string& method, const std::string& band, int points,
                const std::vector<Error>& errors) {
  std::vector<double> error, normalized;
  double sum = 0;
  int inside = 0;
  for (const Error& e : errors) {
    error.push_back(e.error), normalized.push_back(e.error / e.sigma);
    if (std::abs(e.error) <= 1) sum += e.error, ++inside;
  }
  const double n = std::max<double>(1, static_cast<double>(errors.size()));
  return fmt::format("| {} | {} | {} | {:.0f} | {:+.3f} | {:+.3f} | {:.3f} | {:.1f} | {:.2f} |\n", method,
                     band, points, 100.0 * static_cast<double>(errors.size()) / std::max(1, points),
                     median(error), sum / std::max(1, inside), spread(error), 100.0 * (n - inside) / n,
                     spread(normalized));
}

}  // namespace

int band_of(float disparity) {
  int band = 0;
  while (disparity >= kBandLimits[band + 1]) ++band;
  return band;
}

double median(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::string table_head() {
  return "| method | true disparity px | points | measured % | bias: median px | mean (within 1 px) | spread "
         "px | "
         "outliers > 1 px % | spread of error / sigma |\n|---|---|---|---|---|---|---|---|---|\n";
}

std::string table_rows(const std::string& method, const Score& score) {
  std::string text;
  int all_points = 0;
  for (int band = 0; band < static_cast<int>(score.points.size()); ++band) {
    std::vector<Error> errors;
    for (const Error& e : score.errors)
      if (band_of(e.truth) == band) errors.push_back(e);
    const bool last = band + 1 == static_cast<int>(score.points.size());
    const std::string name = last ? fmt::format("{}+", kBandLimits[band])
                                  : fmt::format("{}-{}", kBandLimits[band], kBandLimits[band + 1]);
    text += row(method, name, score.points[band], errors);
    all_points += score.points[band];
  }
  return text + row(method, "all", all_points, score.errors);
}

}  // namespace spslam::bench
