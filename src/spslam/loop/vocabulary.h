// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Bags of binary words: a tree of descriptors turns the features of an image into words, and images are
// compared by the words they share (Nister and Stewenius, "Scalable recognition with a vocabulary tree",
// 2006; Galvez-Lopez and Tardos, "Bags of binary words for fast place recognition in image sequences", 2012).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "spslam/base/options.h"
#include "spslam/features/types.h"

namespace spslam {

// A word is a leaf of the tree, called by the number of its node: 0 <= word < Vocabulary::nodes().
using WordId = std::uint32_t;

// The words of an image, ascending, with their shares of it by term frequency and inverse document frequency;
// the shares are positive and add up to 1. Empty if the image has no word that says anything.
struct WordVector {
  std::vector<std::pair<WordId, float>> words;

  bool empty() const { return words.empty(); }
  friend bool operator==(const WordVector&, const WordVector&) = default;
};

// How alike two images are: 1 - |a - b|_1 / 2, which is 0 if they share no word and 1 if they have the same.
// Symmetric to the last bit.
double similarity(const WordVector& a, const WordVector& b);

// The features of an image by the node of the tree above their words, both ascending: what matches between
// two images is under the same node of both ("direct index" of the 2012 paper).
struct NodeFeatures {
  std::vector<std::pair<std::uint32_t, std::vector<int>>> nodes;

  friend bool operator==(const NodeFeatures&, const NodeFeatures&) = default;
};

struct VocabularyOptions {
  int branching = 10;
  int levels = 5;
  int iterations = 12;
  int seed = 1;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.branching, {"branching", "", "children of a node of the tree", 2, 20});
    visit(self.levels,
          {"levels", "", "levels of the tree below its root; it has branching^levels words or less", 1, 10});
    visit(self.iterations,
          {"iterations", "", "rounds of moving descriptors between a node's children, at most", 1, 1000});
    visit(self.seed, {"seed", "", "seed of the first choice of children", 0, 1e9});
  }
};

// A tree as its maker has it. Children of a node follow each other, all nodes are in breadth-first order.
struct VocabularyTree {
  std::vector<Descriptor> descriptors;  // of each node; the root's (node 0) means nothing
  std::vector<float> weights;           // of each node: ln(images / images with the word), 0 within the tree
  std::vector<std::uint32_t>
      first_child;                // of each node and one more: children of i are [first(i), first(i+1))
  int branching = 0, levels = 0;  // most children of a node, deepest level of a word
  int images = 0;                 // it was trained on, 0 if not known
};

// Immutable; copies share its memory. Const functions may be called from several threads.
class Vocabulary {
 public:
  Vocabulary() = default;  // empty: there are no words
  // Throws InputError if it is no tree.
  explicit Vocabulary(const VocabularyTree& tree);

  // Clusters the descriptors of all images into a tree by k-majority, and weighs words by the images that
  // have them. The same bits for the same descriptors and options at any number of threads. Throws
  // OptionError, and InputError if fewer than two images have features.
  static Vocabulary train(std::span<const std::vector<Descriptor>> images,
                          const VocabularyOptions& options = {});

  // Maps a file into memory (vocabulary_file.cpp has its layout). Throws InputError that says what is wrong
  // with it and what to do.
  static Vocabulary open(const std::filesystem::path& path);
  // The content of such a file, copied; name stands for it in messages.
  static Vocabulary parse(std::span<const std::byte> file, const std::string& name);
  // The file appears whole, or the one that was there before stays. Throws OutputError.
  void save(const std::filesystem::path& path) const;
  // The content of a file.
  std::span<const std::byte> bytes() const { return bytes_; }

  // The text format of DBoW2 (vocabulary_text.cpp): one line a node. Scores are always L1, whatever it says.
  static Vocabulary read_dbow2_text(const std::filesystem::path& path);
  static Vocabulary parse_dbow2_text(std::string_view text, const std::string& name);
  void write_dbow2_text(const std::filesystem::path& path) const;

  bool empty() const { return words_ == 0; }
  int words() const { return words_; }
  int nodes() const { return static_cast<int>(descriptors_.size()); }
  int branching() const { return branching_; }
  int levels() const { return levels_; }
  int images() const { return images_; }

  // The nearest word, or 0 (the root) of an empty vocabulary.
  WordId word(const Descriptor& descriptor) const;
  WordVector describe(std::span<const Descriptor> descriptors) const;
  // By the node `levels_up` levels above the deepest one (a word that is higher up stands for itself), so
  // levels_up = 0 groups by word and levels() puts all under the root.
  NodeFeatures group(std::span<const Descriptor> descriptors, int levels_up) const;

  // Node by node, for writers and tests.
  std::span<const Descriptor> descriptors() const { return descriptors_; }
  std::span<const float> weights() const { return weights_; }
  std::span<const std::uint32_t> first_child() const { return first_child_; }

 private:
  friend Vocabulary built_in_vocabulary();
  Vocabulary(std::shared_ptr<const void> owner, std::span<const std::byte> bytes, const std::string& name);
  std::uint32_t descend(const Descriptor& descriptor, int steps) const;

  std::shared_ptr<const void> owner_;  // of the memory behind what follows
  std::span<const std::byte> bytes_;
  std::span<const Descriptor> descriptors_;
  std::span<const float> weights_;
  std::span<const std::uint32_t> first_child_;
  int words_ = 0, branching_ = 0, levels_ = 0, images_ = 0;
};

// The vocabulary that comes with the library: config/vocabulary.spv, linked into it, so that it needs no
// file. scripts/train_vocabulary.sh made it.
Vocabulary built_in_vocabulary();

}  // namespace spslam
