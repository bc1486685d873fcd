// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "launch_trace_testing/expectations.hpp"
#include "tests/unit/testing/traces.hpp"

namespace launch_trace_testing {
namespace {

namespace ros2 = tracing::ros2;
using tracing::testing::kPing;
using tracing::testing::kPong;

TEST(ExpectedOrder, FindsEachStepBehindTheOneBefore) {
  EXPECT_TRUE(expect_order(ping_pong_trace(), {event("ros2:rcl_init"), event("ros2:rcl_node_init"),
                                               event("ros2:callback_start"), event("ros2:callback_end")}));
  // The second step is a later event than the first one, even if both queries select the same events.
  EXPECT_FALSE(
      expect_order(ping_pong_trace(), {event("ros2:rcl_init"), event("ros2:rcl_init"), event("ros2:rcl_init")}));
}

TEST(ExpectedOrder, ShowsTheEventsThatAreTooEarly) {
  const Verdict verdict = expect_order(ping_pong_trace(), {event("ros2:rcl_publish").in_process("pong"),
                                                           event("ros2:rcl_timer_init").with("period", 500'000'000)});
  EXPECT_FALSE(verdict);
  EXPECT_EQ(verdict.text,
            R"(expected: in this order:
  1. 'ros2:rcl_publish' in process 'pong'
  2. 'ros2:rcl_timer_init' with period = 500000000
     saw: no event for 2. behind this one for 1.
  +0.507102000  pong[72]  ros2:rcl_publish  1. publisher_handle=0x205 message=0x302
earlier events:
  +0.006800000  ping[71]  ros2:rcl_timer_init  2. period=500000000 timer_handle=0x107)");
}

TEST(ExpectedOrder, ShowsTheNearestEventsOfAStepThatIsNowhere) {
  const Verdict verdict = expect_order(ping_pong_trace(), {event("ros2:rcl_timer_init").with("period", 5)});
  EXPECT_FALSE(verdict);
  EXPECT_EQ(verdict.text,
            R"(expected: in this order:
  1. 'ros2:rcl_timer_init' with period = 5
     saw: no event for 1.
nearest events:
  +0.006800000  ping[71]  ros2:rcl_timer_init  period=500000000 timer_handle=0x107)");
}

TEST(ExpectedSorted, TellsTheFirstPairInTheWrongOrder) {
  const Trace trace = ping_pong_trace();
  const Event* const init = event("ros2:rcl_init").first(trace);
  const Event* const node = event("ros2:rcl_node_init").first(trace);
  EXPECT_TRUE(expect_sorted(trace, {init, node}));
  const Verdict verdict = expect_sorted(trace, {node, init});
  EXPECT_FALSE(verdict);
  EXPECT_EQ(verdict.text,
            R"(expected: 2 events in the order of time
     saw: event 2 is not behind event 1
  +0.001200000  ping[71]  ros2:rcl_node_init  1. node_handle=0x101 rmw_handle=0x102 node_name="ping" namespace="/"
  +0.000000000  ping[71]  ros2:rcl_init       2. context_handle=0x100 version="8.10.1")");
}

TEST(HappensBefore, FollowsThreadsAndMessages) {
  const Trace trace = ping_pong_trace();
  const EventQuery timer = event("ros2:rcl_timer_init");
  EXPECT_TRUE(expect_happens_before(trace, timer, event("ros2:callback_start").in_process("ping")));
  EXPECT_TRUE(expect_happens_before(trace, timer, event("ros2:callback_start").in_process("pong")));
  // There and back again.
  EXPECT_TRUE(expect_happens_before(trace, event("ros2:callback_start").in_process("pong"),
                                    event("ros2:rcl_take").in_process("ping")));
}

TEST(HappensBefore, DoesNotTrustTheClock) {
  const Verdict verdict = expect_happens_before(ping_pong_trace(), event("ros2:rcl_init").in_process("ping"),
                                                event("ros2:rcl_node_init").in_process("pong"));
  EXPECT_FALSE(verdict);
  EXPECT_EQ(verdict.text,
            R"(expected: each 'ros2:rcl_node_init' in process 'pong' follows from 'ros2:rcl_init' in process 'ping'
     saw: 1 of 1 effect without a way from any cause, by thread, message or request
  +0.021200000  pong[72]  ros2:rcl_node_init  node_handle=0x201 rmw_handle=0x202 node_name="pong" namespace="/"
causes:
  +0.000000000  ping[71]  ros2:rcl_init  context_handle=0x100 version="8.10.1")");
}

TEST(HappensBefore, SeesNoWayInAMessageThatWasSentBeforeTheCause) {
  const Trace trace = ping_pong_trace();
  EXPECT_FALSE(expect_happens_before(trace, event("ros2:callback_end").in_process("ping"),
                                     event("ros2:rcl_take").in_process("pong")));
  EXPECT_FALSE(expect_happens_before(trace, event("ros2:rcl_init").in_process("ping"),
                                     event("ros2:rcl_init").in_process("ping")))
      << "an event is not its own cause";
}

TEST(HappensBefore, FollowsRequestsAndResponsesWhateverTheClocksSay) {
  const ros2::Gid gid{{1, 2, 3}, 16};
  const Trace trace = written([&](tracing::testing::TraceWriter& writer) {
    writer.write(0, 10, kPing, ros2::RmwClientInit{0x5, gid});
    writer.write(0, 20, kPong, ros2::RmwTakeRequest{0x6, 0x7, gid, 1, true});
    writer.write(0, 30, kPing, ros2::RclTake{1});
    writer.write(0, 40, kPing, ros2::RmwSendRequest{0x5, 0x8, 1});
    writer.write(0, 50, kPong, ros2::RmwSendResponse{0x6, 0x7, gid, 1, 99});
    writer.write(0, 60, kPing, ros2::RmwTakeResponse{0x5, 0x9, 1, 99, true});
    writer.write(0, 70, kPong, ros2::RclTake{2});
  });
  EXPECT_TRUE(expect_happens_before(trace, event("ros2:rcl_take").with("message", 1),
                                    event("ros2:rcl_take").with("message", 2)));
  EXPECT_TRUE(expect_happens_before(trace, event("ros2:rmw_take_request"), event("ros2:rmw_take_response")));
  EXPECT_FALSE(expect_happens_before(trace, event("ros2:rmw_take_response"), event("ros2:rmw_take_request")));
}

}  // namespace
}  // namespace launch_trace_testing
