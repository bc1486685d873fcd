// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "launch_trace_testing/expectations.hpp"
#include "tests/unit/testing/traces.hpp"

namespace launch_trace_testing {
namespace {

TEST(ExpectedCount, HoldsWithTheEventsThatItFound) {
  const Verdict verdict =
      expect_count(ping_pong_trace(), event("ros2:rcl_publisher_init").with("topic_name", "/ping"), exactly(1));
  EXPECT_TRUE(verdict.holds);
  EXPECT_EQ(verdict.text,
            R"(expected: exactly 1 'ros2:rcl_publisher_init' with topic_name = "/ping"
     saw: 1 of 57 events
  +0.006600000  ping[71]  ros2:rcl_publisher_init  topic_name="/ping" publisher_handle=0x105 node_handle=0x101 ...)");
}

TEST(ExpectedCount, ShowsTheNearestEventsWhenThereIsNone) {
  EXPECT_EQ(failure(expect_count(ping_pong_trace(),
                                 event("ros2:rcl_publisher_init").with("topic_name", "/pingg").with("queue_depth", 10),
                                 at_least(1))),
            R"(expected: at least 1 'ros2:rcl_publisher_init' with topic_name = "/pingg", queue_depth = 10
     saw: none of 57 events
nearest events:
  +0.006600000  ping[71]  ros2:rcl_publisher_init  topic_name="/ping" queue_depth=10 publisher_handle=0x105 ...
  +0.026600000  pong[72]  ros2:rcl_publisher_init  topic_name="/pong" queue_depth=10 publisher_handle=0x205 ...)");
}

TEST(ExpectedCount, SaysWhichConditionWithoutAFieldFails) {
  EXPECT_EQ(failure(expect_count(ping_pong_trace(), event("ros2:rcl_init").in_process("pang"), at_least(1))),
            R"(expected: at least 1 'ros2:rcl_init' in process 'pang'
     saw: none of 57 events
nearest events:
  +0.000000000  ping[71]  ros2:rcl_init  [not in process 'pang'] context_handle=0x100 version="8.10.1"
  +0.020000000  pong[72]  ros2:rcl_init  [not in process 'pang'] context_handle=0x200 version="8.10.1")");
}

TEST(ExpectedCount, SuggestsANameThatIsThere) {
  EXPECT_EQ(failure(expect_count(ping_pong_trace(), event("ros2:rcl_inti"), at_least(1))),
            R"(expected: at least 1 'ros2:rcl_inti'
     saw: none of 57 events
the trace has no event of this name; did you mean 'ros2:rcl_init' (2 of them)?)");
}

TEST(ExpectedCount, ListsTheNamesWhenNoneIsLikeIt) {
  const Trace trace = ping_pong_trace({.accepts = [](const Event& event) {
    return event.name() == "ros2:callback_start" || event.name() == "ros2:rcl_init";
  }});
  EXPECT_EQ(failure(expect_count(trace, event("sched_switch"), at_least(1))),
            R"(expected: at least 1 'sched_switch'
     saw: none of 5 events
the trace has no event of this name, but:
        3 ros2:callback_start
        2 ros2:rcl_init)");
  EXPECT_EQ(failure(expect_count(Trace(), event("sched_switch"), at_least(1))),
            R"(expected: at least 1 'sched_switch'
     saw: none of 0 events
the trace has no events)");
}

TEST(ExpectedCount, ShowsWhatShouldNotBeThere) {
  EXPECT_EQ(failure(expect_count(ping_pong_trace(), event("ros2:rmw_take").with("taken", false), exactly(0))),
            R"(expected: no 'ros2:rmw_take' with taken = 0
     saw: 1 of 57 events
  +0.027030000  pong[72]  ros2:rmw_take  taken=0 rmw_subscription_handle=0x209 message=0x303 source_timestamp=0)");
}

// A condition that cannot hold would make every "no such event" true.
TEST(ExpectedCount, FailsForAFieldThatNoEventHas) {
  EXPECT_EQ(failure(expect_count(ping_pong_trace(), event("ros2:rmw_take").with("nope", 3), exactly(0))),
            R"(expected: no 'ros2:rmw_take' with nope = 3
     saw: no event 'ros2:rmw_take' has a field 'nope')");
  EXPECT_EQ(failure(expect_count(ping_pong_trace(), event("ros2:*take").where("takne == 3 && vpid == 5"), at_most(2))),
            R"(expected: at most 2 'ros2:*take' where takne == 3 && vpid == 5
     saw: no event 'ros2:*take' has a field 'takne'; is 'taken' meant?)");
  // What holds for none, by fields that are there; and events of which the trace knows nothing.
  EXPECT_TRUE(expect_count(ping_pong_trace(), event("ros2:rmw_take").where("taken == 7"), exactly(0)).holds);
  EXPECT_TRUE(expect_count(ping_pong_trace(), event("ros2:rmw_take").where("procname == 'x'"), exactly(0)).holds);
  EXPECT_TRUE(expect_count(ping_pong_trace(), event("my:event").where("nope == 3"), exactly(0)).holds);
}

TEST(ExpectedCount, LeavesOutTheMiddleOfALongTable) {
  const Verdict verdict = expect_count(example_trace(10), event("ros2:callback_end"), at_most(5));
  EXPECT_FALSE(verdict.holds);
  EXPECT_EQ(verdict.text,
            R"(expected: at most 5 'ros2:callback_end'
     saw: 30 of 305 events
  +0.020201000  sensor[101]   ros2:callback_end  callback=0x109
  +0.020701000  filter[102]   ros2:callback_end  callback=0x109
  +0.020851000  display[103]  ros2:callback_end  callback=0x109
  ... 24 more
  +0.111201000  sensor[101]   ros2:callback_end  callback=0x109
  +0.111701000  filter[102]   ros2:callback_end  callback=0x109
  +0.111851000  display[103]  ros2:callback_end  callback=0x109)");
}

TEST(ExpectedEach, ShowsTheEventsWithoutTheCondition) {
  EXPECT_TRUE(expect_each(ping_pong_trace(), event("ros2:rcl_publisher_init"), event("").with("queue_depth", 10)));
  EXPECT_EQ(failure(expect_each(ping_pong_trace(), event("ros2:rmw_take"), event("").with("taken", true))),
            R"(expected: each 'ros2:rmw_take' has taken = 1
     saw: 1 of 4 without it:
  +0.027030000  pong[72]  ros2:rmw_take  taken=0 rmw_subscription_handle=0x209 message=0x303 source_timestamp=0)");
  EXPECT_EQ(failure(expect_each(ping_pong_trace(), event("ros2:rcl_nothing"), event("").with("taken", true))),
            R"(expected: each 'ros2:rcl_nothing' has taken = 1
     saw: no such event
the trace has no event of this name; did you mean 'ros2:rcl_node_init' (2 of them)?)");
}

TEST(ExpectedField, ChecksTheTypesOfRos2Tracing) {
  const Trace trace = ping_pong_trace();
  const EventQuery init = event("ros2:rcl_publisher_init");
  EXPECT_TRUE(expect_field(trace, init, "publisher_handle", FieldKind::kHandle));
  EXPECT_TRUE(expect_field(trace, init, "topic_name", FieldKind::kNonEmptyText));
  EXPECT_TRUE(expect_field(trace, init, "topic_name", FieldKind::kText));
  EXPECT_TRUE(expect_field(trace, init, "queue_depth", FieldKind::kQueueDepth));
  EXPECT_TRUE(expect_field(trace, init, "queue_depth", FieldKind::kInteger));
  EXPECT_TRUE(expect_field(trace, event("ros2:rmw_publisher_init"), "gid", FieldKind::kArray, 16));
  EXPECT_FALSE(expect_field(trace, init, "publisher_handle", FieldKind::kQueueDepth));
  EXPECT_FALSE(expect_field(trace, init, "queue_depth", FieldKind::kPointerOrNull));
  EXPECT_FALSE(expect_field(trace, init, "queue_depth", FieldKind::kReal));
  EXPECT_FALSE(expect_field(trace, event("ros2:rmw_publisher_init"), "gid", FieldKind::kArray, 24));
  const Trace null = written([](tracing::testing::TraceWriter& writer) {
    writer.write(0, 5, tracing::testing::kPing, tracing::ros2::RclTake{0});
  });
  EXPECT_TRUE(expect_field(null, event("ros2:rcl_take"), "message", FieldKind::kPointerOrNull));
  EXPECT_EQ(failure(expect_field(null, event("ros2:rcl_take"), "message", FieldKind::kHandle)),
            R"(expected: each 'ros2:rcl_take' has a handle in message
     saw: 1 of 1 without it:
  +0.000000000  ping[71]  ros2:rcl_take  message=0x0)");
}

TEST(ExpectedNames, ComparesTheSetOfNames) {
  const Trace trace =
      ping_pong_trace({.accepts = [](const Event& event) { return event.name().ends_with("publish"); }});
  EXPECT_TRUE(expect_event_names(trace, {"ros2:rmw_publish", "ros2:rcl_publish", "ros2:rclcpp_publish"}));
  EXPECT_TRUE(expect_event_names(trace, {"ros2:rmw_publish"}, "ros2:rmw_*"));
  EXPECT_EQ(failure(expect_event_names(trace, {"ros2:rmw_publish", "ros2:rcl_publish", "ros2:rcl_take"})),
            R"(expected: events of exactly 3 names
     saw: 3 names
 missing: 'ros2:rcl_take'
  others: 'ros2:rclcpp_publish')");
}

TEST(ExpectedProcesses, ComparesTheNamesOfProcesses) {
  EXPECT_TRUE(expect_processes(ping_pong_trace(), {"ping", "pong"}));
  EXPECT_EQ(failure(expect_processes(ping_pong_trace(), {"ping", "pang"})),
            R"(expected: events of 'ping', 'pang'
     saw: ping[71] (33), pong[72] (24)
 missing: 'pang')");
}

TEST(ExpectedMatchingField, FindsTheOtherEvent) {
  const Trace trace = ping_pong_trace();
  const Event& publish =
      *event("ros2:rmw_publish").with("timestamp", tracing::testing::kPingPongBegin + 506'920'000).first(trace);
  EXPECT_TRUE(
      expect_matching_field(trace, publish, "timestamp", event("ros2:rmw_take").after(publish), "source_timestamp"));
  EXPECT_TRUE(expect_matching_field(trace, publish, "message", event("ros2:rcl_publish")));
  EXPECT_EQ(failure(expect_matching_field(trace, publish, "rmw_publisher_handle",
                                          event("ros2:rcl_publisher_init").after(publish))),
            R"(expected: the rmw_publisher_handle of this event in 'ros2:rcl_publisher_init' after ros2:rmw_publish
     saw: none for this event:
  +0.506920000  ping[71]  ros2:rmw_publish  rmw_publisher_handle=0x106 message=0x300 timestamp=1767225600506920000
nearest events:
  +0.006600000  ping[71]  ros2:rcl_publisher_init  [not after ros2:rmw_publish] rmw_publisher_handle=0x106 ...
  +0.026600000  pong[72]  ros2:rcl_publisher_init  [not after ros2:rmw_publish] rmw_publisher_handle=0x206 ...)");
}

TEST(ExpectedNoLoss, TellsLossesAndEmptyTraces) {
  EXPECT_TRUE(expect_no_loss(ping_pong_trace()));
  EXPECT_EQ(failure(expect_no_loss(Trace())), "expected: events, none of them lost, and no damage\n     saw: 0 events");
  const Trace lossy = written([](tracing::testing::TraceWriter& writer) {
    writer.write(0, 1000, tracing::testing::kPing, tracing::ros2::RclTake{1});
    writer.end_packet(0);
    writer.discard_events(0, 3);
    writer.write(0, 5000, tracing::testing::kPing, tracing::ros2::RclTake{2});
  });
  EXPECT_EQ(failure(expect_no_loss(lossy)),
            R"(expected: events, none of them lost, and no damage
     saw: 2 events
  3 events lost from +0.000000000 to +0.000004000 in ros2_0)");
}

}  // namespace
}  // namespace launch_trace_testing
