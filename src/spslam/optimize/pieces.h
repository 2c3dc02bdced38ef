// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Landmarks in pieces of a fixed size, which one thread sums up. Used by solve() only.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

namespace spslam {

inline constexpr std::size_t kPiece = 128;  // landmarks

inline std::size_t count_pieces(std::size_t landmarks) {
  return (landmarks + kPiece - 1) / kPiece;
}
// First landmark and the end.
inline std::pair<std::size_t, std::size_t> piece_of(std::size_t piece, std::size_t landmarks) {
  return {piece * kPiece, std::min((piece + 1) * kPiece, landmarks)};
}

}  // namespace spslam
