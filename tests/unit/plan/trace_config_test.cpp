// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/plan/trace_config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pwd.h>
#include <unistd.h>

#include <ctime>
#include <filesystem>
#include <set>

namespace {

using tracing::trace_base_path;
using tracing::TraceConfig;

TEST(TraceConfig, DefaultsAreThoseOfRos2TracingButForTheBuffers) {
  const TraceConfig config;
  EXPECT_EQ(config.events_ust, tracing::default_ros_events());
  EXPECT_TRUE(config.events_kernel.empty());
  EXPECT_TRUE(config.syscalls.empty());
  EXPECT_THAT(config.context_fields_ust, testing::ElementsAre("procname", "vpid", "vtid"));
  EXPECT_EQ(config.context_fields_kernel, config.context_fields_ust);
  EXPECT_EQ(config.ust.subbuffer_size, 1048576u);
  EXPECT_EQ(config.ust.subbuffer_count, 4u);
  EXPECT_EQ(config.ust.read_timer, 50'000u);
  EXPECT_EQ(config.subbuffer_size_kernel, 131072u);
  EXPECT_FALSE(config.append_trace || config.snapshot_mode || config.dual_session);
}

TEST(TraceConfig, HasThe42EventsOfProviderRos2) {
  const auto& events = tracing::default_ros_events();
  EXPECT_EQ(events.size(), 42u);
  EXPECT_EQ(std::set(events.begin(), events.end()).size(), 42u);
  EXPECT_THAT(events, testing::Each(testing::StartsWith("ros2:")));
}

TEST(TraceConfig, InitialisationEventsAre22OfThem) {
  const auto& events = tracing::initialisation_ros_events();
  EXPECT_EQ(events.size(), 22u);
  EXPECT_THAT(tracing::default_ros_events(), testing::IsSupersetOf(events));
  EXPECT_THAT(events, testing::IsSupersetOf({"ros2:rcl_init", "ros2:rclcpp_callback_register",
                                             "ros2:rclcpp_construct_ring_buffer", "ros2:message_link_partial_sync"}));
  EXPECT_THAT(events, testing::Not(testing::Contains("ros2:rcl_lifecycle_transition")));
  EXPECT_THAT(events, testing::Not(testing::Contains("ros2:callback_start")));
}

TEST(TraceConfig, NamesSessionAndDirectoryAlike) {
  TraceConfig config;
  config.session_name = "run";
  config.base_path = "/traces";
  EXPECT_EQ(config.lttng_session_name(), "run");
  EXPECT_EQ(config.trace_directory(), "/traces/run");
  EXPECT_FALSE(config.records_snapshots());
}

TEST(TraceConfig, HalvesOfADualSessionHaveNamesAndDirectoriesOfTheirOwn) {
  TraceConfig snapshot;
  snapshot.session_name = "run";
  snapshot.base_path = "/traces";
  snapshot.dual_session = true;
  EXPECT_EQ(snapshot.lttng_session_name(), "run-snapshot");
  EXPECT_EQ(snapshot.trace_directory(), "/traces/run/snapshot");
  EXPECT_TRUE(snapshot.records_snapshots());

  TraceConfig runtime = snapshot;
  runtime.dual_session = false;
  runtime.dual_runtime = true;
  EXPECT_EQ(runtime.lttng_session_name(), "run-runtime");
  EXPECT_EQ(runtime.trace_directory(), "/traces/run/runtime");
  EXPECT_FALSE(runtime.records_snapshots());
}

TEST(TraceBasePath, GivenPathComesFirst) {
  EXPECT_EQ(trace_base_path("/given", {{"ROS_TRACE_DIR", "/dir"}, {"ROS_HOME", "/ros"}, {"HOME", "/home/me"}}),
            "/given");
}

TEST(TraceBasePath, ComesFromTheEnvironmentOtherwise) {
  EXPECT_EQ(trace_base_path("", {{"ROS_TRACE_DIR", "/dir"}, {"ROS_HOME", "/ros"}, {"HOME", "/home/me"}}), "/dir");
  EXPECT_EQ(trace_base_path("", {{"ROS_TRACE_DIR", ""}, {"ROS_HOME", "/ros"}, {"HOME", "/home/me"}}), "/ros/tracing");
  EXPECT_EQ(trace_base_path("", {{"ROS_HOME", ""}, {"HOME", "/home/me"}}), "/home/me/.ros/tracing");
}

TEST(TraceBasePath, ExpandsTheHomeDirectory) {
  EXPECT_EQ(trace_base_path("~/traces", {{"HOME", "/home/me"}}), "/home/me/traces");
  EXPECT_EQ(trace_base_path("~", {{"HOME", "/home/me"}}), "/home/me");
  EXPECT_EQ(trace_base_path("", {{"ROS_TRACE_DIR", "~/t"}, {"HOME", "/home/me"}}), "/home/me/t");
  EXPECT_EQ(trace_base_path("/a/~/b", {{"HOME", "/home/me"}}), "/a/~/b");
  EXPECT_EQ(trace_base_path("~/x", {}), std::string(getpwuid(getuid())->pw_dir) + "/x");
  EXPECT_EQ(trace_base_path("", {}), std::string(getpwuid(getuid())->pw_dir) + "/.ros/tracing");
}

TEST(TraceBasePath, IsAbsoluteAndNormalised) {
  const std::string here = std::filesystem::current_path();
  EXPECT_EQ(trace_base_path("traces", {}), here + "/traces");
  EXPECT_EQ(trace_base_path("./a/../b//c/", {}), here + "/b/c");
  EXPECT_EQ(trace_base_path("", {{"ROS_HOME", "ros"}}), here + "/ros/tracing");
  EXPECT_EQ(trace_base_path("/", {}), "/");
}

TEST(SessionTimestamp, IsADashAndTheLocalTime) {
  const std::string stamp = tracing::session_timestamp();
  EXPECT_THAT(stamp, testing::MatchesRegex("-[0-9]{14}"));
  std::tm parsed{};
  ASSERT_NE(strptime(stamp.c_str(), "-%Y%m%d%H%M%S", &parsed), nullptr);
  parsed.tm_isdst = -1;
  EXPECT_NEAR(std::difftime(std::mktime(&parsed), std::time(nullptr)), 0.0, 5.0);
}

}  // namespace
