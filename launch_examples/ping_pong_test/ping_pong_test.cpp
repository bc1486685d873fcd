// SPDX-License-Identifier: Apache-2.0
// Ping and pong, tested by what their trace holds. test_ping_pong.py is the same in Python.
#include <launch_trace_testing/traced_test.hpp>

namespace {

using namespace launch_trace_testing;
using namespace std::chrono_literals;
using testing::Gt;

class PingPong : public TracedTest {};

TEST_F(PingPong, AnswersEachMessage) {
  start({.file = PING_PONG_FILE, .arguments = {{"count", "10"}, {"period_ms", "20"}}});
  const Trace trace = finish();

  // Presence and fields.
  EXPECT_THAT(trace, HasProcesses({"ping", "pong"}));
  EXPECT_THAT(trace, HasEvents(event("ros2:rcl_publisher_init").with("topic_name", "/ping"), exactly(1)));
  EXPECT_THAT(trace, HasEvent(event_that("ros2:rcl_publisher_init", Field("queue_depth", Gt(0)))));
  EXPECT_THAT(trace, HasFieldOfKind(event("ros2:rcl_node_init"), "node_handle", FieldKind::kHandle));
  EXPECT_THAT(trace, HasNoEvent(event("ros2:rcl_lifecycle_transition")));

  // Handles lead from one event to the next.
  const Event* const timer = event("ros2:rcl_timer_init").in_process("ping").first(trace);
  ASSERT_NE(timer, nullptr);
  EXPECT_EQ(timer->number("period"), 20'000'000);
  const Event* const added =
      event("ros2:rclcpp_timer_callback_added").with("timer_handle", timer->at("timer_handle")).first(trace);
  ASSERT_NE(added, nullptr);
  EXPECT_THAT(trace, HasEvents(event("ros2:callback_start").in_process("ping").with("callback", added->at("callback")),
                               at_least(10)));

  // Order within a thread, and cause and effect across processes.
  EXPECT_THAT(trace, HasEventsInOrder({event("ros2:rcl_init").in_process("ping"),
                                       event("ros2:rcl_node_init").in_process("ping"),
                                       event("ros2:callback_start").in_process("ping")}));
  const Event* const answers = event("ros2:rcl_publisher_init").with("topic_name", "/pong").first(trace);
  ASSERT_NE(answers, nullptr);
  EXPECT_THAT(
      trace,
      HappensBefore(
          event("ros2:rcl_timer_init").in_process("ping"),
          event("ros2:rcl_publish").in_process("pong").with("publisher_handle", answers->at("publisher_handle"))));

  // From publish() to the callback. A test on a busy machine should not be stricter than the system has to be.
  EXPECT_THAT(trace,
              Delivers({.topic = "/ping", .publisher = "/ping", .subscriber = "/pong"}, at_least(10), at_most(5s)));
  EXPECT_THAT(trace, Delivers({.topic = "/pong"}, at_least(10)));
  EXPECT_THAT(trace, CallbackHasPeriod({.node = "/ping", .timers_only = true}, at_most(5s)));
  EXPECT_THAT(trace, CallbackTakes({.node = "/pong", .topic = "/ping"}, at_most(5s)));
}

}  // namespace
