// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/loop/two_view.h"

#include <limits>
#include <opencv2/calib3d.hpp>

#include "spslam/base/random.h"

namespace spslam {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kLeastDisparity = -1.5;  // px; noise puts what is far away beyond infinity, but not farther
constexpr double kNearer = 3.6;           // ratio of distances that a pyramid of 8 levels spans
constexpr double kUsableDepth = 2;        // standard deviations of the inverse depth from 0
constexpr int kSample = 3;
constexpr int kDirections = 4;      // at least that many samples in a row go without depths
constexpr int kPolishSteps = 4;     // of the solver, for each new best hypothesis
constexpr double kPolishReach = 2;  // times the inliers' sigmas

bool has_depth(const Correspondence& c) {
  return c.inverse_depth > 0 && c.inverse_depth * std::sqrt(c.information) > kUsableDepth;
}

// Three different ones out of `count`.
std::array<int, kSample> draw(int count, Random& random) {
  std::array<int, kSample> out{};
  for (int i = 0; i < kSample; ++i) {
    bool is_new = false;
    while (!is_new) {
      out[i] = static_cast<int>(random.below(static_cast<std::uint32_t>(count)));
      is_new = std::find(out.begin(), out.begin() + i, out[i]) == out.begin() + i;
    }
  }
  return out;
}

std::vector<SE3> from_three_points(const StereoRig& rig,
                                   const std::array<const Correspondence*, kSample>& sample) {
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> seen;
  for (const Correspondence* c : sample) {
    const Eigen::Vector3d p = c->bearing / c->inverse_depth,
                          b = rig.bearing(c->measured.x(), c->measured.y());
    points.emplace_back(p.x(), p.y(), p.z());
    seen.emplace_back(b.x(), b.y());
  }
  std::vector<cv::Mat> rotations, translations;
  cv::solveP3P(points, seen, cv::Matx33d::eye(), cv::noArray(), rotations, translations, cv::SOLVEPNP_AP3P);
  std::vector<SE3> out;
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    const auto* r = rotations[i].ptr<double>();
    const auto* t = translations[i].ptr<double>();
    const SE3 motion{so3_exp({r[0], r[1], r[2]}), {t[0], t[1], t[2]}};
    if (motion.is_finite()) out.push_back(motion);
  }
  return out;
}

// The rotation that brings the directions of one view to those of the other.
SE3 from_directions(const StereoRig& rig, const std::array<const Correspondence*, kSample>& sample) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Correspondence* c : sample)
    sum += rig.bearing(c->measured.x(), c->measured.y()).normalized() * c->bearing.normalized().transpose();
  return {rotation_between(sum), Eigen::Vector3d::Zero()};
}

Problem two_view_problem(const StereoRig& rig, const std::vector<Correspondence>& all, const SE3& start) {
  Problem problem;
  problem.rig = rig;
  problem.poses = {{SE3{}, true}, {start, false}};
  for (const Correspondence& c : all) {
    problem.landmarks.push_back({0, c.bearing, c.inverse_depth, c.inverse_depth, c.information, false});
    problem.observations.push_back(
        {static_cast<int>(problem.landmarks.size()) - 1, 1, c.measured, c.inverse_sigma, 1});
  }
  return problem;
}

class ConsensusSearch {
 public:
  ConsensusSearch(const StereoRig& rig, const std::vector<Correspondence>& all,
                  const ConsensusOptions& options)
      : rig_(rig), all_(all), options_(options), limit_(options.inlier_sigmas * options.inlier_sigmas) {
    for (std::size_t i = 0; i < all.size(); ++i)
      if (has_depth(all[i])) with_depth_.push_back(static_cast<int>(i));
  }

  Consensus run() {
    const int count = static_cast<int>(all_.size());
    int needed = options_.iterations;
    for (int i = 0; i < needed; ++i) {
      const bool points = i % kDirections != 0 && static_cast<int>(with_depth_.size()) >= kSample;
      const auto drawn = draw(points ? static_cast<int>(with_depth_.size()) : count, random_);
      std::array<const Correspondence*, kSample> sample{};
      for (int s = 0; s < kSample; ++s) sample[s] = &all_[points ? with_depth_[drawn[s]] : drawn[s]];
      bool improved = false;
      if (points)
        for (const SE3& motion : from_three_points(rig_, sample)) improved = offer(motion) || improved;
      else
        improved = offer(from_directions(rig_, sample));
      if (improved) needed = std::min(needed, samples_needed());
    }
    return {best_, inliers_of(rig_, best_, all_, options_.inlier_sigmas)};
  }

 private:
  // MSAC; gives up where it is worse than `worst`.
  double score(const SE3& motion, double worst) const {
    double sum = 0;
    for (const Correspondence& c : all_) {
      sum += std::min(limit_, squared_error(rig_, motion, c));
      if (sum >= worst) return kInfinite;
    }
    return sum;
  }

  bool offer(const SE3& motion) {
    const double at = score(motion, best_score_);
    if (at >= best_score_) return false;
    best_ = motion, best_score_ = at;
    polish();
    return true;
  }

