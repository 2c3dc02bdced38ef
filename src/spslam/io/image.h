// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// One image file to one grey 8 bit image. A bad file is a text that says why, never an exception: it is one
// bad frame.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>

namespace spslam {

struct GreyImage {
  cv::Mat pixels;       // CV_8UC1, or CV_16UC1 from read_grey_raw; empty if there is a problem
  std::string problem;  // "file is missing", "JPEG is truncated", ...; empty for a good image
};

// PNG or JPEG (told from the content), grey or colour. The file's orientation tag is ignored: calibrations
// are of the pixels as they lie. A file that stops early is a problem, though decoders would fill the rest
// with grey.
GreyImage read_grey_raw(const std::filesystem::path& path);

// As above, 16 bit scaled to 8 so that the largest value of bit_depth bits is white (larger ones saturate).
// bit_depth (8 to 16) is the sensor's, the same for a whole sequence.
GreyImage read_grey(const std::filesystem::path& path, int bit_depth = 16);

// The smallest of 8, 10, 12, 14, 16 bits that holds the image's largest value.
int used_bit_depth(const cv::Mat& image);

}  // namespace spslam
