// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/cli/sample_pairs.h"

#include <spdlog/spdlog.h>

#include <cmath>

#include "spslam/eval/recording_check.h"

namespace spslam {
namespace {

StereoFrame load_if_any(const Dataset& dataset, int index) {
  return index < 0 || index >= dataset.size() ? StereoFrame() : dataset.load(index);
}

void warn(const std::string& found, const Finding& finding) {
  spdlog::warn("the first pairs: {}; {} (`spslam check` tells more)", found, finding.advice);
}

}  // namespace

RecordingSample sample_recording(const Dataset& dataset, int count) {
  RecordingSample sample;
  sample.rig = dataset.rig();
  for (int i = 0; i < dataset.size(); ++i) sample.times.push_back(dataset.timestamp(i));
  PairMatcher matcher;
  const int pairs = std::min(count, dataset.size());
  for (int k = 0; k < pairs; ++k) {
    const int index = static_cast<int>((2LL * k + 1) * dataset.size() / (2LL * pairs));
    const StereoFrame pair = dataset.load(index);
    if (pair.problem.empty()) {
      sample.pairs.push_back(
          measure_pair(matcher, pair, load_if_any(dataset, index - 1), load_if_any(dataset, index + 1)));
    } else if (sample.unusable++ == 0) {
      sample.first_problem = pair.problem;
    }
  }
  return sample;
}

void warn_of_pairs(const Dataset& dataset, int start) {
  constexpr int kPairs = 3, kTries = 6;
  PairMatcher matcher(500);
  std::vector<PairMatch> matches;
  for (int i = 0, used = 0; i < kTries && used < kPairs; ++i) {
    const StereoFrame pair = load_if_any(dataset, start + i);
    if (!pair.problem.empty() || pair.left.empty()) continue;
    const std::vector<PairMatch> found = match_pair(matcher.prepare(pair.left), matcher.prepare(pair.right));
    matches.insert(matches.end(), found.begin(), found.end());
    ++used;
  }
  const RowOffsets rows = measure_rows(matches, {dataset.rig().width, dataset.rig().height});
  const DisparityStatistics disparities = measure_disparities(on_rows(matches, rows));
  const Finding row_finding = judge_rows(rows, 0), sign = judge_sign(disparities);
  // Of eyes that are not of one instant, disparities say nothing.
  if (row_finding.judgement == Judgement::kBad)
    warn(
        fmt::format("rows of right images are {:.1f} px off, {:.1f} px in a corner, and scatter by {:.1f} px",
                    std::abs(rows.median), std::abs(rows.worst_corner), rows.spread),
        row_finding);
  else if (sign.judgement == Judgement::kBad)
    warn(fmt::format("{:.0f} % of the disparities are negative", 100 * disparities.negative), sign);
}

}  // namespace spslam
