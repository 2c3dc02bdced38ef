// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The left image of a keyframe as the map keeps it: a JPEG, some tens of kB, for whoever aligns the patches
// of its landmarks when its pyramid is long gone.
#pragma once

#include <opencv2/core.hpp>

#include "spslam/map/types.h"

namespace spslam {

// quality: of the JPEG, 1 to 100. grey: CV_8UC1. Null if it cannot be encoded.
std::shared_ptr<const ImageBytes> compress(const cv::Mat& grey, int quality);

// CV_8UC1 of that size; empty if the bytes are no such JPEG, as in a map from elsewhere.
cv::Mat decompress(const ImageBytes& bytes, int width, int height);

}  // namespace spslam
