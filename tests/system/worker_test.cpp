// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/system/worker.h"

#include <gtest/gtest.h>

#include <new>

#include "spslam/system/bounded_queue.h"

namespace spslam {
namespace {

TEST(Worker, DoesItsWork) {
  int done = 0;
  bool failed = false;
  Worker worker;
  worker.start([&] { done = 7; }, [&] { failed = true; });
  worker.join();
  EXPECT_EQ(done, 7);
  EXPECT_FALSE(failed || worker.has_failed());
  EXPECT_NO_THROW(worker.rethrow());
}

// Who waits for it is woken, and learns what happened.
TEST(Worker, ItsFailureIsThrownToWhoAsks) {
  BoundedQueue<int> results(1);
  Worker worker;
  worker.start([] { throw std::bad_alloc(); }, [&] { results.close(); });
  EXPECT_FALSE(results.pop());
  EXPECT_TRUE(worker.has_failed());
  EXPECT_THROW(worker.rethrow(), std::bad_alloc);
  EXPECT_THROW(worker.rethrow(), std::bad_alloc);  // whoever else asks learns it too
  worker.join();
}

TEST(Worker, OneThatWasNotStartedHasNothingToSay) {
  Worker worker;
  EXPECT_FALSE(worker.is_started());
  EXPECT_NO_THROW(worker.rethrow());
  worker.join();
}

}  // namespace
}  // namespace spslam
