// SPDX-License-Identifier: Apache-2.0
// Rates, intervals and jitter of callbacks, and the memory that they ask for.
#include <gtest/gtest.h>

#include "tests/unit/analysis/ros2_feed.hpp"

namespace tracing {
namespace {

using testing::Feed;

constexpr std::int64_t kMs = 1'000'000;

void run(Feed& feed, ros2::Handle callback, std::int64_t begin_ns, std::int64_t duration_ns) {
  feed.at(begin_ns)(ros2::CallbackStart{callback, false});
  feed.at(begin_ns + duration_ns)(ros2::CallbackEnd{callback});
}

TEST(CallbackTiming, MeasuresATimerAgainstItsPeriod) {
  Feed feed;
  feed(ros2::RclTimerInit{3, 100 * kMs})(ros2::RclcppTimerCallbackAdded{3, 0xee});
  for (const std::int64_t begin_ms : {1'000, 1'100, 1'205, 1'300, 1'620, 1'700}) {
    run(feed, 0xee, begin_ms * kMs, kMs);
  }
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.callbacks.size(), 1u);
  const CallbackResult& timer = results.callbacks[0];
  EXPECT_DOUBLE_EQ(timer.rate_hz, 5 / 0.7);
  EXPECT_EQ(timer.interval.count, 5u);
  EXPECT_EQ(timer.interval.min_ns, 80 * kMs);
  EXPECT_EQ(timer.interval.max_ns, 320 * kMs);
  EXPECT_EQ(timer.jitter.count, 5u);
  EXPECT_EQ(timer.jitter.min_ns, 0);
  EXPECT_EQ(timer.jitter.p50_ns, 5 * kMs);
  EXPECT_EQ(timer.jitter.max_ns, 220 * kMs);
  EXPECT_EQ(timer.missed, 2u);
}

TEST(CallbackTiming, CountsRunsThatTakeLongerThanThePeriod) {
  Feed feed;
  feed(ros2::RclTimerInit{3, 10 * kMs})(ros2::RclcppTimerCallbackAdded{3, 0xee});
  run(feed, 0xee, 1'000 * kMs, 10 * kMs);
  run(feed, 0xee, 1'020 * kMs, 11 * kMs);
  run(feed, 0xcb, 1'100 * kMs, 50 * kMs);
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.callbacks.size(), 2u);
  EXPECT_EQ(results.callbacks[0].overruns, 0u) << "it belongs to no timer";
  EXPECT_EQ(results.callbacks[1].overruns, 1u);
}

TEST(CallbackTiming, MeasuresNoJitterWithoutAPeriod) {
  Feed feed;
  run(feed, 0xcb, 100, 10);
  run(feed, 0xcb, 300, 10);
  const CallbackResult callback = feed.results().callbacks.at(0);
  EXPECT_EQ(callback.interval.max_ns, 200);
  EXPECT_EQ(callback.jitter.count, 0u);
  EXPECT_EQ(callback.missed, 0u);
  EXPECT_EQ(callback.allocations, std::nullopt);
}

TEST(CallbackTiming, CountsMemoryForTheInnermostCallback) {
  Feed feed;
  feed.allocates(1'000);
  feed(ros2::CallbackStart{0xa, false}).allocates(32).allocates(8);
  feed(ros2::CallbackStart{0xb, false}).allocates(100)(ros2::CallbackEnd{0xb});
  feed.in(71, 99).allocates(5'000);
  feed.in(71, 71).allocates(2)(ros2::CallbackEnd{0xa}).allocates(7);
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.callbacks.size(), 2u);
  EXPECT_EQ(results.callbacks[0].address, 0xau);
  EXPECT_EQ(results.callbacks[0].allocations, 3u);
  EXPECT_EQ(results.callbacks[0].allocated_bytes, 42u);
  EXPECT_EQ(results.callbacks[1].allocations, 1u);
  EXPECT_EQ(results.callbacks[1].allocated_bytes, 100u);
}

TEST(Unmatched, EventsHaveAReason) {
  Feed feed;
  feed(ros2::CallbackEnd{0xa})(ros2::CallbackStart{0xb, false});
  feed(ros2::RmwPublish{4, 9, 778})(ros2::RmwTake{5, 9, 778, true})(ros2::RclcppIntraPublish{6, 9});
  const std::vector<UnmatchedResult> unmatched = feed.results().unmatched;
  std::string text;
  for (const UnmatchedResult& result : unmatched) {
    text += result.event + ": " + result.reason + ": " + std::to_string(result.count) + "\n";
  }
  EXPECT_EQ(text,
            "callback_start: no end: an exception, a killed process, or it ran when the trace ended: 1\n"
            "callback_end: no begin: it ran when the trace began, or the begin was lost: 1\n"
            "rmw_publish: the creation of the publisher is not in the trace: 2\n"
            "rmw_take: the creation of the subscription is not in the trace: 1\n");
}

}  // namespace
}  // namespace tracing
