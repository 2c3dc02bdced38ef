// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>

#include "spslam/base/sort_unique.h"
#include "spslam/optimize/normal_equations.h"
#include "spslam/optimize/pieces.h"

namespace spslam {
namespace {

// Where each landmark's observations begin.
std::vector<std::size_t> first_observations(const Problem& problem) {
  std::vector<std::size_t> first(problem.landmarks.size() + 1, 0);
  for (const Observation& z : problem.observations) ++first[static_cast<std::size_t>(z.landmark) + 1];
  for (std::size_t l = 1; l < first.size(); ++l) first[l] += first[l - 1];
  return first;
}

int place_of(int value, std::vector<int>::const_iterator begin, std::vector<int>::const_iterator end) {
  return static_cast<int>(std::lower_bound(begin, end, value) - begin);
}

}  // namespace

PoseColumns::PoseColumns(const Problem& problem) {
  for (const PoseVariable& pose : problem.poses) {
    of_pose.push_back(pose.fixed ? -1 : count);
    if (!pose.fixed) count += 6;
  }
  if (!problem.disparity_offset.fixed) offset = count, count += 4;
}

ProblemStructure::ProblemStructure(const Problem& problem)
    : columns(problem), first_observation(first_observations(problem)) {
  list_pairs(problem);
  list_entries(problem);
  find_envelope();
}

void ProblemStructure::list_pairs(const Problem& problem) {
  const std::size_t poses = problem.poses.size();
  std::vector<int> index(poses * poses, -1);
  pair_of_observation.reserve(problem.observations.size());
  for (const Observation& z : problem.observations) {
    const int host = problem.landmarks[z.landmark].host;
    int& at = index[static_cast<std::size_t>(host) * poses + static_cast<std::size_t>(z.pose)];
    if (at < 0) {
      at = static_cast<int>(pairs.size());
      pairs.push_back({host, z.pose});
    }
    pair_of_observation.push_back(at);
  }
  pairs_of_piece.resize(count_pieces(problem.landmarks.size()));
  for (std::size_t piece = 0; piece < pairs_of_piece.size(); ++piece) {
    std::vector<int>& here = pairs_of_piece[piece];
    const auto [first, last] = piece_of(piece, problem.landmarks.size());
    for (std::size_t i = first_observation[first]; i < first_observation[last]; ++i)
      here.push_back(pair_of_observation[i]);
    sort_unique(here);
    for (std::size_t i = first_observation[first]; i < first_observation[last]; ++i)
      pair_of_observation[i] = place_of(pair_of_observation[i], here.begin(), here.end());
  }
}

void ProblemStructure::list_entries(const Problem& problem) {
  const auto block_of = [&](int pose) { return columns.of_pose[pose] < 0 ? -1 : columns.of_pose[pose] / 6; };
  entry_of_pose.assign(problem.observations.size(), -1);
  entry_of_host.assign(problem.observations.size(), -1);
  entries_of_block.resize(static_cast<std::size_t>(columns.blocks()));
  first_entry.push_back(0);
  std::vector<int> blocks;
  for (std::size_t l = 0; l < problem.landmarks.size(); ++l) {
    blocks.clear();
    const LandmarkVariable& landmark = problem.landmarks[l];
    const int host = block_of(landmark.host);
    for (std::size_t i = first_observation[l]; i < first_observation[l + 1] && !landmark.fixed; ++i) {
      const int pose = problem.observations[i].pose;
      if (columns.offset >= 0) blocks.push_back(columns.blocks() - 1);
      if (pose == landmark.host) continue;
      if (host >= 0) blocks.push_back(host);
      if (block_of(pose) >= 0) blocks.push_back(block_of(pose));
    }
    sort_unique(blocks);
    const auto entry = [&](int block) {
      return block < 0 ? -1
                       : static_cast<int>(first_entry[l]) + place_of(block, blocks.begin(), blocks.end());
    };
    for (std::size_t i = first_observation[l]; i < first_observation[l + 1] && !landmark.fixed; ++i) {
      const int pose = problem.observations[i].pose;
      if (pose == landmark.host) continue;
      entry_of_pose[i] = entry(block_of(pose));
      entry_of_host[i] = entry(host);
    }
    for (const int block : blocks)
      entries_of_block[static_cast<std::size_t>(block)].push_back(
          {static_cast<std::uint32_t>(l), static_cast<std::uint32_t>(entry(block))});
    block_of_entry.insert(block_of_entry.end(), blocks.begin(), blocks.end());
    first_entry.push_back(block_of_entry.size());
  }
}

void ProblemStructure::find_envelope() {
  for (int row = 0; row < columns.blocks(); ++row) envelope.push_back(row);
  if (columns.offset >= 0) envelope.back() = 0;
  const auto couple = [&](int a, int b) {
    int& first = envelope[static_cast<std::size_t>(std::max(a, b))];
    first = std::min({first, a, b});
  };
  for (std::size_t l = 0; l + 1 < first_entry.size(); ++l)
    for (std::size_t e = first_entry[l]; e < first_entry[l + 1]; ++e)
      couple(block_of_entry[first_entry[l]], block_of_entry[e]);
  for (const ObservedPair& pair : pairs)
    if (columns.of_pose[pair.host] >= 0 && columns.of_pose[pair.pose] >= 0)
      couple(columns.of_pose[pair.host] / 6, columns.of_pose[pair.pose] / 6);
}

}  // namespace spslam
