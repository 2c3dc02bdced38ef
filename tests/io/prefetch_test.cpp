// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/io/prefetch.h"

#include <gtest/gtest.h>

#include <atomic>

#include "spslam/base/error.h"

namespace spslam {
namespace {

// Frames without images that count how many were asked for.
class CountingDataset : public Dataset {
 public:
  explicit CountingDataset(int size, int bad = -1) : size_(size), bad_(bad) {}

  const StereoRig& rig() const override { return rig_; }
  int size() const override { return size_; }
  double timestamp(int index) const override { return index; }
  StereoFrame load(int index) const override {
    ++loaded;
    if (index == bad_) throw InputError("frame went up in smoke");
    StereoFrame frame;
    frame.timestamp = index;
    return frame;
  }
  const std::optional<Trajectory>& ground_truth() const override { return truth_; }
  bool planar_ground_truth() const override { return false; }
  int unpaired() const override { return 0; }
  std::string description() const override { return "counting"; }
  const std::vector<std::string>& warnings() const override { return warnings_; }

  mutable std::atomic<int> loaded = 0;

 private:
  int size_, bad_;
  StereoRig rig_;
  std::optional<Trajectory> truth_;
  std::vector<std::string> warnings_;
};

std::vector<int> indices(Prefetcher& frames) {
  std::vector<int> all;
  while (const std::optional<LoadedFrame> frame = frames.next()) {
    EXPECT_EQ(frame->pair.timestamp, frame->index);
    all.push_back(frame->index);
  }
  return all;
}

TEST(Prefetcher, GivesEveryFrameInOrder) {
  const CountingDataset dataset(100);
  Prefetcher frames(dataset);
  const std::vector<int> all = indices(frames);
  ASSERT_EQ(all.size(), 100u);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(all[static_cast<std::size_t>(i)], i);
  EXPECT_FALSE(frames.next()) << "and then nothing, again and again";
}

TEST(Prefetcher, GivesARange) {
  const CountingDataset dataset(10);
  Prefetcher middle(dataset, 3, 6), rest(dataset, 8);
  EXPECT_EQ(indices(middle), (std::vector<int>{3, 4, 5}));
  EXPECT_EQ(indices(rest), (std::vector<int>{8, 9}));
  EXPECT_THROW(Prefetcher(dataset, 10), OptionError);
  EXPECT_THROW(Prefetcher(dataset, -1), OptionError);
  EXPECT_THROW(Prefetcher(dataset, 5, 5), OptionError);
}

TEST(Prefetcher, DecodesNoMoreThanItMay) {
  const CountingDataset dataset(1000);
  {
    Prefetcher frames(dataset, 0, 1000, 3);
    for (int taken = 1; taken <= 20; ++taken) {
      ASSERT_TRUE(frames.next());
      EXPECT_LE(dataset.loaded, taken + 3 + 1) << "three wait, one is being decoded";
    }
  }  // destroyed while it works
  EXPECT_LE(dataset.loaded, 20 + 3 + 1);
}

TEST(Prefetcher, CloseWakesWhoeverWaits) {
  const CountingDataset dataset(1000);
  Prefetcher frames(dataset, 0, 1000, 1);
  std::thread consumer([&] {
    while (frames.next()) {
    }
  });
  frames.close();
  consumer.join();
  EXPECT_FALSE(frames.next());
}

TEST(Prefetcher, CarriesErrorsAfterTheFramesBefore) {
  const CountingDataset dataset(10, 4);
  Prefetcher frames(dataset);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(frames.next()->index, i);
  EXPECT_THROW(frames.next(), InputError);
  EXPECT_FALSE(frames.next());
  EXPECT_EQ(dataset.loaded, 5);
}

}  // namespace
}  // namespace spslam