  void polish() {
    for (int round = 0; round < 2; ++round) {
      const auto near = inliers_of(rig_, best_, all_, kPolishReach * options_.inlier_sigmas);
      const auto refined = refine_motion(rig_, near, best_, kPolishSteps);
      const double at = refined ? score(refined->newer_from_older, best_score_) : kInfinite;
      if (at >= best_score_) return;
      best_ = refined->newer_from_older, best_score_ = at;
    }
  }

  // How many samples it takes to draw one without an outlier, with the inliers found so far; those without
  // depths are drawn only now and then.
  int samples_needed() const {
    const double count = static_cast<double>(all_.size());
    const double share =
        static_cast<double>(inliers_of(rig_, best_, all_, options_.inlier_sigmas).size()) / count;
    const double good = std::pow(share, kSample);
    if (good >= options_.confidence) return kDirections;
    if (!(good > 0)) return options_.iterations;
    const double samples = std::log(1 - options_.confidence) / std::log(1 - good) * kDirections;
    return static_cast<int>(std::min<double>(options_.iterations, std::ceil(samples)));
  }

  const StereoRig& rig_;
  const std::vector<Correspondence>& all_;
  const ConsensusOptions& options_;
  const double limit_;
  std::vector<int> with_depth_;
  Random random_{1};
  SE3 best_;
  double best_score_ = kInfinite;
};

}  // namespace

double squared_error(const StereoRig& rig, const SE3& newer_from_older, const Correspondence& c) {
  const Linearized at = linearize(rig, newer_from_older, c.bearing, c.inverse_depth, c.measured);
  if (!at.in_front) return kInfinite;
  const double nearer =
      (newer_from_older.rotation * c.bearing + c.inverse_depth * newer_from_older.translation).norm() /
      c.bearing.norm();
  if (!(nearer < kNearer && nearer * kNearer > 1)) return kInfinite;
  const Eigen::Vector3d r = at.residual.cwiseProduct(c.inverse_sigma);
  const Eigen::Vector3d a = at.by_inverse_depth.cwiseProduct(c.inverse_sigma);
  const double hessian = c.information + a.squaredNorm(), gradient = a.dot(r);
  if (!(hessian > 0)) return r.squaredNorm();
  const double best = c.inverse_depth - gradient / hessian;
  if (!(best * rig.disparity_per_inverse_depth() > kLeastDisparity)) return kInfinite;
  return r.squaredNorm() - gradient * gradient / hessian;
}

Correspondence widened(const StereoRig& rig, const SE3& newer_from_older, Correspondence c, double share) {
  const Linearized at = linearize(rig, newer_from_older, c.bearing, c.inverse_depth, c.measured);
  if (!at.in_front || !(c.inverse_sigma.x() > 0)) return c;
  const double way = at.by_inverse_depth.head<2>().norm() * std::abs(c.inverse_depth);
  c.inverse_sigma.head<2>().setConstant(1 / std::hypot(1 / c.inverse_sigma.x(), share * way));
  return c;
}

double translation_information(const StereoRig& rig, const SE3& newer_from_older, const Correspondence& c) {
  const Linearized at = linearize(rig, newer_from_older, c.bearing, c.inverse_depth, c.measured);
  if (!at.in_front) return 0;
  const Eigen::Matrix3d j = c.inverse_sigma.asDiagonal() * at.by_relative.leftCols<3>();
  const Eigen::Vector3d a = at.by_inverse_depth.cwiseProduct(c.inverse_sigma);
  const double hessian = c.information + a.squaredNorm();
  return j.squaredNorm() - (hessian > 0 ? (j.transpose() * a).squaredNorm() / hessian : 0);
}

std::vector<Correspondence> inliers_of(const StereoRig& rig, const SE3& newer_from_older,
                                       const std::vector<Correspondence>& all, double sigmas) {
  std::vector<Correspondence> out;
  for (const Correspondence& c : all)
    if (squared_error(rig, newer_from_older, c) <= sigmas * sigmas) out.push_back(c);
  return out;
}

Consensus find_consensus(const StereoRig& rig, const std::vector<Correspondence>& all,
                         const ConsensusOptions& options) {
  if (static_cast<int>(all.size()) < kSample) return {};
  return ConsensusSearch(rig, all, options).run();
}

std::optional<RefinedMotion> refine_motion(const StereoRig& rig, const std::vector<Correspondence>& inliers,
                                           const SE3& start, int iterations) {
  if (static_cast<int>(inliers.size()) < kSample) return std::nullopt;
  Problem problem = two_view_problem(rig, inliers, start);
  SolverOptions solver;
  solver.iterations = iterations;
  const SolveSummary summary = solve(problem, solver, true);
  RefinedMotion out;
  out.newer_from_older = problem.poses[1].camera_from_world;
  if (summary.status == SolveStatus::kFailed || !out.newer_from_older.is_finite() ||
      summary.covariance.rows() != 6 || !summary.covariance.allFinite())
    return std::nullopt;
  out.covariance = summary.covariance;
  double freedoms = -6;
  for (const Correspondence& c : inliers)
    freedoms += (c.inverse_sigma.array() > 0).count() - (c.information > 0 ? 0 : 1);
  out.cost_per_freedom = summary.final_cost / std::max(1.0, freedoms);
  return out;
}

}  // namespace spslam
