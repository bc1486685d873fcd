// SPDX-License-Identifier: Apache-2.0
#include "context/introduction.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <future>
#include <thread>

namespace {

using rmw_fastrtps::Introduction;
using rmw_fastrtps::is_busy;

using Time = Introduction::Clock::time_point;
constexpr Time kStart{};
constexpr auto kMoment = Introduction::kMoment;
constexpr auto kLongest = Introduction::kLongest;

TEST(Introduction, IsDueAMomentAfterTheLastEndpoint) {
  Introduction introduction(kStart, [] { return false; });
  EXPECT_EQ(introduction.next(), kStart + kMoment);
  introduction.put_off(kStart + kMoment / 2);
  EXPECT_EQ(introduction.next(), kStart + 3 * kMoment / 2);
  EXPECT_FALSE(introduction.is_due(kStart + kMoment));
  EXPECT_TRUE(introduction.is_due(kStart + 3 * kMoment / 2));
}

TEST(Introduction, WaitsForABusyThread) {
  bool busy = true;
  Introduction introduction(kStart, [&] { return busy; });
  EXPECT_FALSE(introduction.is_due(kStart + kMoment));
  EXPECT_EQ(introduction.next(), kStart + 2 * kMoment);
  busy = false;
  EXPECT_TRUE(introduction.is_due(kStart + 2 * kMoment));
}

TEST(Introduction, DoesNotWaitForEver) {
  Introduction introduction(kStart, [] { return true; });
  EXPECT_FALSE(introduction.is_due(kStart + kLongest - std::chrono::nanoseconds(1)));
  EXPECT_TRUE(introduction.is_due(kStart + kLongest + kMoment));
}

TEST(Thread, ThatRunsIsBusy) {
  EXPECT_TRUE(is_busy(gettid()));
}

TEST(Thread, ThatWaitsIsNotBusy) {
  std::promise<pid_t> id;
  std::promise<void> end;
  std::thread thread([&] {
    id.set_value(gettid());
    end.get_future().wait();
  });
  const pid_t waiting = id.get_future().get();
  while (is_busy(waiting)) {
    std::this_thread::yield();
  }
  end.set_value();
  thread.join();
  EXPECT_FALSE(is_busy(waiting)) << "a thread that has ended";
}

}  // namespace
