// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "launch_trace_testing/expectations.hpp"
#include "tests/unit/testing/traces.hpp"

namespace launch_trace_testing {
namespace {

using namespace std::chrono_literals;

TEST(ExpectedPeriod, AllowsATolerance) {
  const EventQuery scans = event("ros2:rcl_publish").in_process("sensor");
  EXPECT_TRUE(expect_period(example_trace(20), scans, around(10ms, 1ms)));
  // Every tenth cycle is 1 ms late.
  EXPECT_TRUE(expect_period(example_trace(20), scans, around(10ms, 100us, 0.8)));
  EXPECT_EQ(failure(expect_period(example_trace(20), scans, around(10ms, 100us))),
            R"(expected: from each 'ros2:rcl_publish' in process 'sensor' to the next one 9.900 ms to 10.100 ms
     saw: 3 of 19 outside; least 9.000 ms, median 10.000 ms, most 11.000 ms
worst:
  +0.111098000  sensor[101]  ros2:rcl_publish  [11.000 ms] publisher_handle=0x103 message=0x10b
  +0.120098000  sensor[101]  ros2:rcl_publish  [9.000 ms] publisher_handle=0x103 message=0x10b
  +0.211098000  sensor[101]  ros2:rcl_publish  [11.000 ms] publisher_handle=0x103 message=0x10b)");
}

TEST(ExpectedPeriod, NeedsTwoEvents) {
  EXPECT_EQ(failure(expect_period(ping_pong_trace(), event("ros2:rcl_timer_init"), at_most(1s))),
            R"(expected: from each 'ros2:rcl_timer_init' to the next one at most 1000.000 ms
     saw: none
  +0.006800000  ping[71]  ros2:rcl_timer_init  [the only one] timer_handle=0x107 period=500000000)");
  EXPECT_EQ(failure(expect_period(ping_pong_trace(), event("ros2:rcl_timer_inti"), at_most(1s))),
            R"(expected: from each 'ros2:rcl_timer_inti' to the next one at most 1000.000 ms
     saw: none
the trace has no event of this name; did you mean 'ros2:rcl_timer_init' (1 of them)?)");
}

TEST(ExpectedDuration, PairsEventsOfOneThread) {
  const EventQuery start = event("ros2:callback_start").in_process("filter");
  const EventQuery end = event("ros2:callback_end");
  EXPECT_TRUE(expect_duration(example_trace(20), start, end, at_most(4ms)));
  EXPECT_EQ(
      failure(expect_duration(example_trace(20), start, end, at_most(1ms))),
      R"(expected: from each 'ros2:callback_start' in process 'filter' to the next 'ros2:callback_end' of its thread at most 1.000 ms
     saw: 1 of 20 outside; least 0.400 ms, median 0.400 ms, most 4.000 ms
worst:
  +0.211301000  filter[102]  ros2:callback_start  [4.000 ms] callback=0x109 is_intra_process=0)");
}

TEST(ExpectedCallbackDuration, NamesTheWorst) {
  EXPECT_TRUE(expect_callback_duration(example_trace(20), {.node = "/filter"}, at_most(1ms, 0.95)));
  EXPECT_TRUE(
      expect_callback_duration(example_trace(20), {.node = "/sensor", .timers_only = true}, around(200us, 1us)));
  EXPECT_EQ(failure(expect_callback_duration(example_trace(20), {.node = "/filter", .topic = "/scan"}, at_most(1ms))),
            R"(expected: each callback of node '/filter' of topic '/scan' takes at most 1.000 ms
     saw: 1 of 20 outside; least 0.400 ms, median 0.400 ms, most 4.000 ms
worst:
  +0.211301000      4.000 ms  /filter topic /scan Filter::on_scan(sensor_msgs::msg::LaserScan const&))");
}

TEST(ExpectedCallbackDuration, ListsTheCallbacksWhenNoneIsMeant) {
  EXPECT_EQ(failure(expect_callback_duration(example_trace(2), {.symbol = "on_image"}, at_most(1ms))),
            R"(expected: each callback with 'on_image' in its name takes at most 1.000 ms
     saw: none
the callbacks of the trace:
        2 /display topic /points Display::on_points(sensor_msgs::msg::PointCloud2 const&)
        2 /filter topic /scan Filter::on_scan(sensor_msgs::msg::LaserScan const&)
        2 /sensor timer of 10.000 ms Sensor::on_timer())");
}

TEST(ExpectedCallbackPeriod, LooksAtEachCallbackAlone) {
  EXPECT_TRUE(expect_callback_period(example_trace(9), {}, around(10ms, 1us)));
  EXPECT_TRUE(expect_callback_period(example_trace(9), {.timers_only = true}, around(10ms, 1us)));
  EXPECT_FALSE(expect_callback_period(example_trace(20), {.timers_only = true}, around(10ms, 1us)));
}

}  // namespace
}  // namespace launch_trace_testing
