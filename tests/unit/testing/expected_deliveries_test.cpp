// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "launch_trace_testing/expectations.hpp"
#include "tests/unit/testing/traces.hpp"

namespace launch_trace_testing {
namespace {

using namespace std::chrono_literals;

TEST(ExpectedDelivered, CountsMessagesThatReachACallback) {
  const Trace trace = example_trace(50);
  EXPECT_TRUE(expect_delivered(trace, {.topic = "/scan"}, exactly(50)));
  EXPECT_TRUE(
      expect_delivered(trace, {.topic = "/scan", .publisher = "/sensor", .subscriber = "/filter"}, exactly(50)));
  // Nobody takes the /points of every fiftieth cycle.
  EXPECT_TRUE(expect_delivered(trace, {.topic = "/points"}, exactly(49)));
  EXPECT_EQ(failure(expect_delivered(trace, {.topic = "/points"}, at_least(50))),
            R"(expected: at least 50 messages of topic '/points' reach a callback
     saw: 49 of 50
without a callback:
  +0.511596000  /points  /filter  not taken)");
}

TEST(ExpectedDelivered, HoldsTheLatency) {
  const Trace trace = example_trace(20);
  EXPECT_TRUE(expect_delivered(trace, {.topic = "/scan"}, at_least(20), at_most(205us)));
  EXPECT_EQ(
      failure(expect_delivered(trace, {.topic = "/scan", .subscriber = "/filter"}, exactly(20), at_most(100us, 0.95))),
      R"(expected: exactly 20 messages of topic '/scan' to '/filter' reach a callback, each after at most 0.100 ms for 95 % of them
     saw: 20 of 20 outside; least 0.205 ms, median 0.205 ms, most 0.205 ms
worst:
  +0.020096000  /scan  /sensor -> /filter  taken after 0.155 ms  callback after 0.205 ms
  +0.030096000  /scan  /sensor -> /filter  taken after 0.155 ms  callback after 0.205 ms
  +0.040096000  /scan  /sensor -> /filter  taken after 0.155 ms  callback after 0.205 ms
  +0.050096000  /scan  /sensor -> /filter  taken after 0.155 ms  callback after 0.205 ms
  +0.060096000  /scan  /sensor -> /filter  taken after 0.155 ms  callback after 0.205 ms
  +0.070096000  /scan  /sensor -> /filter  taken after 0.155 ms  callback after 0.205 ms)");
}

TEST(ExpectedDelivered, SuggestsTopics) {
  EXPECT_EQ(failure(expect_delivered(example_trace(2), {.topic = "/scna"}, at_least(1))),
            R"(expected: at least 1 message of topic '/scna' reaches a callback
     saw: 0 of 0
no message of this topic; did you mean '/scan'?)");
  EXPECT_EQ(failure(expect_delivered(example_trace(2), {.topic = "/odometry"}, at_least(1))),
            R"(expected: at least 1 message of topic '/odometry' reaches a callback
     saw: 0 of 0
the topics of the trace:
        2 /points
        2 /scan)");
}

TEST(ExpectedAllDelivered, IgnoresTheEndOfTheTrace) {
  EXPECT_TRUE(expect_all_delivered(example_trace(50), {.topic = "/points"}));
  EXPECT_TRUE(expect_all_delivered(example_trace(80), {.topic = "/points"}, 1));
  EXPECT_EQ(failure(expect_all_delivered(example_trace(80), {.topic = "/points", .subscriber = "/display"})),
            R"(expected: all messages of topic '/points' to '/display' reach a callback
     saw: 79 of 80
missing:
  +0.511596000  /points  /filter  not taken)");
  EXPECT_EQ(failure(expect_all_delivered(example_trace(5), {.topic = "/points", .subscriber = "/other"})),
            "expected: all messages of topic '/points' to '/other' reach a callback\n     saw: none of 5");
  EXPECT_EQ(failure(expect_all_delivered(ping_pong_trace(), {.topic = "/ping_"})),
            R"(expected: all messages of topic '/ping_' reach a callback
     saw: no message
no message of this topic; did you mean '/ping'?)");
}

constexpr tracing::testing::ExampleVariant kOlder{.is_older = true};
constexpr tracing::testing::ExampleVariant kUnidentified{.is_older = true, .has_source_timestamps = false};

TEST(ExpectedDeliveredOfAnOlderRecording, IsAnEstimate) {
  const Trace trace = example_trace(50, kOlder);
  EXPECT_EQ(expect_delivered(trace, {.topic = "/scan"}, exactly(50)).text,
            "expected: exactly 50 messages of topic '/scan' reach a callback\n     saw: 50 of 50; an estimate, as "
            "publications have no timestamps");
  EXPECT_TRUE(expect_delivered(trace, {.topic = "/scan"}, at_least(50), at_most(205us)));
  EXPECT_THAT(failure(expect_delivered(trace, {.topic = "/scan"}, at_least(50), at_most(200us))),
              ::testing::EndsWith("\nestimates, as publications have no timestamps"));
  EXPECT_TRUE(expect_all_delivered(trace, {.topic = "/scan"}));
  const Verdict lost = expect_delivered(trace, {.topic = "/points"}, at_least(50));
  EXPECT_FALSE(lost.holds);
  EXPECT_FALSE(lost.is_undecided) << "nobody took one of them, and that is known";
  EXPECT_EQ(trace.tracetools(), "6.3.2");
  ASSERT_EQ(trace.doubts().size(), 2u);
  EXPECT_EQ(trace.doubts()[0].topic, "/points");
  EXPECT_EQ(trace.doubts()[0].estimated, 49u);
}

TEST(ExpectedDeliveredOfAnOlderRecording, SaysWhatTheTraceDoesNotTell) {
  const Trace trace = example_trace(7, kUnidentified);
  const Verdict delivered = expect_delivered(trace, {.topic = "/scan"}, at_least(5));
  EXPECT_TRUE(delivered.is_undecided);
  EXPECT_EQ(failure(delivered), R"(expected: at least 5 messages of topic '/scan' reach a callback
     saw: 0 of 7
the publications of 7 messages that were taken can't be told; the trace was recorded by tracetools 6.3.2, which gives publications no timestamps
needed: tracetools 8.0 or later (ROS 2 Jazzy))");
  const Verdict all = expect_all_delivered(trace, {.topic = "/scan"});
  EXPECT_TRUE(all.is_undecided);
  const Verdict too_many = expect_delivered(trace, {.topic = "/scan"}, at_least(8));
  EXPECT_FALSE(too_many.is_undecided) << "so many have not come, whatever the trace does not tell";
  EXPECT_FALSE(too_many.holds);
}

}  // namespace
}  // namespace launch_trace_testing
