// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// EuRoC's image lists and the pairing of two eyes by time.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace spslam {

struct EurocImage {
  std::int64_t time_ns = 0;
  std::string file;  // in data/
};

// camN/data.csv: `t_ns,filename`, times strictly increasing. Throws InputError "name:line: what".
std::vector<EurocImage> parse_euroc_images(std::string_view text, const std::string& name);

// Indices of left and right images that are each other's nearest in time and at most tolerance_ns apart, in
// order.
std::vector<std::pair<int, int>> pair_by_time(std::span<const EurocImage> left,
                                              std::span<const EurocImage> right, std::int64_t tolerance_ns);

}  // namespace spslam
