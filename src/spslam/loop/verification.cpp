// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/loop/verification.h"

#include <Eigen/Eigenvalues>
#include <set>

#include "spslam/base/median.h"
#include "spslam/loop/correspondences.h"

namespace spslam {
namespace {

constexpr int kRounds = 3;  // of refinement and new inliers
constexpr int kGuidedRounds = 2;
constexpr int kSolverSteps = 15;
constexpr int kCells = 8;         // along each side of the image
constexpr double kWellKnown = 4;  // standard deviations of an inverse depth from 0 that is compared
constexpr double kUnknown = 1e6;  // m^2 and rad^2
constexpr int kLeastScaled = 8;   // ratios of depths that a scale takes

// One verification, step by step.
class Verifier {
 public:
  Verifier(const Place& older, const KeyframeFeatures& newer, const StereoRig& rig,
           const VerificationOptions& options)
      : older_(older), newer_(newer), rig_(rig), options_(options), all_(older, newer, rig, options) {
    all_.use_disparities(!options.free_scale);
  }

  Verification run(const Vocabulary& vocabulary) {
    if (older_.points.empty() || newer_.size() == 0) return end(VerificationStage::kNotDescribed);
    if (!find_motion(vocabulary)) return out_;
    if (options_.free_scale) {
      all_.set_scale(measure_scale());
      all_.use_disparities(true);
    }
    if (!gather()) return end(VerificationStage::kInliers);
    if (!options_.free_scale) measure_scale();
    return end(judge());
  }

 private:
  Verification end(VerificationStage stage) {
    out_.stage = stage;
    return out_;
  }

  bool find_motion(const Vocabulary& vocabulary) {
    const std::vector<Correspondence> matches = all_.by_descriptor(vocabulary);
    out_.matches = static_cast<int>(matches.size());
    out_.stage = VerificationStage::kMatching;
    if (out_.matches < options_.min_matches) return false;
    Consensus consensus = find_consensus(rig_, matches, options_.consensus);
    out_.consensus = static_cast<int>(consensus.inliers.size());
    out_.newer_from_older = consensus.newer_from_older;
    out_.pairs = std::move(consensus.inliers);
    out_.stage = VerificationStage::kConsensus;
    return out_.consensus >= options_.min_consensus && refine(out_.pairs);
  }

  // Solves for the motion with those of `all` that agree with it, again and again; the last ones stay.
  bool refine(const std::vector<Correspondence>& all) {
    const std::vector<Correspondence> from(all.begin(), all.end());  // all may be out_.pairs
    for (int round = 0; round < kRounds; ++round) {
      std::vector<Correspondence> weighed;
      weighed.reserve(from.size());
      for (const Correspondence& c : from)
        weighed.push_back(widened(rig_, out_.newer_from_older, c, options_.parallax_share));
      out_.pairs = inliers_of(rig_, out_.newer_from_older, weighed, options_.consensus.inlier_sigmas);
      const auto refined = refine_motion(rig_, out_.pairs, out_.newer_from_older, kSolverSteps);
      if (!refined) return false;
      out_.newer_from_older = refined->newer_from_older;
      out_.covariance = refined->covariance * std::max(1.0, refined->cost_per_freedom);
    }
    return true;
  }

  // Guided matching, twice. Within a radius far greater than an inlier's error, so that what is no match is
  // hardly ever an inlier by chance, and the share of inliers tells a right motion from a wrong one.
  bool gather() {
    for (int round = 0; round < kGuidedRounds; ++round) {
      const std::vector<Correspondence> guided = all_.guided(out_.newer_from_older, options_.guided_radius);
      out_.guided = static_cast<int>(guided.size());
      if (!refine(guided)) return false;
    }
    out_.inliers = static_cast<int>(out_.pairs.size());
    return out_.inliers >= options_.min_inliers;
  }

  VerificationStage judge() {
    out_.visible = all_.visible(out_.newer_from_older);
    out_.cells = count_cells();
    if (!trim()) out_.covariance = kUnknown * Matrix6d::Identity();
    add_common_bias();
    out_.set_covariance(out_.covariance);
    if (out_.inliers < options_.min_inlier_share * out_.guided ||
        out_.inliers < options_.min_visible_share * out_.visible)
      return VerificationStage::kShare;
    if (out_.cells < options_.min_cells) return VerificationStage::kSpread;
    const bool known = out_.translation_sigma <= options_.max_translation_sigma &&
                       out_.rotation_sigma <= options_.max_rotation_sigma;
    return known ? VerificationStage::kAccepted : VerificationStage::kUncertain;
  }

