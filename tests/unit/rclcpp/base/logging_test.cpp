// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <rcutils/logging.h>

#include <cstdio>
#include <functional>
#include <memory>
#include <rcl_interfaces/msg/log.hpp>
#include <string>
#include <vector>

#include "tests/unit/rclcpp/ros_test.hpp"

using testing::ElementsAre;

namespace {

std::vector<std::string>& lines() {
  static std::vector<std::string> kept;
  return kept;
}

void keep_line(const rcutils_log_location_t* location, int severity, const char* name, rcutils_time_point_value_t,
               const char* format, va_list* args) {
  char text[256];
  vsnprintf(text, sizeof text, format, *args);
  EXPECT_NE(location->line_number, 0u);
  lines().push_back(std::string(rcutils_logging_severity_name(severity)) + " " + name + ": " + text);
}

class LoggingTest : public ::testing::Test {
 protected:
  LoggingTest() {
    lines().clear();
    rcutils_logging_set_output_handler(keep_line);
  }
  ~LoggingTest() override { EXPECT_EQ(rcutils_logging_shutdown(), RCUTILS_RET_OK); }

  rclcpp::Logger logger_ = rclcpp::get_logger("logger");
};

TEST_F(LoggingTest, FormatsAndStreams) {
  RCLCPP_INFO(logger_, "got %d", 3);
  RCLCPP_WARN_STREAM(logger_, "got " << 3 << "%");
  RCLCPP_ERROR(logger_, "plain");
  RCLCPP_FATAL(rclcpp::get_logger("other"), "%s", "text");
  EXPECT_THAT(lines(),
              ElementsAre("INFO logger: got 3", "WARN logger: got 3%", "ERROR logger: plain", "FATAL other: text"));
}

TEST_F(LoggingTest, LevelsFilterAndAreInherited) {
  int evaluated = 0;
  RCLCPP_DEBUG(logger_, "%d", ++evaluated);
  EXPECT_EQ(evaluated, 0);
  logger_.set_level(rclcpp::Logger::Level::Debug);
  RCLCPP_DEBUG(logger_.get_child("child"), "%d", ++evaluated);
  EXPECT_THAT(lines(), ElementsAre("DEBUG logger.child: 1"));
  EXPECT_EQ(logger_.get_child("child").get_effective_level(), rclcpp::Logger::Level::Debug);
  logger_.get_child("child").set_level(rclcpp::Logger::Level::Error);
  RCLCPP_WARN(logger_.get_child("child"), "hidden");
  EXPECT_EQ(lines().size(), 1u);
}

TEST_F(LoggingTest, OnceSkipfirstAndExpressionRememberTheirPlace) {
  for (int i = 0; i < 3; ++i) {
    RCLCPP_INFO_ONCE(logger_, "once %d", i);
    RCLCPP_INFO_SKIPFIRST(logger_, "skip %d", i);
    RCLCPP_INFO_EXPRESSION(logger_, i == 1, "if %d", i);
    RCLCPP_INFO_STREAM_ONCE(logger_, "stream once " << i);
    RCLCPP_INFO_FUNCTION(
        logger_, [i] { return i == 2; }, "function %d", i);
    std::function<bool()> stored = [i] { return i == 2; };
    RCLCPP_INFO_FUNCTION(logger_, &stored, "stored %d", i);
  }
  EXPECT_THAT(lines(), ElementsAre("INFO logger: once 0", "INFO logger: stream once 0", "INFO logger: skip 1",
                                   "INFO logger: if 1", "INFO logger: skip 2", "INFO logger: function 2",
                                   "INFO logger: stored 2"));
}

// A clock that the test sets.
struct FakeClock {
  int64_t value = 0;
  rclcpp::Time now() const { return rclcpp::Time(value, RCL_ROS_TIME); }
};

TEST_F(LoggingTest, ThrottleLetsOneLinePerDurationPass) {
  FakeClock clock;
  for (const int64_t milliseconds : {0, 50, 99, 100, 150, 250, 20}) {
    clock.value = milliseconds * 1'000'000;
    RCLCPP_INFO_THROTTLE(logger_, clock, 100, "at %ld", static_cast<long>(milliseconds));
  }
  EXPECT_THAT(lines(), ElementsAre("INFO logger: at 0", "INFO logger: at 100", "INFO logger: at 250",
                                   "INFO logger: at 20"));  // the clock went back
}

class RosoutTest : public RosTest {};

TEST_F(RosoutTest, LogLinesOfNodesArePublished) {
  using rcl_interfaces::msg::Log;
  auto node = std::make_shared<rclcpp::Node>("node", "/ns");
  EXPECT_STREQ(node->get_logger().get_name(), "ns.node");
  std::vector<Log> logs;
  auto subscription =
      node->create_subscription<Log>("/rosout", rclcpp::RosoutQoS(), [&logs](const Log& log) { logs.push_back(log); });
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(node);
  RCLCPP_WARN(node->get_logger(), "value %d", 5);
  ASSERT_TRUE(spin_until(executor, [&] { return !logs.empty(); }));
  EXPECT_EQ(logs[0].msg, "value 5");
  EXPECT_EQ(logs[0].name, "ns.node");
  EXPECT_EQ(logs[0].level, Log::WARN);
  EXPECT_THAT(logs[0].file, testing::EndsWith("logging_test.cpp"));
  EXPECT_EQ(logs[0].function, "TestBody");
}

TEST_F(RosoutTest, LogLevelComesFromTheCommandLine) {
  init({"--ros-args", "--log-level", "node:=debug", "--log-level", "error"});
  EXPECT_EQ(rclcpp::get_logger("node").get_effective_level(), rclcpp::Logger::Level::Debug);
  EXPECT_EQ(rclcpp::get_logger("other").get_effective_level(), rclcpp::Logger::Level::Error);
}

TEST_F(RosoutTest, LogLevelOfANodeComesFromItsOptions) {
  init({"--ros-args", "--log-level", "error"});
  const auto options = rclcpp::NodeOptions().log_level(rclcpp::Logger::Level::Debug);
  EXPECT_EQ(options.log_level(), rclcpp::Logger::Level::Debug);
  const auto loud = std::make_shared<rclcpp::Node>("loud", options);
  const auto quiet = std::make_shared<rclcpp::Node>("quiet");
  EXPECT_EQ(loud->get_logger().get_effective_level(), rclcpp::Logger::Level::Debug);
  EXPECT_EQ(quiet->get_logger().get_effective_level(), rclcpp::Logger::Level::Error);
}

}  // namespace
