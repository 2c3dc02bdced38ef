// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/io/image.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "spslam/io/image_formats.h"

namespace spslam {
namespace {

using namespace std::string_view_literals;

std::optional<std::vector<char>> read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) return std::nullopt;
  const auto size = static_cast<std::streamoff>(file.tellg());
  if (size < 0) return std::nullopt;
  std::vector<char> bytes(static_cast<std::size_t>(size));
  file.seekg(0);
  file.read(bytes.data(), size);
  if (!file) return std::nullopt;
  return bytes;
}

constexpr std::string_view kJpeg = "\xFF\xD8"sv, kPng = "\x89PNG\r\n\x1A\n"sv;

// A JPEG ends with its end marker; some cameras pad it.
bool has_jpeg_end(std::string_view bytes) {
  constexpr std::size_t kPadding = 4096;
  return bytes.substr(bytes.size() - std::min(bytes.size(), kPadding)).find("\xFF\xD9"sv) != bytes.npos;
}

GreyImage decode_png(std::vector<char>& bytes) {
  if (std::string problem = png_problem({bytes.data(), bytes.size()}); !problem.empty()) return {{}, problem};
  constexpr int kFlags = cv::IMREAD_GRAYSCALE | cv::IMREAD_ANYDEPTH | cv::IMREAD_IGNORE_ORIENTATION;
  cv::Mat pixels = cv::imdecode(cv::Mat(1, static_cast<int>(bytes.size()), CV_8UC1, bytes.data()), kFlags);
  if (pixels.type() != CV_8UC1 && pixels.type() != CV_16UC1) pixels.release();
  return {pixels, pixels.empty() ? "PNG is damaged" : ""};
}

GreyImage decode_image(std::vector<char>& bytes) {
  const std::string_view view(bytes.data(), bytes.size());
  if (view.empty()) return {{}, "file is empty"};
  if (view.starts_with(kPng)) return decode_png(bytes);
  if (!view.starts_with(kJpeg)) return {{}, "file is neither PNG nor JPEG"};
  if (!has_jpeg_end(view)) return {{}, "JPEG is truncated"};
  return decode_jpeg(view);
}

}  // namespace

GreyImage read_grey_raw(const std::filesystem::path& path) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code)) return {{}, "file is missing"};
  std::optional<std::vector<char>> bytes = read_bytes(path);
  if (!bytes) return {{}, "file cannot be read"};
  try {
    return decode_image(*bytes);
  } catch (const cv::Exception&) {  // a header that claims more pixels than OpenCV takes
    return {{}, "file is damaged"};
  }
}

GreyImage read_grey(const std::filesystem::path& path, int bit_depth) {
  GreyImage image = read_grey_raw(path);
  if (image.pixels.depth() == CV_16U)
    image.pixels.convertTo(image.pixels, CV_8U, 255 / (std::ldexp(1.0, std::clamp(bit_depth, 8, 16)) - 1));
  return image;
}

int used_bit_depth(const cv::Mat& image) {
  double largest = 0;
  cv::minMaxLoc(image, nullptr, &largest);
  int depth = 8;
  while (depth < 16 && largest >= std::ldexp(1.0, depth)) depth += 2;
  return depth;
}

}  // namespace spslam
