// SPDX-License-Identifier: Apache-2.0
#include "launch_trace_testing/matchers.hpp"

#include "tests/unit/testing/traces.hpp"

namespace launch_trace_testing {
namespace {

using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::Gt;
using ::testing::Lt;
using ::testing::Not;
using ::testing::StartsWith;

// What GoogleTest prints behind "Expected:", and what it adds to the value.
std::string mismatch(const Trace& trace, const TraceMatcher& matcher) {
  ::testing::StringMatchResultListener listener;
  EXPECT_FALSE(matcher.MatchAndExplain(trace, &listener));
  return ::testing::DescribeMatcher<const Trace&>(matcher) + listener.str();
}

TEST(Matchers, HoldForWhatATraceHas) {
  const Trace trace = ping_pong_trace();
  EXPECT_THAT(trace, HasEvent(event("ros2:rcl_publisher_init").with("topic_name", "/ping")));
  EXPECT_THAT(trace, HasEvents(event("ros2:rcl_publish"), exactly(2)));
  EXPECT_THAT(trace, HasNoEvent(event("ros2:rcl_lifecycle_transition")));
  EXPECT_THAT(trace, Not(HasEvent(event("ros2:rcl_lifecycle_transition"))));
  EXPECT_THAT(trace, EachEvent(event("ros2:rcl_publisher_init"), event("").with("queue_depth", 10)));
  EXPECT_THAT(trace, HasFieldOfKind(event("ros2:rcl_publisher_init"), "publisher_handle", FieldKind::kHandle));
  EXPECT_THAT(trace, HasExactlyEventNames({"ros2:rcl_publish", "ros2:rclcpp_publish"}, "ros2:rcl*_publish"));
  EXPECT_THAT(trace, HasProcesses({"ping", "pong"}));
  EXPECT_THAT(trace, HasEventsInOrder({event("ros2:rcl_init"), event("ros2:callback_start")}));
  EXPECT_THAT(trace, HappensBefore(event("ros2:rcl_timer_init"), event("ros2:callback_start").in_process("pong")));
  EXPECT_THAT(trace, Delivers({.topic = "/ping"}, exactly(1), at_most(1ms)));
  EXPECT_THAT(trace, DeliversAll({.topic = "/ping"}));
  EXPECT_THAT(trace, CallbackTakes({.timers_only = true}, at_most(1ms)));
  EXPECT_THAT(example_trace(9), CallbackHasPeriod({.timers_only = true}, around(10ms, 1us)));
  EXPECT_THAT(trace, HasPeriod(event("ros2:rcl_init"), at_most(1s)));
  EXPECT_THAT(trace, HasDuration(event("ros2:callback_start"), event("ros2:callback_end"), at_most(1ms)));
  EXPECT_THAT(trace, LostNothing());
  const Event& publish = *event("ros2:rclcpp_publish").first(trace);
  EXPECT_THAT(trace, HasMatchingField(publish, "message", event("ros2:rcl_publish")));
}

TEST(Matchers, ShowWhatIsExpectedAndTheNearestEvents) {
  EXPECT_EQ(mismatch(ping_pong_trace(), HasEvent(event("ros2:rcl_publisher_init").with("topic_name", "/pang"))),
            R"(at least 1 'ros2:rcl_publisher_init' with topic_name = "/pang"
     saw: none of 57 events
nearest events:
  +0.006600000  ping[71]  ros2:rcl_publisher_init  topic_name="/ping" publisher_handle=0x105 node_handle=0x101 ...
  +0.026600000  pong[72]  ros2:rcl_publisher_init  topic_name="/pong" publisher_handle=0x205 node_handle=0x201 ...)");
}

TEST(Matchers, ShowWhatShouldNotBe) {
  EXPECT_EQ(mismatch(ping_pong_trace(), Not(HasEvent(event("ros2:rcl_timer_init")))),
            R"(not: at least 1 'ros2:rcl_timer_init'
     saw: 1 of 57 events
  +0.006800000  ping[71]  ros2:rcl_timer_init  timer_handle=0x107 period=500000000)");
}

TEST(Matchers, OfGoogleTestSeeATraceAsAContainerOfEvents) {
  const Trace trace = ping_pong_trace();
  EXPECT_THAT(trace, Contains(AllOf(Named("ros2:rcl_publisher_init"), TextField("topic_name", StartsWith("/pi")),
                                    Field("queue_depth", Gt(5)), HandleField("publisher_handle", 0x105))));
  EXPECT_THAT(trace, Each(Named(StartsWith("ros2:"))));
  EXPECT_THAT(trace, HasEvents(event_that("ros2:rcl_publisher_init", Field("queue_depth", Gt(5))), exactly(2)));
  EXPECT_EQ(mismatch(trace, HasEvent(event_that("ros2:rcl_timer_init", Field("period", Lt(5))))),
            R"(at least 1 'ros2:rcl_timer_init' whose field period value is < 5
     saw: none of 57 events
nearest events:
  +0.006800000  ping[71]  ros2:rcl_timer_init  [not whose field period value is < 5] timer_handle=0x107 period=500000000)");
}

}  // namespace
}  // namespace launch_trace_testing
