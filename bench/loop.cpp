// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// spslam_bench_loop: recognizing a place among 1000 keyframes of 1000 features each, and opening a vocabulary
// as big as ORBvoc. Descriptors are like those that the built-in vocabulary was trained on: its words with
// noise.

#include <benchmark/benchmark.h>

#include <filesystem>

#include "spslam/base/random.h"
#include "spslam/loop/keyframe_index.h"

namespace {

using namespace spslam;  // NOLINT

constexpr int kKeyframes = 1000, kFeatures = 1000;

Descriptor noisy(Descriptor descriptor, Random& random) {
  for (int i = 0; i < 12; ++i) descriptor[random.below(4)] ^= std::uint64_t{1} << random.below(64);
  return descriptor;
}

// Some words are much more frequent than others, as in real images.
KeyframeFeatures features_of(const Vocabulary& vocabulary, Random& random) {
  KeyframeFeatures out;
  for (int i = 0; i < kFeatures; ++i) {
    const double where = random.uniform();
    const auto node = static_cast<std::size_t>((vocabulary.nodes() - 1) * where * where * where);
    out.descriptors.push_back(noisy(vocabulary.descriptors()[1 + node], random));
  }
  out.keypoints.resize(kFeatures);
  return out;
}

struct Loop {
  Map map;
  KeyframeIndex index{built_in_vocabulary()};
  KeyframeFeatures present;

  // Each keyframe shares two landmarks with the next, as far as grouping is concerned.
  Loop() {
    Random random(1);
    for (int id = 0; id < kKeyframes; ++id) {
      Keyframe keyframe;
      keyframe.id = {id};
      map.add(std::move(keyframe));
      Landmark landmark;
      landmark.id = {id};
      landmark.host = {id};
      map.add(landmark);
      for (int seen = std::max(0, id - 2); seen <= id; ++seen)
        map.set_sighting({id}, {LandmarkId{seen}, {0, 0, 0}, {1, 1, 1}, 1});
      index.add({id}, features_of(index.vocabulary(), random));
    }
    present = features_of(index.vocabulary(), random);
  }
};

const Loop& loop() {
  static const Loop all;
  return all;
}

void describe_keyframe(benchmark::State& state) {
  const Vocabulary& vocabulary = loop().index.vocabulary();
  for (auto _ : state) benchmark::DoNotOptimize(vocabulary.describe(loop().present.descriptors));
}
BENCHMARK(describe_keyframe)->Unit(benchmark::kMillisecond);

void query_words(benchmark::State& state) {
  const WordVector words = loop().index.vocabulary().describe(loop().present.descriptors);
  for (auto _ : state) benchmark::DoNotOptimize(loop().index.query(words));
}
BENCHMARK(query_words)->Unit(benchmark::kMillisecond);

// All that detection does of a keyframe until candidates are verified.
void detect(benchmark::State& state) {
  for (auto _ : state) {
    const std::vector<Candidate> candidates = loop().index.query(loop().present);
    benchmark::DoNotOptimize(group_candidates(candidates, loop().map));
  }
}
BENCHMARK(detect)->Unit(benchmark::kMillisecond);

void add_and_erase(benchmark::State& state) {
  KeyframeIndex index = loop().index;
  for (auto _ : state) {
    index.add({kKeyframes}, loop().present);
    index.erase({kKeyframes});
  }
}
BENCHMARK(add_and_erase)->Unit(benchmark::kMillisecond);

// Ten branches at each of six levels, 1 111 111 nodes: a little more than ORBvoc has.
VocabularyTree full_tree() {
  constexpr std::uint32_t kNodes = 1111111, kInner = 111111;
  VocabularyTree tree;
  tree.branching = 10;
  Random random(2);
  for (std::uint32_t node = 0; node < kNodes; ++node) {
    tree.first_child.push_back(std::min(10 * node + 1, kNodes));
    tree.weights.push_back(node < kInner ? 0.0F : 1.0F);
    Descriptor& descriptor = tree.descriptors.emplace_back();
    for (std::uint64_t& part : descriptor) part = (std::uint64_t{random.next()} << 32U) | random.next();
  }
  tree.first_child.push_back(kNodes);
  return tree;
}

void open_file(benchmark::State& state, const Vocabulary& vocabulary) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() / "spslam_bench_loop.spv";
  vocabulary.save(path);
  for (auto _ : state) benchmark::DoNotOptimize(Vocabulary::open(path).words());
  state.counters["MB"] = static_cast<double>(vocabulary.bytes().size()) / 1e6;
  std::filesystem::remove(path);
}
void open_ours(benchmark::State& state) {
  open_file(state, built_in_vocabulary());
}
void open_as_big_as_orbvoc(benchmark::State& state) {
  open_file(state, Vocabulary(full_tree()));
}
BENCHMARK(open_ours)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(open_as_big_as_orbvoc)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
