// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/io/image_formats.h"

#include <gmock/gmock.h>

#include "io/synthetic_folder.h"

namespace spslam {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kEnd = "\xFF\xD9";

// Smooth, so that it is compressed as photographs are, with colours of its own everywhere.
cv::Mat colour_image(int width, int height) {
  cv::Mat image(height, width, CV_8UC3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.at<cv::Vec3b>(y, x) = cv::Vec3b(
          static_cast<std::uint8_t>(3 * x + y), static_cast<std::uint8_t>(128 + 90 * std::sin(0.2 * y)),
          static_cast<std::uint8_t>(128 + 90 * std::sin(0.15 * x + 0.1 * y)));
  return image;
}

std::string encoded(const cv::Mat& image, const char* extension, const std::vector<int>& parameters = {}) {
  std::vector<unsigned char> bytes;
  cv::imencode(extension, image, bytes, parameters);
  return {bytes.begin(), bytes.end()};
}

std::string jpeg() {
  return encoded(colour_image(160, 120), ".jpg");
}

// What read_grey makes of these bytes. Whatever is wrong with them, nothing goes to the terminal.
GreyImage read(const std::string& bytes) {
  const TemporaryFolder folder;
  testing::internal::CaptureStderr();
  GreyImage image = read_grey(folder.write("image", bytes));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(image.problem.empty(), !image.pixels.empty()) << image.problem;
  return image;
}

// The pixels of a good file are those that OpenCV's decoder gives, to the bit.
TEST(ImageFormats, JpegIsDecodedAsOpencvDoes) {
  const std::vector<int> ways[] = {{},
                                   {cv::IMWRITE_JPEG_QUALITY, 50},
                                   {cv::IMWRITE_JPEG_QUALITY, 100},
                                   {cv::IMWRITE_JPEG_PROGRESSIVE, 1},
                                   {cv::IMWRITE_JPEG_OPTIMIZE, 1, cv::IMWRITE_JPEG_RST_INTERVAL, 3}};
  for (const cv::Size size : {cv::Size(160, 120), cv::Size(61, 47), cv::Size(1, 1)})
    for (const std::vector<int>& way : ways)
      for (const bool colour : {false, true}) {
        const cv::Mat image =
            colour ? colour_image(size.width, size.height) : noise_image(3, size.width, size.height);
        const std::string bytes = encoded(image, ".jpg", way);
        const cv::Mat expected =
            cv::imdecode(std::vector<char>(bytes.begin(), bytes.end()), cv::IMREAD_GRAYSCALE);
        const GreyImage decoded = read(bytes);
        EXPECT_EQ(decoded.problem, "");
        EXPECT_TRUE(same_pixels(decoded.pixels, expected)) << size << (colour ? " colour" : " grey");
      }
}

TEST(ImageFormats, JpegThatStopsBeforeItsEndMarker) {
  const std::string bytes = jpeg();
  for (const double share : {0.3, 0.6, 0.95}) {
    const std::string part =
        bytes.substr(0, static_cast<std::size_t>(share * static_cast<double>(bytes.size())));
    EXPECT_EQ(read(part).problem, "JPEG is truncated");
    EXPECT_EQ(read(part + kEnd).problem, "JPEG is damaged: premature end of data segment");
  }
}

TEST(ImageFormats, JpegWithRandomBytesInTheMiddle) {
  const std::string bytes = jpeg();
  Random random(4);
  int found = 0;
  for (int i = 0; i < 100; ++i) {
    std::string damaged = bytes;
    const std::size_t begin = bytes.size() / 2 - 32 + random.below(64);
    for (std::size_t at = begin; at < begin + 64; ++at) damaged[at] = static_cast<char>(random.below(256));
    found += read(damaged).problem.starts_with("JPEG is damaged: ");
  }
  EXPECT_GT(found, 80) << "some streams go on as if nothing had been; no decoder can tell";
}

TEST(ImageFormats, JpegHeaderThatIsDamaged) {
  const std::string bytes = jpeg();
  for (std::size_t at = 2; at < 700; ++at) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0xFF);
    read(damaged);  // whatever comes of it, it is said in `problem`
  }
  std::string huge = bytes;
  const std::size_t frame = huge.find("\xFF\xC0");
  huge.replace(frame + 5, 4, "\x9C\x40\x9C\x40");
  EXPECT_EQ(read(huge).problem, "JPEG is damaged: it claims to be 40000 x 40000 px");
}

// Many cameras do so.
TEST(ImageFormats, JpegPaddedBeforeOrBehindItsEndMarkerIsWhole) {
  const std::string bytes = jpeg(), data = bytes.substr(0, bytes.size() - 2);
  EXPECT_EQ(read(data + std::string(2, '\0') + kEnd).problem, "");
  EXPECT_EQ(read(bytes + std::string(1000, '\0')).problem, "");
  EXPECT_THAT(read(data + std::string(200, '\0') + kEnd).problem,
              HasSubstr("extraneous bytes before marker"));
}

TEST(ImageFormats, PngWithAWrongBit) {
  const std::string bytes = encoded(colour_image(160, 120), ".png");
  EXPECT_EQ(read(bytes).problem, "");
  EXPECT_EQ(png_problem(bytes), "");
  for (const std::size_t at : {bytes.size() / 3, bytes.size() / 2, bytes.size() - 20}) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 4);
    EXPECT_THAT(read(damaged).problem,
                AllOf(HasSubstr("PNG is damaged"), HasSubstr("checksum"), HasSubstr("'IDAT'")));
  }
}

TEST(ImageFormats, PngThatStopsEarly) {
  const std::string bytes = encoded(colour_image(160, 120), ".png");
  for (std::size_t size = 8; size < bytes.size(); size += 7)
    EXPECT_EQ(read(bytes.substr(0, size)).problem, "PNG is truncated") << size;
  EXPECT_EQ(read(bytes + "IEND and more").problem, "");
}

}  // namespace
}  // namespace spslam
