// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/map/keyframe_image.h"

#include <opencv2/imgcodecs.hpp>

namespace spslam {

std::shared_ptr<const ImageBytes> compress(const cv::Mat& grey, int quality) {
  auto bytes = std::make_shared<ImageBytes>();
  if (grey.empty() || !cv::imencode(".jpg", grey, *bytes, {cv::IMWRITE_JPEG_QUALITY, quality}))
    return nullptr;
  bytes->shrink_to_fit();
  return bytes;
}

cv::Mat decompress(const ImageBytes& bytes, int width, int height) {
  const bool is_jpeg = bytes.size() > 2 && bytes[0] == 0xFF && bytes[1] == 0xD8;
  if (!is_jpeg) return {};
  try {
    cv::Mat grey = cv::imdecode(bytes, cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION);
    return grey.cols == width && grey.rows == height ? grey : cv::Mat();
  } catch (const cv::Exception&) {
    return {};
  }
}

}  // namespace spslam
