// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/io/image_formats.h"

#include <csetjmp>
#include <cstdio>  // before jpeglib.h, which uses its types
// jpeglib.h is no C++ header: it must come after what it takes for granted.
#include <jerror.h>
#include <jpeglib.h>

#include "spslam/base/atomic_file.h"
#include "spslam/io/text.h"

namespace spslam {
namespace {

// libjpeg reports through callbacks, of which the one for errors must not return.
struct JpegDecoder {
  JpegDecoder() = default;
  JpegDecoder(const JpegDecoder&) = delete;
  JpegDecoder& operator=(const JpegDecoder&) = delete;
  ~JpegDecoder() { jpeg_destroy_decompress(&codec); }

  jpeg_decompress_struct codec{};
  jpeg_error_mgr errors{};
  std::jmp_buf failed{};
  char message[JMSG_LENGTH_MAX] = "";
};

[[noreturn]] void give_up(j_common_ptr codec) {
  auto* decoder = static_cast<JpegDecoder*>(codec->client_data);
  codec->err->format_message(codec, decoder->message);
  std::longjmp(decoder->failed, 1);
}

// Versions of the file's wrapping, and the few bytes with which many cameras pad the end of their data.
bool is_harmless(const jpeg_error_mgr& errors) {
  constexpr int kPadding = 4;
  if (errors.msg_code == JWRN_EXTRANEOUS_DATA)
    return errors.msg_parm.i[0] <= kPadding && errors.msg_parm.i[1] == JPEG_EOI;
  return errors.msg_code == JWRN_JFIF_MAJOR || errors.msg_code == JWRN_ADOBE_XFORM;
}

void hear(j_common_ptr codec, int level) {
  constexpr int kWarning = -1;  // higher ones are the decoder's progress
  if (level == kWarning && !is_harmless(*codec->err)) give_up(codec);
}

// False if decoder.message says what is wrong. A jump leaves this function, so nothing in it may need a
// destructor.
bool decode(JpegDecoder& decoder, std::string_view bytes, cv::Mat& pixels) {
  jpeg_decompress_struct& codec = decoder.codec;
  codec.err = jpeg_std_error(&decoder.errors);
  decoder.errors.error_exit = give_up;
  decoder.errors.emit_message = hear;
  codec.client_data = &decoder;
  if (setjmp(decoder.failed) != 0) return false;
  jpeg_create_decompress(&codec);  // leaves err and client_data as they are
  jpeg_mem_src(&codec, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  jpeg_read_header(&codec, TRUE);
  constexpr std::uint64_t kMostPixels = 1 << 28;  // a header's claim must not ask for all memory
  if (std::uint64_t{codec.image_width} * codec.image_height > kMostPixels) {
    std::snprintf(decoder.message, sizeof decoder.message, "it claims to be %u x %u px", codec.image_width,
                  codec.image_height);
    return false;
  }
  codec.out_color_space = JCS_GRAYSCALE;
  jpeg_start_decompress(&codec);
  pixels.create(static_cast<int>(codec.output_height), static_cast<int>(codec.output_width), CV_8UC1);
  while (codec.output_scanline < codec.output_height) {
    JSAMPROW row = pixels.ptr<JSAMPLE>(static_cast<int>(codec.output_scanline));
    jpeg_read_scanlines(&codec, &row, 1);
  }
  jpeg_finish_decompress(&codec);
  return true;
}

std::uint32_t big_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (const char c : bytes.substr(0, 4)) value = value << 8 | static_cast<unsigned char>(c);
  return value;
}

}  // namespace

GreyImage decode_jpeg(std::string_view bytes) {
  JpegDecoder decoder;
  cv::Mat pixels;
  if (decode(decoder, bytes, pixels)) return {pixels, ""};
  constexpr std::string_view kSaid = "Corrupt JPEG data: ";
  std::string_view message = decoder.message;
  if (message.starts_with(kSaid)) message.remove_prefix(kSaid.size());
  return {{}, "JPEG is damaged: " + std::string(message)};
}

std::string png_problem(std::string_view bytes) {
  constexpr std::size_t kSignature = 8, kType = 4, kFrame = 12;  // length, type and checksum, 4 bytes each
  bytes.remove_prefix(std::min(kSignature, bytes.size()));
  for (;;) {
    if (bytes.size() < kFrame) return "PNG is truncated";
    const std::size_t length = big_endian(bytes);
    if (length > bytes.size() - kFrame) return "PNG is truncated";
    const std::string_view checked = bytes.substr(4, kType + length), type = checked.substr(0, kType);
    if (crc32(std::as_bytes(std::span(checked))) != big_endian(bytes.substr(4 + checked.size())))
      return "PNG is damaged: checksum of its chunk " + in_quotes(type) + " is wrong";
    if (type == "IEND") return "";
    bytes.remove_prefix(kFrame + length);
  }
}

}  // namespace spslam
