// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "spslam/segmentation/threshold.h"

#include <cmath>

namespace spslam {

Histogram histogram(const cv::Mat& grey) {
  CV_Assert(grey.type() == CV_8UC1 && !grey.empty());
  // Two counters, so that runs of one value need not wait for each other.
  std::array<int, 256> even{}, odd{};
  for (int y = 0; y < grey.rows; ++y) {
    const std::uint8_t* row = grey.ptr<std::uint8_t>(y);
    int x = 0;
    for (; x + 1 < grey.cols; x += 2) ++even[row[x]], ++odd[row[x + 1]];
    if (x < grey.cols) ++even[row[x]];
  }
  Histogram shares;
  for (int i = 0; i < 256; ++i) shares[i] = (even[i] + odd[i]) / static_cast<double>(grey.total());
  return shares;
}

Split split_at(const Histogram& histogram, double threshold) {
  Split split;
  split.threshold = threshold;
  double dark_sum = 0, sum = 0, squares = 0;
  for (int i = 0; i < 256; ++i) {
    sum += histogram[i] * i;
    squares += histogram[i] * i * i;
    if (i > threshold) continue;
    split.dark_share += histogram[i];
    dark_sum += histogram[i] * i;
  }
  split.bright_share = 1 - split.dark_share;
  constexpr double kNone = 1e-9;
  split.dark_mean = split.dark_share > kNone ? dark_sum / split.dark_share : sum;
  split.bright_mean = split.bright_share > kNone ? (sum - dark_sum) / split.bright_share : sum;
  split.between = split.dark_share * std::pow(split.dark_mean - sum, 2) +
                  split.bright_share * std::pow(split.bright_mean - sum, 2);
  const double total = squares - sum * sum;
  split.bimodality = total > kNone ? split.between / total : 0;
  return split;
}

Split otsu(const Histogram& histogram) {
  double mean = 0;
  for (int i = 0; i < 256; ++i) mean += histogram[i] * i;
  double share = 0, sum = 0, best = -1;
  int threshold = 0;
  for (int i = 0; i < 255; ++i) {
    share += histogram[i];
    sum += histogram[i] * i;
    const double spread = share * (1 - share);
    const double between = spread > 1e-12 ? std::pow(mean * share - sum, 2) / spread : 0;
    if (between > best * (1 + 1e-12)) best = between, threshold = i;
  }
  return split_at(histogram, threshold);
}

Split refine_threshold(const Histogram& histogram, const Split& first) {
  constexpr int kMostSteps = 50;
  Split split = first;
  for (int i = 0; i < kMostSteps; ++i) {
    const double middle = (split.dark_mean + split.bright_mean) / 2;
    if (std::abs(middle - split.threshold) < 0.01) break;
    split = split_at(histogram, middle);
  }
  return split;
}

}  // namespace spslam