  int count_cells() const {
    std::set<std::pair<int, int>> cells;
    for (const Correspondence& c : out_.pairs)
      cells.insert({static_cast<int>(kCells * c.measured.x() / rig_.width),
                    static_cast<int>(kCells * c.measured.y() / rig_.height)});
    return static_cast<int>(cells.size());
  }

  // A few wrong matches of near points can pull the translation and look sure of it, while the many far ones
  // have no say. So the motion is as uncertain as it is without those that say most, and as the difference.
  bool trim() {
    std::vector<std::pair<double, int>> say;
    for (std::size_t i = 0; i < out_.pairs.size(); ++i)
      say.emplace_back(-translation_information(rig_, out_.newer_from_older, out_.pairs[i]),
                       static_cast<int>(i));
    std::sort(say.begin(), say.end());
    std::vector<Correspondence> rest;
    const auto first =
        static_cast<std::size_t>(std::ceil(options_.trimmed_share * static_cast<double>(say.size())));
    for (std::size_t i = first; i < say.size(); ++i) rest.push_back(out_.pairs[say[i].second]);
    const auto without = refine_motion(rig_, rest, out_.newer_from_older, kSolverSteps);
    if (!without) return false;
    const Vector6d off = (without->newer_from_older * out_.newer_from_older.inverse()).log();
    out_.covariance = without->covariance * std::max(1.0, without->cost_per_freedom) + off * off.transpose();
    return true;
  }

  // An error that all disparities share scales what they measure: the translation by bias over disparity,
  // the disparities weighed as they weigh in the translation, by their squares. And where the two sides'
  // depths are of different scale, one of them is wrong, and the translation as well.
  void add_common_bias() {
    double sum = 0, squares = 0;
    for (const Correspondence& c : out_.pairs) {
      const double disparity = std::max(0.0, c.inverse_depth * rig_.disparity_per_inverse_depth());
      sum += disparity, squares += disparity * disparity;
    }
    const double bias = squares > 0 ? options_.disparity_bias * sum / squares : 0;
    const double disagreement = options_.free_scale ? 0 : std::log(out_.scale);
    const Eigen::Vector3d off = std::hypot(bias, disagreement) * out_.newer_from_older.translation;
    out_.covariance.topLeftCorner<3, 3>() += off * off.transpose();
  }

  // Median ratio of the inverse depth that the newer side measured to the one that the older side says.
  double measure_scale() {
    std::vector<double> ratios;
    for (const Correspondence& c : out_.pairs) {
      const double own = newer_.inverse_depths[c.feature], information = newer_.information[c.feature];
      const double z =
          (out_.newer_from_older.rotation * c.bearing + c.inverse_depth * out_.newer_from_older.translation)
              .z();
      const bool known = own * std::sqrt(std::max(0.0, information)) > kWellKnown &&
                         c.inverse_depth * std::sqrt(c.information) > kWellKnown && z > 0;
      if (known) ratios.push_back(own * z / c.inverse_depth);
    }
    out_.scaled = static_cast<int>(ratios.size());
    if (out_.scaled < kLeastScaled) return 1;
    return out_.scale = median(std::move(ratios));
  }

  const Place& older_;
  const KeyframeFeatures& newer_;
  const StereoRig& rig_;
  const VerificationOptions& options_;
  Correspondences all_;
  Verification out_;
};

}  // namespace

void Verification::set_covariance(const Matrix6d& value) {
  covariance = value;
  const auto deviation = [&](int first) {
    const Eigen::Matrix3d block = covariance.block<3, 3>(first, first);
    return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(block).eigenvalues().maxCoeff());
  };
  translation_sigma = deviation(0);
  rotation_sigma = deviation(3) * 180 / M_PI;
}

Verification verify(const Place& older, const KeyframeFeatures& newer, const StereoRig& rig,
                    const Vocabulary& vocabulary, const VerificationOptions& options) {
  return Verifier(older, newer, rig, options).run(vocabulary);
}

}  // namespace spslam
