// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/scheduler.hpp"

#include <gtest/gtest.h>

#include "tests/unit/twin/small_system.hpp"

namespace tracing::twin {
namespace {

using testing::kMs;

// When each thread has done its work.
std::vector<std::int64_t> ends(Scheduler& scheduler, std::size_t threads) {
  std::vector<std::int64_t> ends(threads);
  while (const auto next = scheduler.next_ns()) {
    for (const std::size_t thread : scheduler.advance(*next)) {
      ends[thread] = *next;
    }
    scheduler.settle();
  }
  return ends;
}

TEST(Scheduler, OrdinaryThreadsGetEqualParts) {
  Scheduler scheduler(1);
  for (int count = 0; count < 3; ++count) {
    scheduler.add_work(scheduler.add_thread(0), 6 * kMs, 0);
  }
  EXPECT_EQ(ends(scheduler, 3), (std::vector<std::int64_t>{12 * kMs, 15 * kMs, 18 * kMs}));
}

TEST(Scheduler, ThreeThreadsOnTwoProcessors) {
  Scheduler scheduler(2);
  for (int count = 0; count < 3; ++count) {
    scheduler.add_work(scheduler.add_thread(0), 2 * kMs, 0);
  }
  EXPECT_EQ(ends(scheduler, 3), (std::vector<std::int64_t>{2 * kMs, 2 * kMs, 4 * kMs}));
}

TEST(Scheduler, AFifoThreadRunsToItsEnd) {
  Scheduler scheduler(1);
  scheduler.add_work(scheduler.add_thread(0), 4 * kMs, 0);
  scheduler.add_work(scheduler.add_thread(10), 20 * kMs, 0);
  scheduler.add_work(scheduler.add_thread(20), 5 * kMs, 0);
  EXPECT_EQ(ends(scheduler, 3), (std::vector<std::int64_t>{29 * kMs, 25 * kMs, 5 * kMs}));
}

TEST(Scheduler, AThreadThatWakesUpPreemptsOneThatHasRunLong) {
  Scheduler scheduler(1);
  const std::size_t busy = scheduler.add_thread(0);
  const std::size_t sleeper = scheduler.add_thread(0);
  scheduler.add_work(busy, 20 * kMs, 0);
  scheduler.advance(10 * kMs);
  scheduler.add_work(sleeper, kMs, 10 * kMs);
  EXPECT_EQ(ends(scheduler, 2), (std::vector<std::int64_t>{21 * kMs, 11 * kMs}));
}

TEST(Scheduler, GoingOnKeepsTheProcessor) {
  Scheduler scheduler(1);
  const std::size_t first = scheduler.add_thread(0);
  const std::size_t second = scheduler.add_thread(0);
  scheduler.add_work(first, kMs, 0);
  scheduler.add_work(second, kMs, 0);
  EXPECT_EQ(scheduler.advance(kMs), std::vector<std::size_t>{first});
  scheduler.go_on(first, kMs);
  scheduler.settle();
  EXPECT_EQ(ends(scheduler, 2), (std::vector<std::int64_t>{2 * kMs, 3 * kMs}));
}

}  // namespace
}  // namespace tracing::twin
