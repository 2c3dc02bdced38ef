// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Feeds bytes to the parser SPSLAM_PARSE (set by CMakeLists.txt). An InputError is an answer; anything else
// ends the fuzzer.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "spslam/base/error.h"
#include "spslam/io/calibration.h"
#include "spslam/io/euroc.h"
#include "spslam/io/text.h"
#include "spslam/io/trajectory.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    (void)spslam::SPSLAM_PARSE(text, "fuzz");
  } catch (const spslam::InputError&) {
  }
  return 0;
}
