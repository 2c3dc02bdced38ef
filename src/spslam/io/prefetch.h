// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Decodes frames ahead on a thread of its own, in order, a few at a time.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <limits>
#include <mutex>
#include <optional>
#include <thread>

#include "spslam/io/dataset.h"

namespace spslam {

struct LoadedFrame {
  int index = 0;  // in the dataset
  StereoFrame pair;
  double seconds = 0;  // that reading, decoding and rectifying it took
};

class Prefetcher {
 public:
  // Frames begin .. end-1 (end is cut to the dataset's size); at most `ahead` wait decoded. The dataset must
  // outlive this. Throws OptionError if begin is negative or not before end.
  explicit Prefetcher(const Dataset& dataset, int begin = 0, int end = std::numeric_limits<int>::max(),
                      int ahead = 4);
  ~Prefetcher();  // closes and joins
  Prefetcher(const Prefetcher&) = delete;
  Prefetcher& operator=(const Prefetcher&) = delete;

  // The next frame, as soon as there is one; nothing after the last or after close(). What load() threw is
  // thrown here, after the frames before it; then nothing follows.
  std::optional<LoadedFrame> next();
  // Ends it at once from any thread: next() gives nothing more, whoever waits in it is woken.
  void close();

 private:
  void work(int begin, int end);
  bool put(LoadedFrame frame);  // false once closed

  const Dataset& dataset_;
  const std::size_t ahead_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<LoadedFrame> ready_;  // these four: under mutex_
  std::exception_ptr error_;
  bool finished_ = false;
  bool closed_ = false;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace spslam
