// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Hierarchical clustering of binary descriptors: each node is split into children by k-majority (Grana,
// Borghesani, Manfredi and Cucchiara, "A fast approach for integrating ORB descriptors in the bag of words
// model", 2013), begun as k-means++ does (Arthur and Vassilvitskii, 2007).

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "spslam/base/error.h"
#include "spslam/base/random.h"
#include "spslam/base/sort_unique.h"
#include "spslam/loop/vocabulary.h"

namespace spslam {
namespace {

using Indices = std::span<std::uint32_t>;

// How many of the descriptors have each bit set. Eight bits at a time are spread over the bytes of a word,
// and the bytes are emptied before they overflow.
class BitCounts {
 public:
  void add(const Descriptor& descriptor) {
    for (int i = 0; i < 32; ++i) bytes_[i] += spread((descriptor[i / 8] >> (8 * (i % 8))) & 0xFFU);
    ++count_;
    if (++pending_ == 255) flush();
  }
  // The bits that most of them have; where it is a draw, those of `before`.
  Descriptor majority(const Descriptor& before) {
    flush();
    Descriptor out = {};
    for (int bit = 0; bit < 256; ++bit) {
      const std::uint64_t old = (before[bit / 64] >> (bit % 64)) & 1U,
                          twice = 2 * std::uint64_t{counts_[bit]};
      const std::uint64_t set = twice == count_ ? old : std::uint64_t{twice > count_};
      out[bit / 64] |= set << (bit % 64);
    }
    return out;
  }
  bool empty() const { return count_ == 0; }

 private:
  // Bit i to the lowest bit of byte i: copies of the byte, one bit of each kept and brought to 0 or 1.
  static std::uint64_t spread(std::uint64_t byte) {
    const std::uint64_t kept = (byte * 0x0101010101010101U) & 0x8040201008040201U;
    return ((kept + 0x7F7F7F7F7F7F7F7FU) >> 7U) & 0x0101010101010101U;
  }
  void flush() {
    for (int bit = 0; bit < 256; ++bit)
      counts_[bit] += static_cast<std::uint32_t>((bytes_[bit / 8] >> (8 * (bit % 8))) & 0xFFU);
    bytes_ = {};
    pending_ = 0;
  }

  std::array<std::uint64_t, 32> bytes_ = {};
  std::array<std::uint32_t, 256> counts_ = {};
  std::uint64_t count_ = 0;
  int pending_ = 0;
};

struct Split {
  std::vector<Descriptor> centres;
  std::vector<std::size_t> ends;  // of each centre's descriptors, in the reordered indices
};

// Splits the descriptors of one node.
class Splitter {
 public:
  Splitter(std::span<const Descriptor> all, Indices own, const VocabularyOptions& options, std::uint64_t seed)
      : all_(all), own_(own), options_(options), random_(seed), nearest_(own.size()), label_(own.size(), 0) {}

  // Reorders the indices by centre. No centre if all descriptors are the same.
  Split run() {
    choose_centres();
    if (centres_.size() < 2) return {};
    for (int i = 0; i < options_.iterations && assign(); ++i) move_centres();
    assign();
    return reorder();
  }

 private:
  // Each with a probability that grows with the square of its distance from those chosen already: never one
  // that is there already, so there are fewer than asked for if fewer are different.
  void choose_centres() {
    std::fill(nearest_.begin(), nearest_.end(), 256U * 256U);
    std::size_t next = random_.below(static_cast<std::uint32_t>(own_.size()));
    while (true) {
      centres_.push_back(all_[own_[next]]);
      if (static_cast<int>(centres_.size()) == options_.branching) return;
      const std::uint64_t sum = lower_distances();
      if (sum == 0) return;
      auto left = static_cast<std::uint64_t>(random_.uniform() * static_cast<double>(sum));
      for (next = 0; next + 1 < own_.size() && left >= nearest_[next]; ++next) left -= nearest_[next];
      while (nearest_[next] == 0) --next;  // rounding may end on one that was chosen
    }
  }
  std::uint64_t lower_distances() {
    const Descriptor& centre = centres_.back();
    in_parallel([&](std::size_t i) {
      const auto distance = static_cast<std::uint32_t>(hamming(all_[own_[i]], centre));
      nearest_[i] = std::min(nearest_[i], distance * distance);
    });
    return std::accumulate(nearest_.begin(), nearest_.end(), std::uint64_t{0});
  }
  // Gives each descriptor to its nearest centre, the first of equals; false if nothing changed.
  bool assign() {
    std::vector<std::uint8_t> before = label_;
    in_parallel([&](std::size_t i) {
      int nearest = 257;
      for (std::size_t c = 0; c < centres_.size(); ++c) {
        const int distance = hamming(all_[own_[i]], centres_[c]);
        if (distance < nearest) nearest = distance, label_[i] = static_cast<std::uint8_t>(c);
      }
    });
    return before != label_;
  }
  void move_centres() {
    std::vector<BitCounts> counts(centres_.size());
    for (std::size_t i = 0; i < own_.size(); ++i) counts[label_[i]].add(all_[own_[i]]);
    for (std::size_t c = 0; c < centres_.size(); ++c)
      if (!counts[c].empty()) centres_[c] = counts[c].majority(centres_[c]);
  }
  // Centres without a descriptor are left out.
  Split reorder() {
    Split out;
    std::vector<std::uint32_t> sorted;
    for (std::size_t c = 0; c < centres_.size(); ++c) {
      const std::size_t begin = sorted.size();
      for (std::size_t i = 0; i < own_.size(); ++i)
        if (label_[i] == c) sorted.push_back(own_[i]);
      if (sorted.size() == begin) continue;
      out.centres.push_back(centres_[c]);
      out.ends.push_back(sorted.size());
    }
    if (out.centres.size() < 2) return {};
    std::copy(sorted.begin(), sorted.end(), own_.begin());
    return out;
  }
  template <class F>
  void in_parallel(F f) const {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, own_.size(), 2048), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) f(i);
    });
  }

  std::span<const Descriptor> all_;
  Indices own_;
  const VocabularyOptions& options_;
  Random random_;
  std::vector<Descriptor> centres_;
  std::vector<std::uint32_t> nearest_;  // squared distance to the nearest centre
  std::vector<std::uint8_t> label_;     // of the centre
};

