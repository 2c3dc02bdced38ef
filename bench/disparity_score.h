// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Statistics of disparity errors by band of true disparity, for bench/disparity.cpp.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace spslam::bench {

inline constexpr std::array<double, 7> kBandLimits = {0, 0.5, 1, 2, 4, 8, 1e9};  // px of true disparity

struct Error {
  float truth = 0, error = 0, sigma = 0;  // px
};

// All errors of one method on points of one kind (smooth or at a depth edge).
struct Score {
  std::vector<Error> errors;
  std::array<int, kBandLimits.size() - 1> points{};  // with known truth, measured or not
};

int band_of(float disparity);
double median(std::vector<double> values);

// Markdown rows, one a band: points, share measured, bias (median and mean of errors within 1 px), spread,
// outliers, spread of error over sigma.
std::string table_head();
std::string table_rows(const std::string& method, const Score& score);

}  // namespace spslam::bench
