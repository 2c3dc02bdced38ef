// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "spslam/segmentation/regions.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "spslam/segmentation/dilation.h"

namespace spslam {
namespace {

struct Component {
  int label = 0, area = 0, top = 0;  // px
  double centre = 0;                 // row of the centroid
};

// The largest components, upper ones first.
std::vector<Component> largest(const cv::Mat& stats, const cv::Mat& centroids, int count,
                               double minimum_area) {
  std::vector<Component> all;
  for (int label = 1; label < stats.rows; ++label) {
    const int area = stats.at<int>(label, cv::CC_STAT_AREA);
    if (area < minimum_area) continue;
    all.push_back({label, area, stats.at<int>(label, cv::CC_STAT_TOP), centroids.at<double>(label, 1)});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Component& a, const Component& b) { return a.area > b.area; });
  if (static_cast<int>(all.size()) > count) all.resize(count);
  std::stable_sort(all.begin(), all.end(),
                   [](const Component& a, const Component& b) { return a.centre < b.centre; });
  return all;
}

// A mirror image begins below the middle of the sky; where no sky is seen, below the middle of the image.
bool is_mirror(const Component& component, const Component& uppermost, int rows) {
  const bool sky_is_seen = uppermost.top < rows / 2;
  return sky_is_seen ? component.label != uppermost.label && component.top > uppermost.centre : true;
}

// 255 where the component belongs to the region.
cv::Mat pixels_of(const cv::Mat& labels, const std::vector<Region>& region_of, Region region) {
  cv::Mat pixels(labels.size(), CV_8UC1);
  for (int y = 0; y < labels.rows; ++y) {
    const int* label = labels.ptr<int>(y);
    std::uint8_t* pixel = pixels.ptr<std::uint8_t>(y);
    for (int x = 0; x < labels.cols; ++x) pixel[x] = region_of[label[x]] == region ? 255 : 0;
  }
  return pixels;
}

}  // namespace

cv::Mat shrink(const cv::Mat& grey, int factor) {
  const cv::Size size(grey.cols / factor, grey.rows / factor);
  if (factor == 1 || size.width < 1 || size.height < 1) return grey;
  cv::Mat small;
  cv::resize(grey, small, size, 0, 0, cv::INTER_AREA);
  return small;
}

Region RegionMap::at(float x, float y) const {
  const int column = cvRound(x), row = cvRound(y);
  if (column < 0 || row < 0 || column >= size.width || row >= size.height) return Region::kNear;
  if (is_inside(far, size, column, row)) return Region::kFar;
  return is_inside(mirror, size, column, row) ? Region::kMirror : Region::kNear;
}

cv::Mat RegionMap::labels() const {
  cv::Mat labels(size, CV_8UC1);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      labels.at<std::uint8_t>(y, x) =
          static_cast<std::uint8_t>(at(static_cast<float>(x), static_cast<float>(y)));
    }
  }
  return labels;
}

cv::Mat RegionMap::mask() const {
  return labels() != static_cast<int>(Region::kNear);
}

RegionMap find_regions(const cv::Mat& grey, double threshold, const SegmentationOptions& options,
                       cv::Size size) {
  // Equation (2): a whole number is above the threshold if it is above its floor.
  const cv::Mat bright = grey > std::floor(threshold);
  cv::Mat labels, stats, centroids;
  cv::connectedComponentsWithStats(bright, labels, stats, centroids, 8, CV_32S);
  const double minimum_area = options.minimum_region * static_cast<double>(grey.total());
  const std::vector<Component> components = largest(stats, centroids, options.regions, minimum_area);

  std::vector<Region> region_of(stats.rows, Region::kNear);
  for (const Component& component : components) {
    region_of[component.label] =
        is_mirror(component, components.front(), grey.rows) ? Region::kMirror : Region::kFar;
  }
  return {size, dilate_region(pixels_of(labels, region_of, Region::kFar), options.element, size.width),
          dilate_region(pixels_of(labels, region_of, Region::kMirror), options.element, size.width)};
}

}  // namespace spslam
