// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/optimize/envelope.h"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>

#include "spslam/base/simd.h"

namespace spslam {
namespace {

constexpr std::size_t kBlockSize = 36;
constexpr int kGrain = 12;  // blocks of a column that are worth a task

// out -= sum over k of a_k b_k', n blocks each. Spelt out: 36 sums in registers.
SPSLAM_SIMD void subtract_products(const double* a, const double* b, int n, double* out) {
  double sums[kBlockSize] = {};
  for (int column = 0; column < 6 * n; ++column, a += 6, b += 6)
    for (int s = 0; s < 6; ++s)
      for (int r = 0; r < 6; ++r) sums[6 * s + r] += a[r] * b[s];
  for (std::size_t i = 0; i < kBlockSize; ++i) out[i] -= sums[i];
}

}  // namespace

void SymmetricEnvelope::reset(const std::vector<int>& first) {
  first_ = first;
  offset_.resize(first.size());
  std::size_t end = 0;
  for (std::size_t row = 0; row < first.size(); ++row) {
    offset_[row] =
        end - kBlockSize * static_cast<std::size_t>(first[row]);  // may wrap round; data() comes back
    end += kBlockSize * (row + 1 - static_cast<std::size_t>(first[row]));
  }
  values_.assign(end, 0.0);
}

double* SymmetricEnvelope::data(int row, int column) {
  return values_.data() +
         (offset_[static_cast<std::size_t>(row)] + kBlockSize * static_cast<std::size_t>(column));
}

const double* SymmetricEnvelope::data(int row, int column) const {
  return values_.data() +
         (offset_[static_cast<std::size_t>(row)] + kBlockSize * static_cast<std::size_t>(column));
}

Eigen::MatrixXd SymmetricEnvelope::dense(int size) const {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(6 * rows(), 6 * rows());
  for (int row = 0; row < rows(); ++row)
    for (int column = first(row); column <= row; ++column) {
      const Eigen::Map<const Matrix6d> block(data(row, column));
      out.block<6, 6>(6 * row, 6 * column) = block;
      if (column < row) out.block<6, 6>(6 * column, 6 * row) = block.transpose();
    }
  return out.topLeftCorner(size, size);
}

bool SymmetricEnvelope::factorize_diagonal(int column) {
  double* diagonal = data(column, column);
  const double* row = data(column, first(column));
  subtract_products(row, row, column - first(column), diagonal);
  const Eigen::LLT<Matrix6d> factor{Eigen::Map<const Matrix6d>(diagonal)};
  if (factor.info() != Eigen::Success) return false;
  const Matrix6d lower = factor.matrixL();
  Eigen::Map<Matrix6d>{diagonal} = lower;
  return lower.allFinite();
}

void SymmetricEnvelope::factorize_below(int row, int column) {
  if (first(row) > column) return;
  const int from = std::max(first(row), first(column));
  subtract_products(data(row, from), data(column, from), column - from, data(row, column));
  const Eigen::Map<const Matrix6d> diagonal(data(column, column));
  Eigen::Map<Matrix6d> here(data(row, column));
  diagonal.transpose().triangularView<Eigen::Upper>().solveInPlace<Eigen::OnTheRight>(here);
}

bool SymmetricEnvelope::factorize() {
  for (int column = 0; column < rows(); ++column) {
    if (!factorize_diagonal(column)) return false;
    tbb::parallel_for(tbb::blocked_range<int>(column + 1, rows(), kGrain),
                      [&](const tbb::blocked_range<int>& below) {
                        for (int row = below.begin(); row < below.end(); ++row) factorize_below(row, column);
                      });
  }
  return true;
}

void SymmetricEnvelope::solve(Eigen::VectorXd& x) const {
  for (int row = 0; row < rows(); ++row) {
    Vector6d part = x.segment<6>(6 * row);
    for (int column = first(row); column < row; ++column)
      part -= Eigen::Map<const Matrix6d>(data(row, column)) * x.segment<6>(6 * column);
    x.segment<6>(6 * row) =
        Eigen::Map<const Matrix6d>(data(row, row)).triangularView<Eigen::Lower>().solve(part);
  }
  for (int row = rows() - 1; row >= 0; --row) {
    const Vector6d part = Eigen::Map<const Matrix6d>(data(row, row))
                              .transpose()
                              .triangularView<Eigen::Upper>()
                              .solve(x.segment<6>(6 * row));
    x.segment<6>(6 * row) = part;
    for (int column = first(row); column < row; ++column)
      x.segment<6>(6 * column) -= Eigen::Map<const Matrix6d>(data(row, column)).transpose() * part;
  }
}

}  // namespace spslam