// One level after the other, so that the nodes come in breadth-first order.
VocabularyTree grow(std::span<const Descriptor> all, const VocabularyOptions& options) {
  std::vector<std::uint32_t> order(all.size());
  std::iota(order.begin(), order.end(), 0U);
  VocabularyTree tree{{Descriptor{}}, {}, {}, options.branching, options.levels, 0};
  std::vector<Indices> level = {order};
  for (int depth = 0; !level.empty(); ++depth) {
    std::vector<Split> splits(level.size());
    const std::uint64_t first = tree.first_child.size();
    const auto seed = static_cast<std::uint64_t>(options.seed) << 32U;
    if (depth < options.levels)
      tbb::parallel_for(std::size_t{0}, level.size(), [&](std::size_t i) {
        if (level[i].size() > 1) splits[i] = Splitter(all, level[i], options, seed + first + i).run();
      });
    std::vector<Indices> next;
    for (std::size_t i = 0; i < level.size(); ++i) {
      tree.first_child.push_back(static_cast<std::uint32_t>(tree.descriptors.size()));
      std::size_t begin = 0;
      for (std::size_t c = 0; c < splits[i].centres.size(); begin = splits[i].ends[c++]) {
        tree.descriptors.push_back(splits[i].centres[c]);
        next.push_back(level[i].subspan(begin, splits[i].ends[c] - begin));
      }
    }
    level = std::move(next);
  }
  tree.first_child.push_back(static_cast<std::uint32_t>(tree.descriptors.size()));
  tree.weights.assign(tree.descriptors.size(), 0);
  return tree;
}

// Inverse document frequency: ln(images / images that have the word).
void weigh(VocabularyTree& tree, std::span<const std::vector<Descriptor>> images) {
  const Vocabulary unweighted(tree);
  std::vector<std::vector<WordId>> words(images.size());
  tbb::parallel_for(std::size_t{0}, images.size(), [&](std::size_t i) {
    for (const Descriptor& descriptor : images[i]) words[i].push_back(unweighted.word(descriptor));
    sort_unique(words[i]);
  });
  std::vector<int> having(tree.descriptors.size(), 0);
  for (const std::vector<WordId>& of_image : words)
    for (const WordId word : of_image) ++having[word];
  for (std::size_t node = 0; node < tree.weights.size(); ++node)
    if (tree.first_child[node] == tree.first_child[node + 1])
      tree.weights[node] = static_cast<float>(std::log(double(tree.images) / std::max(1, having[node])));
}

}  // namespace

Vocabulary Vocabulary::train(std::span<const std::vector<Descriptor>> images,
                             const VocabularyOptions& options) {
  check_options(options);
  std::vector<Descriptor> all;
  int with_features = 0;
  for (const std::vector<Descriptor>& image : images) {
    all.insert(all.end(), image.begin(), image.end());
    with_features += !image.empty();
  }
  if (with_features < 2)
    throw InputError(
        "a vocabulary needs at least two images with features, better thousands, of different "
        "places; there are " +
        std::to_string(with_features));
  VocabularyTree tree = grow(all, options);
  if (tree.descriptors.size() < 2)
    throw InputError("a vocabulary needs features that differ; all of these are the same");
  tree.images = with_features;
  weigh(tree, images);
  return Vocabulary(tree);
}

}  // namespace spslam
