// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/loop/matching.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace spslam {
namespace {

constexpr int kWorst = 257;  // no Hamming distance is that great
constexpr int kBins = 36;

struct Nearest {
  int feature = -1, distance = kWorst, second = kWorst;
  void offer(int other, int d) {
    if (d < distance)
      second = distance, distance = d, feature = other;
    else
      second = std::min(second, d);
  }
  bool is_clear(const MatchingOptions& options) const {
    return feature >= 0 && distance <= options.max_distance && distance < options.ratio * second;
  }
};

// Mutually nearest ones among the features under one node.
void match_node(const KeyframeFeatures& first, const std::vector<int>& of_first,
                const KeyframeFeatures& second, const std::vector<int>& of_second,
                const MatchingOptions& options, std::vector<FeatureMatch>& out) {
  std::vector<Nearest> back(of_second.size());
  std::vector<Nearest> there(of_first.size());
  for (std::size_t i = 0; i < of_first.size(); ++i)
    for (std::size_t j = 0; j < of_second.size(); ++j) {
      const int d = hamming(first.descriptors[of_first[i]], second.descriptors[of_second[j]]);
      there[i].offer(static_cast<int>(j), d);
      back[j].offer(static_cast<int>(i), d);
    }
  for (std::size_t i = 0; i < of_first.size(); ++i)
    if (there[i].is_clear(options) && back[there[i].feature].feature == static_cast<int>(i))
      out.push_back({of_first[i], of_second[there[i].feature], there[i].distance});
}

double turn_of(const KeyframeFeatures& first, const KeyframeFeatures& second, const FeatureMatch& match) {
  return std::remainder(second.keypoints[match.second].angle - first.keypoints[match.first].angle, 2 * M_PI);
}

// Both cameras look at the same thing, so all of its features are turned by the same angle: what differs from
// the fullest bins of a histogram is wrong.
void drop_other_turns(const KeyframeFeatures& first, const KeyframeFeatures& second, double tolerance,
                      std::vector<FeatureMatch>& matches) {
  std::array<int, kBins> histogram{};
  for (const FeatureMatch& match : matches) {
    const double turn = turn_of(first, second, match);
    if (std::isfinite(turn))
      ++histogram[static_cast<std::size_t>(std::floor((turn / (2 * M_PI) + 0.5) * kBins)) % kBins];
  }
  int best = 0, most = -1;
  for (int bin = 0; bin < kBins; ++bin) {
    const int count =
        histogram[(bin + kBins - 1) % kBins] + 2 * histogram[bin] + histogram[(bin + 1) % kBins];
    if (count > most) most = count, best = bin;
  }
  const double peak = ((best + 0.5) / kBins - 0.5) * 2 * M_PI;
  std::erase_if(matches, [&](const FeatureMatch& match) {
    const double off = std::abs(std::remainder(turn_of(first, second, match) - peak, 2 * M_PI));
    return !(off <= tolerance * M_PI / 180);
  });
}

}  // namespace

NodeFeatures group_features(const Vocabulary& vocabulary, const KeyframeFeatures& features,
                            const MatchingOptions& options) {
  return vocabulary.group(features.descriptors, std::max(0, vocabulary.levels() - options.node_level));
}

std::vector<FeatureMatch> match_features(const KeyframeFeatures& first, const NodeFeatures& first_nodes,
                                         const KeyframeFeatures& second, const NodeFeatures& second_nodes,
                                         const MatchingOptions& options) {
  std::vector<FeatureMatch> out;
  auto b = second_nodes.nodes.begin();
  for (const auto& [node, features] : first_nodes.nodes) {
    while (b != second_nodes.nodes.end() && b->first < node) ++b;
    if (b == second_nodes.nodes.end()) break;
    if (b->first == node) match_node(first, features, second, b->second, options, out);
  }
  drop_other_turns(first, second, options.turn, out);
  std::sort(out.begin(), out.end(),
            [](const FeatureMatch& x, const FeatureMatch& y) { return x.first < y.first; });
  return out;
}

}  // namespace spslam
