// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/alignment/pyramid.h"

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

}  // namespace

AlignmentPyramid::AlignmentPyramid(const cv::Mat& grey, int levels) {
  CV_Assert(grey.type() == CV_8UC1 && !grey.empty());
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
  return out;
}

}  // namespace spslam
