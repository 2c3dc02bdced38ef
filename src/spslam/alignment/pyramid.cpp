// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/alignment/pyramid.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace spslam {
namespace {

constexpr int kSmallestSide = 24;  // px; a patch and the way it may move

// Room for the level and its border in one allocation; the view is the inside.
cv::Mat bordered_view(cv::Size size) {
  constexpr int b = AlignmentPyramid::kBorder;
  const cv::Mat whole(size.height + 2 * b, size.width + 2 * b, CV_8UC1);
  return whole(cv::Rect(b, b, size.width, size.height));
}

void fill_border(cv::Mat& view) {
  constexpr int b = AlignmentPyramid::kBorder;
  cv::Mat whole = view;
  whole.adjustROI(b, b, b, b);
  cv::copyMakeBorder(view, whole, b, b, b, b, cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
}

constexpr int kNoiseBlock = 32, kNoiseRowStep = 2;  // px

struct Roughness {
  int second_differences = 0;  // sum of magnitudes
  int saturated = 0;           // pixels, white or black: what noise they have cannot be seen
};

Roughness roughness(const cv::Mat& grey, int left, int top) {
  Roughness out;
  for (int y = top; y < top + kNoiseBlock; y += kNoiseRowStep) {
    const unsigned char* above = grey.ptr(y - 1);
    const unsigned char* here = grey.ptr(y);
    const unsigned char* below = grey.ptr(y + 1);
    for (int x = left; x < left + kNoiseBlock; ++x) {
      out.second_differences +=
          std::abs(above[x - 1] - 2 * above[x] + above[x + 1] - 2 * here[x - 1] + 4 * here[x] -
                   2 * here[x + 1] + below[x - 1] - 2 * below[x] + below[x + 1]);
      out.saturated += here[x] == 0 || here[x] == 255;
    }
  }
  return out;
}

float noise_of(const cv::Mat& grey) {
  constexpr int kPixels = kNoiseBlock * kNoiseBlock / kNoiseRowStep;
  constexpr double kSmoothest = 0.1;     // quantile of the blocks
  constexpr double kMaxSaturated = 0.1;  // of a block
  std::vector<float> blocks;
  for (int top = 1; top + kNoiseBlock < grey.rows; top += kNoiseBlock)
    for (int left = 1; left + kNoiseBlock < grey.cols; left += kNoiseBlock) {
      const Roughness block = roughness(grey, left, top);
      if (block.saturated > kMaxSaturated * kPixels) continue;
      // The filter makes six times as much of Gaussian noise, and its mean magnitude is sqrt(2/pi) of that.
      blocks.push_back(std::sqrt(static_cast<float>(M_PI) / 2) *
                       static_cast<float>(block.second_differences) / (6 * kPixels));
    }
  if (blocks.empty()) return 0;
  const auto chosen =
      blocks.begin() + static_cast<std::ptrdiff_t>(kSmoothest * static_cast<double>(blocks.size()));
  std::nth_element(blocks.begin(), chosen, blocks.end());
  return *chosen;
}

}  // namespace

AlignmentPyramid::AlignmentPyramid(const cv::Mat& grey, int levels, bool measure_noise) {
  CV_Assert(grey.type() == CV_8UC1 && !grey.empty());
  if (measure_noise) noise_ = noise_of(grey);
  cv::Size size = grey.size();
  for (int i = 0; i < levels && (i == 0 || std::min(size.width, size.height) >= kSmallestSide); ++i) {
    cv::Mat view = bordered_view(size);
    if (i == 0)
      grey.copyTo(view);
    else
      cv::pyrDown(levels_.back(), view, size);
    fill_border(view);
    levels_.push_back(view);
    size = cv::Size((size.width + 1) / 2, (size.height + 1) / 2);
  }
}

AlignmentPyramid AlignmentPyramid::softened(double sigma) const {
  AlignmentPyramid out = *this;
  cv::Mat view = bordered_view(levels_.front().size());
  cv::GaussianBlur(levels_.front(), view, {}, sigma, sigma, cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
  fill_border(view);
  out.levels_.front() = view;
  if (noise_ > 0) out.noise_ = noise_of(view);
  return out;
}

}  // namespace spslam
