// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// A symmetric matrix of 6 x 6 blocks of which each row of blocks is stored from its first block that is not
// zero up to the diagonal. Its Cholesky factor needs no more room: it fills in nothing before a row's first
// block (George and Liu, "Computer solution of large sparse positive definite systems", 1981, chapter 4).
// Poses in order of time that see what their neighbours see make short rows. Used by solve() only.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "spslam/base/se3.h"

namespace spslam {

class SymmetricEnvelope {
 public:
  // All zero, of this shape: first[row] <= row is the column of the first block of a row.
  void reset(const std::vector<int>& first);

  int rows() const { return static_cast<int>(first_.size()); }
  int first(int row) const { return first_[static_cast<std::size_t>(row)]; }
  // Column by column; first(row) <= column <= row. The blocks of a row lie one after the other.
  double* data(int row, int column);
  const double* data(int row, int column) const;
  Eigen::Map<Matrix6d> block(int row, int column) { return Eigen::Map<Matrix6d>(data(row, column)); }
  // The leading size x size elements, both halves.
  Eigen::MatrixXd dense(int size) const;

  // Replaces the matrix L L' by L; false, with rubbish left behind, if it is not positive definite. Same bits
  // at any number of threads.
  bool factorize();
  // Replaces x, 6 rows() long, by the solution of L L' y = x. After factorize().
  void solve(Eigen::VectorXd& x) const;

 private:
  bool factorize_diagonal(int column);
  void factorize_below(int row, int column);

  std::vector<int> first_;
  std::vector<std::size_t> offset_;  // of where column 0 of a row would be
  std::vector<double> values_;
};

}  // namespace spslam
