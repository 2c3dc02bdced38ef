// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/stereo/neighbours.h"

#include <algorithm>

namespace spslam {
namespace {
constexpr int kCell = 24;  // px
}  // namespace

Neighbours::Neighbours(std::span<const Keypoint> keypoints, std::span<const StereoMeasurement> measurements,
                       cv::Size size)
    : columns_(size.width / kCell + 1),
      rows_(size.height / kCell + 1),
      cells_(static_cast<std::size_t>(columns_) * rows_) {
  for (std::size_t i = 0; i < keypoints.size(); ++i)
    if (measurements[i].ok()) cells_[cell_of(keypoints[i].x, keypoints[i].y)].push_back(measurements[i]);
}

int Neighbours::cell_of(float x, float y) const {
  const int column = std::clamp(static_cast<int>(x) / kCell, 0, columns_ - 1);
  const int row = std::clamp(static_cast<int>(y) / kCell, 0, rows_ - 1);
  return row * columns_ + column;
}

StereoMeasurement Neighbours::guess(const Keypoint& keypoint) const {
  std::vector<StereoMeasurement> around;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const float x = keypoint.x + static_cast<float>(dx * kCell),
                  y = keypoint.y + static_cast<float>(dy * kCell);
      if (x < 0 || y < 0 || x >= static_cast<float>(columns_ * kCell) ||
          y >= static_cast<float>(rows_ * kCell))
        continue;
      const auto& cell = cells_[cell_of(x, y)];
      around.insert(around.end(), cell.begin(), cell.end());
    }
  }
  if (around.empty()) return {};
  const auto middle = around.begin() + static_cast<std::ptrdiff_t>(around.size() / 2);
  std::nth_element(around.begin(), middle, around.end(),
                   [](const auto& a, const auto& b) { return a.disparity < b.disparity; });
  return *middle;
}

}  // namespace spslam
