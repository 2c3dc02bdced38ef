// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// A thread that does one piece of work. What the work throws, as std::bad_alloc, does not end the process: it
// is kept and thrown again where somebody asks.
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <thread>

namespace spslam {

class Worker {
 public:
  Worker() = default;
  // if_failed: called from the thread after a failure, to wake those who wait for it.
  void start(std::function<void()> work, std::function<void()> if_failed) {
    thread_ = std::thread([this, work = std::move(work), if_failed = std::move(if_failed)] {
      try {
        work();
      } catch (...) {
        failure_ = std::current_exception();
        has_failed_ = true;
        if_failed();
      }
    });
  }
  bool is_started() const { return thread_.joinable(); }
  bool has_failed() const { return has_failed_; }
  void rethrow() const {
    if (has_failed_) std::rethrow_exception(failure_);
  }
  void join() {
    if (thread_.joinable()) thread_.join();
  }

 private:
  std::exception_ptr failure_;  // written before has_failed_, read after it
  std::atomic<bool> has_failed_ = false;
  std::thread thread_;
};

}  // namespace spslam
