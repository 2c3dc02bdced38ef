// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// JPEG and PNG files so that damage is found: general decoders fill in what they cannot read, and only tell
// the terminal. For io/ only.
#pragma once

#include <string_view>

#include "spslam/io/image.h"

namespace spslam {

// Decodes to grey. Whatever libjpeg warns of is a problem, as the pixels behind it are made up.
GreyImage decode_jpeg(std::string_view bytes);

// Why a PNG cannot be whole, or "": its chunks must be there to the last one and have their checksums.
std::string png_problem(std::string_view bytes);

}  // namespace spslam
