// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/loop/vocabulary.h"

#include <algorithm>

namespace spslam {
namespace {

// How often each of the numbers occurs, ascending; sorts them.
template <class F>
void for_each_run(std::vector<std::uint32_t>& numbers, F f) {
  std::sort(numbers.begin(), numbers.end());
  for (auto begin = numbers.begin(); begin != numbers.end();) {
    const auto end = std::upper_bound(begin, numbers.end(), *begin);
    f(*begin, static_cast<int>(end - begin));
    begin = end;
  }
}

}  // namespace

double similarity(const WordVector& a, const WordVector& b) {
  // With shares that add up to 1, 1 - |a - b|_1 / 2 is the sum of the smaller ones.
  double sum = 0;
  auto at = b.words.begin();
  for (const auto& [word, share] : a.words) {
    while (at != b.words.end() && at->first < word) ++at;
    if (at != b.words.end() && at->first == word) sum += std::min(share, at->second);
  }
  return std::min(sum, 1.0);
}

std::uint32_t Vocabulary::descend(const Descriptor& descriptor, int steps) const {
  std::uint32_t node = 0;
  for (; steps > 0; --steps) {
    const std::uint32_t begin = first_child_[node], end = first_child_[node + 1];
    if (begin == end) break;
    int nearest = 257;
    for (std::uint32_t child = begin; child < end; ++child) {
      const int distance = hamming(descriptor, descriptors_[child]);
      if (distance < nearest) nearest = distance, node = child;
    }
  }
  return node;
}

WordId Vocabulary::word(const Descriptor& descriptor) const {
  return empty() ? 0 : descend(descriptor, levels_);
}

WordVector Vocabulary::describe(std::span<const Descriptor> descriptors) const {
  if (empty()) return {};
  std::vector<std::uint32_t> words;
  words.reserve(descriptors.size());
  for (const Descriptor& descriptor : descriptors) words.push_back(descend(descriptor, levels_));
  WordVector out;
  double sum = 0;
  // The term frequency's denominator, the number of features, falls out when the sum is made 1.
  for_each_run(words, [&](WordId word, int count) {
    const float share = static_cast<float>(count) * weights_[word];
    if (!(share > 0)) return;
    out.words.emplace_back(word, share);
    sum += share;
  });
  for (auto& [word, share] : out.words) share = static_cast<float>(share / sum);
  // A weight of next to nothing beside one that counts may have no share that a float can hold.
  std::erase_if(out.words, [](const auto& word) { return !(word.second > 0); });
  return out;
}

NodeFeatures Vocabulary::group(std::span<const Descriptor> descriptors, int levels_up) const {
  std::vector<std::pair<std::uint32_t, int>> pairs;
  pairs.reserve(descriptors.size());
  const int steps = std::clamp(levels_ - levels_up, 0, levels_);
  for (const Descriptor& descriptor : descriptors)
    pairs.emplace_back(empty() ? 0 : descend(descriptor, steps), static_cast<int>(pairs.size()));
  std::sort(pairs.begin(), pairs.end());
  NodeFeatures out;
  for (const auto& [node, feature] : pairs) {
    if (out.nodes.empty() || out.nodes.back().first != node) out.nodes.push_back({node, {}});
    out.nodes.back().second.push_back(feature);
  }
  return out;
}

}  // namespace spslam
