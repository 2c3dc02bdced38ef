// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace spslam {

// Adds to a value of known information (1/variance) what an independent source says of the same.
inline void add_to_mean(double other, double other_information, double& value, double& information) {
  const double sum = information + other_information;
  value = (information * value + other_information * other) / sum;
  information = sum;
}

}  // namespace spslam
