// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The normal equations of a Problem at its present values, before the landmarks are eliminated. Used by
// solve() only. What grows with the map is stored sparsely: a landmark has derivatives by the few poses that
// see it, and a pose shares landmarks with few others.
#pragma once

#include <cstdint>
#include <vector>

#include "spslam/optimize/envelope.h"
#include "spslam/optimize/problem.h"

namespace spslam {

// Which columns of the pose part belong to which pose, and to the disparity offset, which is eliminated last
// like a pose.
struct PoseColumns {
  explicit PoseColumns(const Problem& problem);
  std::vector<int> of_pose;  // first column, or -1 for a fixed pose
  int offset = -1;  // first of the 4 columns of the disparity offset, after the poses; -1 if it is fixed
  int count = 0;    // all columns
  // Columns in blocks of 6, the free poses in their order; the last block of the offset is 4 wide.
  int blocks() const { return (count + 5) / 6; }
};

// A host and a pose that sees one of its landmarks.
struct ObservedPair {
  int host, pose;
};

// What stays the same while a problem is solved: who sees what.
struct ProblemStructure {
  explicit ProblemStructure(const Problem& problem);

  PoseColumns columns;
  std::vector<std::size_t> first_observation;  // of each landmark, and the end
  std::vector<ObservedPair> pairs;
  // The landmarks are summed in pieces; the pairs that occur in one, ascending, and each observation's place
  // among those of its piece.
  std::vector<std::vector<int>> pairs_of_piece;
  std::vector<int> pair_of_observation;
  // The blocks that a landmark has mixed derivatives by, ascending: entries [first_entry[l], first_entry[l +
  // 1]). None for a fixed one.
  std::vector<std::size_t> first_entry;
  std::vector<int> block_of_entry;
  // The other way round: landmarks that have derivatives by a block, in ascending order, with the entry.
  struct LandmarkEntry {
    std::uint32_t landmark, entry;
  };
  std::vector<std::vector<LandmarkEntry>> entries_of_block;
  // Entry of the observing pose and of the host for each observation, -1 if it is held.
  std::vector<int> entry_of_pose, entry_of_host;
  std::vector<int> envelope;  // first block of each row of the reduced system

 private:
  void list_pairs(const Problem& problem);
  void list_entries(const Problem& problem);
  void find_envelope();
};

struct NormalEquations {
  double cost = 0;
  SymmetricEnvelope pose_hessian;  // the columns in blocks of 6; the rest of the last block is zero
  Eigen::VectorXd pose_gradient;   // count
  std::vector<Vector6d> mixed;     // second derivatives by a landmark and a block: one an entry
  Eigen::VectorXd landmark_hessian, landmark_gradient;  // 0 for fixed landmarks
};

// Same bits at any number of threads: the landmarks are cut into pieces of a fixed size, summed in order.
void build_normal_equations(const Problem& problem, const ProblemStructure& structure,
                            const SolverOptions& options, NormalEquations& out);

}  // namespace spslam
