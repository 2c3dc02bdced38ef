// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/optimize/reduced_system.h"

#include <tbb/parallel_for.h>

#include "spslam/base/simd.h"

namespace spslam {
namespace {

// block -= a b'. Spelt out, for the compiler to make the most of.
SPSLAM_SIMD void subtract_product(const double* a, const double* b, double* block) {
  for (int s = 0; s < 6; ++s)
    for (int r = 0; r < 6; ++r) block[6 * s + r] -= a[r] * b[s];
}

// The landmark's part of column `entry` of the reduced system: its blocks on and below the diagonal.
void eliminate(const NormalEquations& equations, const ProblemStructure& structure,
               const Eigen::VectorXd& inverse, std::size_t l, std::size_t entry, ReducedSystem& out) {
  const double information = inverse[static_cast<Eigen::Index>(l)];
  const int column = structure.block_of_entry[entry];
  const Vector6d scaled = information * equations.mixed[entry];
  out.gradient.segment<6>(6 * column) -= scaled * equations.landmark_gradient[static_cast<Eigen::Index>(l)];
  for (std::size_t e = entry; e < structure.first_entry[l + 1]; ++e)
    subtract_product(equations.mixed[e].data(), scaled.data(),
                     out.hessian.data(structure.block_of_entry[e], column));
}

}  // namespace

void eliminate_landmarks(const NormalEquations& equations, const ProblemStructure& structure,
                         const Eigen::VectorXd& inverse, double damping, ReducedSystem& out) {
  out.hessian = equations.pose_hessian;
  out.gradient.setZero(6 * structure.columns.blocks());
  out.gradient.head(structure.columns.count) = equations.pose_gradient;
  for (int block = 0; block < structure.columns.blocks(); ++block)
    out.hessian.block(block, block).diagonal() *= 1 + damping;
  if (structure.columns.offset >= 0)
    out.hessian.block(out.hessian.rows() - 1, out.hessian.rows() - 1).diagonal().tail<2>().setOnes();
  tbb::parallel_for(std::size_t{0}, structure.entries_of_block.size(), [&](std::size_t block) {
    for (const auto& [landmark, entry] : structure.entries_of_block[block])
      eliminate(equations, structure, inverse, landmark, entry, out);
  });
}

}  // namespace spslam
