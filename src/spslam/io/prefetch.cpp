// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/io/prefetch.h"

#include <algorithm>
#include <chrono>

#include "spslam/base/error.h"

namespace spslam {

Prefetcher::Prefetcher(const Dataset& dataset, int begin, int end, int ahead)
    : dataset_(dataset), ahead_(static_cast<std::size_t>(std::max(1, ahead))) {
  end = std::min(end, dataset.size());
  if (begin < 0 || begin >= end)
    throw OptionError("frames " + std::to_string(begin) + " to " + std::to_string(end) + " are none of the " +
                      std::to_string(dataset.size()) +
                      " there are; give a start from 0 on that is before the end");
  thread_ = std::thread([this, begin, end] { work(begin, end); });
}

Prefetcher::~Prefetcher() {
  close();
  thread_.join();
}

void Prefetcher::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  ready_.clear();
  changed_.notify_all();
}

std::optional<LoadedFrame> Prefetcher::next() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return closed_ || finished_ || !ready_.empty(); });
  if (closed_) return std::nullopt;
  if (ready_.empty()) {
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
    return std::nullopt;
  }
  LoadedFrame frame = std::move(ready_.front());
  ready_.pop_front();
  changed_.notify_all();
  return frame;
}

bool Prefetcher::put(LoadedFrame frame) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return closed_ || ready_.size() < ahead_; });
  if (closed_) return false;
  ready_.push_back(std::move(frame));
  changed_.notify_all();
  return true;
}

void Prefetcher::work(int begin, int end) {
  std::exception_ptr error;
  try {
    for (int index = begin; index < end; ++index) {
      const auto start = std::chrono::steady_clock::now();
      LoadedFrame frame{index, dataset_.load(index)};
      frame.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      if (!put(std::move(frame))) return;
    }
  } catch (...) {
    error = std::current_exception();
  }
  const std::lock_guard lock(mutex_);
  error_ = error;
  finished_ = true;
  changed_.notify_all();
}

}  // namespace spslam
