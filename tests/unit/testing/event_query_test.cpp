// SPDX-License-Identifier: Apache-2.0
#include "launch_trace_testing/event_query.hpp"

#include <gmock/gmock.h>

#include "tests/unit/testing/traces.hpp"

namespace launch_trace_testing {
namespace {

std::size_t count(const EventQuery& query) {
  return query.select(ping_pong_trace()).size();
}

TEST(EventQuery, SelectsByNameAndPattern) {
  EXPECT_EQ(count(event("ros2:rcl_publish")), 2U);
  EXPECT_EQ(count(event("ros2:rcl_*_init")), 7U);
  EXPECT_EQ(count(event("")), 57U);
  EXPECT_EQ(count(event("ros2:none")), 0U);
}

TEST(EventQuery, ComparesFieldsWithValuesOfAnyKind) {
  EXPECT_EQ(count(event("ros2:rcl_publisher_init").with("topic_name", "/ping")), 1U);
  EXPECT_EQ(count(event("ros2:rcl_publisher_init").with("topic_name", std::string("/ping"))), 1U);
  EXPECT_EQ(count(event("ros2:rcl_publisher_init").with("queue_depth", 10)), 2U);
  EXPECT_EQ(count(event("ros2:rcl_publisher_init").with("queue_depth", 10U).with("topic_name", "/pong")), 1U);
  EXPECT_EQ(count(event("ros2:rcl_publisher_init").with("queue_depth", 10.5)), 0U);
  EXPECT_EQ(count(event("ros2:rmw_take").with("taken", true)), 3U);
  EXPECT_EQ(count(event("ros2:rmw_take").with("taken", false)), 1U);
  EXPECT_EQ(count(event("ros2:rclcpp_executor_wait_for_work").with("timeout", -1)), 3U);
  EXPECT_EQ(count(event("ros2:rclcpp_executor_wait_for_work").with("timeout", ~std::uint64_t{0})), 0U)
      << "the largest unsigned number is not -1";
  const Trace trace = ping_pong_trace();
  const Event* const publisher = event("ros2:rcl_publisher_init").with("topic_name", "/pong").first(trace);
  ASSERT_NE(publisher, nullptr);
  EXPECT_EQ(event("ros2:rcl_publish").with("publisher_handle", publisher->at("publisher_handle")).select(trace).size(),
            1U);
}

TEST(EventQuery, TakesTheLanguageOfConditions) {
  EXPECT_EQ(count(event("ros2:rcl_publisher_init").where("queue_depth >= 10 && topic_name =~ 'ng$'")), 2U);
  EXPECT_EQ(count(event("ros2:rmw_publisher_init").where("gid[0] == 0 && gid")), 3U);
  EXPECT_EQ(count(event("").where("procname == 'pong' && vpid == 72 && vtid == 72 && cpu_id == 0")), 24U);
  EXPECT_EQ(count(event("").where("nothing")), 0U);
}

TEST(EventQuery, PointsToAMistakeInACondition) {
  try {
    event("ros2:rcl_take").where("message = 3");
    ADD_FAILURE() << "no error";
  } catch (const QueryError& error) {
    EXPECT_STREQ(error.what(),
                 "the condition is wrong: expected '==' to compare\n"
                 "  message = 3\n"
                 "          ^");
    EXPECT_EQ(error.reason(), "expected '==' to compare");
    EXPECT_EQ(error.column(), 8U);
  }
}

TEST(EventQuery, ChoosesProcessesThreadsAndTimes) {
  EXPECT_EQ(count(event("").in_process("ping")), 33U);
  EXPECT_EQ(count(event("").in_process("p?ng")), 57U);
  EXPECT_EQ(count(event("").in_process("72")), 24U);
  EXPECT_EQ(count(event("").in_process(72)), 24U);
  const std::int64_t begin = tracing::testing::kPingPongBegin;
  EXPECT_EQ(count(event("").from_time(begin + 507'220'000)), 2U);
  EXPECT_EQ(count(event("").until_time(begin + 900'000)), 1U);
  const Trace trace = ping_pong_trace();
  const Event& take = *event("ros2:rcl_take").first(trace);
  EXPECT_EQ(event("ros2:callback_start").after(take).select(trace).size(), 2U);
  EXPECT_EQ(event("ros2:callback_start").before(take).select(trace).size(), 1U);
  EXPECT_EQ(event("ros2:callback_start").in_thread_of(take).select(trace).size(), 1U);
}

TEST(EventQuery, CutsNamesOfProcessesAsTheKernelDoes) {
  const Trace trace = written([](tracing::testing::TraceWriter& writer) {
    writer.write(0, 1, {1, 1, "component_conta"}, tracing::ros2::RclTake{1});
  });
  EXPECT_EQ(event("").in_process("component_container_mt").select(trace).size(), 1U);
}

TEST(EventQuery, DescribesItself) {
  EXPECT_EQ(event("ros2:rcl_take").describe(), "'ros2:rcl_take'");
  EXPECT_EQ(
      event("ros2:rcl_take")
          .with("message", 0x30)
          .with("other", "text")
          .where("message > 3")
          .in_process("ping")
          .that("has an even number", [](const Event&) { return true; })
          .describe(),
      "'ros2:rcl_take' with message = 48, other = \"text\", where message > 3, in process 'ping', that has an even "
      "number");
  EXPECT_EQ(event("").in_process(7).describe(), "any event in process 7");
}

}  // namespace
}  // namespace launch_trace_testing
