// SPDX-License-Identifier: Apache-2.0
#include "launch_trace_testing/trace.hpp"

#include <gmock/gmock.h>

#include <sstream>

#include "tests/unit/testing/traces.hpp"

namespace launch_trace_testing {
namespace {

using ::testing::ElementsAre;

TEST(TestingTrace, HoldsEventsWithAllThatWasRecorded) {
  const Trace trace = ping_pong_trace();
  EXPECT_EQ(to_string(trace), "a trace with 57 events of 2 processes");
  const Event& init = trace.events()[10];
  EXPECT_EQ(init.name(), "ros2:rcl_publisher_init");
  EXPECT_EQ(init.time_ns(), tracing::testing::kPingPongBegin + 6'600'000);
  EXPECT_EQ(init.position(), 10U);
  EXPECT_EQ(init.vpid(), 71);
  EXPECT_EQ(init.vtid(), 71);
  EXPECT_EQ(init.procname(), "ping");
  EXPECT_THAT(init.event_class().fields,
              ElementsAre("publisher_handle", "node_handle", "rmw_publisher_handle", "topic_name", "queue_depth"));
  EXPECT_EQ(init.text("topic_name"), "/ping");
  EXPECT_EQ(init.number("queue_depth"), 10);
  EXPECT_EQ(init.handle("node_handle"), 0x101U);
  EXPECT_EQ(to_string(init),
            "ros2:rcl_publisher_init publisher_handle=0x105 node_handle=0x101 rmw_publisher_handle=0x106 "
            "topic_name=\"/ping\" queue_depth=10 of ping[71/71]");
  EXPECT_EQ(trace.begin_ns(), tracing::testing::kPingPongBegin);
  EXPECT_EQ(trace.end_ns(), trace.events().back().time_ns());
}

TEST(TestingTrace, SaysWhatIsWrongWithAQuestion) {
  const Trace trace = ping_pong_trace();
  const auto error_of = [&](auto question) {
    try {
      question(trace.events()[10]);
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_EQ(error_of([](const Event& event) { event.number("depth"); }),
            "ros2:rcl_publisher_init has no field 'depth'; it has publisher_handle, node_handle, rmw_publisher_handle, "
            "topic_name, queue_depth");
  EXPECT_EQ(error_of([](const Event& event) { event.number("topic_name"); }),
            "the field topic_name of ros2:rcl_publisher_init is \"/ping\", which is no integer of 64 bits with a sign");
  EXPECT_EQ(error_of([](const Event& event) { event.text("queue_depth"); }),
            "the field queue_depth of ros2:rcl_publisher_init is 10, which is no text");
  try {
    Trace nothing("/nonexistent/trace");
    ADD_FAILURE() << "no error";
  } catch (const TraceError& error) {
    EXPECT_STREQ(error.what(),
                 "cannot read the trace '/nonexistent/trace': no such directory\nhelp: give the directory that the "
                 "launcher printed when it ended the session");
  }
}

TEST(TestingTrace, TellsTheWaysOfMessagesAndTheCallbacks) {
  const Trace trace = ping_pong_trace();
  const std::int64_t begin = tracing::testing::kPingPongBegin;
  std::vector<Delivery> pings;
  for (const Delivery& delivery : trace.deliveries()) {
    if (delivery.topic == "/ping") {
      pings.push_back(delivery);
    }
  }
  ASSERT_EQ(pings.size(), 1U);
  EXPECT_EQ(pings[0].publisher, "/ping");
  EXPECT_EQ(pings[0].subscriber, "/pong");
  EXPECT_EQ(pings[0].publisher_vpid, 71);
  EXPECT_EQ(pings[0].subscriber_vpid, 72);
  EXPECT_EQ(pings[0].called_ns - begin, 506'910'000);
  EXPECT_EQ(pings[0].published_ns - begin, 506'920'000);
  EXPECT_EQ(pings[0].taken_ns - begin, 507'060'000);
  EXPECT_EQ(pings[0].callback_start_ns - begin, 507'070'000);
  EXPECT_EQ(pings[0].callback_end_ns - begin, 507'150'000);
  ASSERT_EQ(trace.callbacks().size(), 3U);
  const CallbackRun& timer = trace.callbacks()[0];
  EXPECT_TRUE(timer.is_timer);
  EXPECT_EQ(timer.node, "/ping");
  EXPECT_EQ(timer.period_ns, 500'000'000);
  EXPECT_EQ(timer.end_ns - timer.start_ns, 60'000);
  EXPECT_EQ(trace.callbacks()[1].topic, "/ping");
  EXPECT_EQ(trace.callbacks()[1].vpid, 72);
}

TEST(TestingTrace, LeavesOutWhatIsNotAccepted) {
  const Trace trace = ping_pong_trace({.accepts = [](const Event& event) { return event.vpid() == 71; }});
  EXPECT_EQ(to_string(trace), "a trace with 33 events of 1 process");
  EXPECT_EQ(trace.events().back().position(), trace.size() - 1);
  EXPECT_EQ(trace.callbacks().size(), 2U);
}

TEST(TestingTrace, IsPrintedInOneLine) {
  std::ostringstream text;
  PrintTo(Trace(), &text);
  EXPECT_EQ(text.str(), "a trace with 0 events of 0 processes");
  EXPECT_EQ(::testing::PrintToString(ping_pong_trace()), "a trace with 57 events of 2 processes");
}

}  // namespace
}  // namespace launch_trace_testing
