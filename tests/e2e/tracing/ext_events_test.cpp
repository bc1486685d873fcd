// SPDX-License-Identifier: Apache-2.0
// The events that provider ros2_ext adds: the end of every object, the work of executors for services and clients, and
// the work of clients with responses.
#include <gmock/gmock.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "launch_trace_testing/matchers.hpp"
#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace launch_trace_testing;
using namespace test_support;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr const char* kLaunchFile = R"(<launch>
  <trace session-name="ext" events-ust="ros2:* ros2_ext:*" context-fields="procname vpid vtid" subbuffer-size-ust="1048576"/>
  <node pkg="demo_nodes" exec="add_two_ints_server" name="server"/>
  <node pkg="demo_nodes" exec="add_two_ints_client" name="client" on_exit="shutdown">
    <param name="count" value="3"/>
  </node>
</launch>
)";

// The init event, the event of the object's end, and the field in which both name the object.
struct Life {
  const char* begin;
  const char* end;
  const char* field;
};
constexpr Life kLives[] = {
    {"ros2:rcl_init", "ros2_ext:rcl_context_fini", "context_handle"},
    {"ros2:rcl_node_init", "ros2_ext:rcl_node_fini", "node_handle"},
    {"ros2:rmw_publisher_init", "ros2_ext:rmw_publisher_fini", "rmw_publisher_handle"},
    {"ros2:rcl_publisher_init", "ros2_ext:rcl_publisher_fini", "publisher_handle"},
    {"ros2:rmw_subscription_init", "ros2_ext:rmw_subscription_fini", "rmw_subscription_handle"},
    {"ros2_ext:rmw_service_init", "ros2_ext:rmw_service_fini", "rmw_service_handle"},
    {"ros2:rcl_service_init", "ros2_ext:rcl_service_fini", "service_handle"},
    {"ros2:rmw_client_init", "ros2_ext:rmw_client_fini", "rmw_client_handle"},
    {"ros2:rcl_client_init", "ros2_ext:rcl_client_fini", "client_handle"},
    {"ros2:rcl_timer_init", "ros2_ext:rcl_timer_fini", "timer_handle"},
    {"ros2:rclcpp_callback_register", "ros2_ext:rclcpp_callback_fini", "callback"},
};

// Checks the report of `launch report` for the same trace.
void expect_reported(const std::filesystem::path& directory) {
  const CommandResult result = run_command({LAUNCH_PROGRAM, "report", "--json", directory.string()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const nlohmann::json report = nlohmann::json::parse(result.out);
  ASSERT_EQ(report["calls"].size(), 1U) << report["calls"];
  const nlohmann::json& call = report["calls"][0];
  EXPECT_EQ(call["service"], "/add_two_ints");
  EXPECT_EQ(call["client"], "/client");
  EXPECT_EQ(call["server"], "/server");
  EXPECT_EQ(call["requests"], 3);
  EXPECT_EQ(call["responses"], 3);
  EXPECT_EQ(call["round_trip"]["count"], 3);
  EXPECT_EQ(call["in_service"]["count"], 3);
  EXPECT_GT(call["round_trip"]["min_ns"],
            0);  // maybe less than in_service: the request is recorded when it is on its way

  std::map<std::string, int> callbacks;
  for (const nlohmann::json& callback : report["callbacks"]) {
    if (callback.value("service", "") == "/add_two_ints") {
      callbacks[callback["owner"]] = callback["duration"]["count"];
    }
  }
  EXPECT_THAT(callbacks, ElementsAre(testing::Pair("client", 3), testing::Pair("service", 3)));
  std::map<std::string, int> served;
  for (const nlohmann::json& execution : report["executions"]) {
    if (execution.value("service", "") == "/add_two_ints") {
      served[execution["kind"]] = execution["duration"]["count"];
    }
  }
  EXPECT_THAT(served, ElementsAre(testing::Pair("client", 3), testing::Pair("service", 3)));

  ASSERT_EQ(report["starts"].size(), 2U);
  for (const nlohmann::json& start : report["starts"]) {
    EXPECT_GT(start["node_after_ns"], 0) << start;
    EXPECT_GT(start["ready_after_ns"], start["node_after_ns"]) << start;
  }
}

TEST(ExtEvents, TellTheEndOfEveryObjectAndWhatServicesAndClientsDo) {
  Sandbox sandbox;
  const std::filesystem::path file = sandbox.directory() / "ext.launch.xml";
  std::ofstream(file) << kLaunchFile;
  const CommandResult result = run_command({LAUNCH_PROGRAM, file.string()});
  ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
  const Trace trace(sandbox.trace_directory() / "ext");
  EXPECT_THAT(trace, LostNothing());

  for (const Life& life : kLives) {
    SCOPED_TRACE(life.begin);
    EXPECT_THAT(trace, HasEvent(event(life.begin)));
    std::map<std::int64_t, std::set<std::uint64_t>> living;
    for (const Event& event : trace) {
      if (event.name() == life.begin) {
        EXPECT_TRUE(living[event.vpid()].insert(event.handle(life.field)).second) << "begins twice";
      } else if (event.name() == life.end) {
        EXPECT_EQ(living[event.vpid()].erase(event.handle(life.field)), 1U) << "ends without having begun";
      }
    }
    for (const auto& [vpid, handles] : living) {
      EXPECT_THAT(handles, IsEmpty()) << "of process " << vpid;
    }
  }

  ASSERT_THAT(trace, HasEvent(event("ros2:rcl_client_init")));
  const Value& client = event("ros2:rcl_client_init").first(trace)->at("client_handle");
  const EventQuery of_client = event("").with("client_handle", client);
  std::vector<std::string> with_responses;
  for (const Event* const each : event("ros2_ext:rclcpp_client_callback*").select(trace)) {
    with_responses.push_back(each->name().substr(23) + " " + std::to_string(each->number("sequence_number")));
  }
  EXPECT_THAT(with_responses, ElementsAre("callback_start 1", "callback_end 1", "callback_start 2", "callback_end 2",
                                          "callback_start 3", "callback_end 3"));
  EXPECT_THAT(trace, EachEvent(event("ros2_ext:rclcpp_client_callback*"), of_client));
  EXPECT_THAT(trace, HasEvents(event("ros2_ext:rclcpp_executor_execute_service"), exactly(3)));
  EXPECT_THAT(trace, EachEvent(event("ros2_ext:rclcpp_executor_execute_client"), of_client));
  for (const std::string kind : {"publisher", "subscription"}) {
    const std::string handle = "rmw_" + kind + "_handle";
    const std::vector<const Event*> made = event("ros2:rmw_" + kind + "_init").select(trace);
    const std::vector<const Event*> qos = event("ros2_ext:rmw_" + kind + "_qos").select(trace);
    ASSERT_EQ(qos.size(), made.size()) << kind;
    for (std::size_t i = 0; i < made.size(); ++i) {
      EXPECT_EQ(qos[i]->handle(handle), made[i]->handle(handle));
    }
    EXPECT_THAT(trace, EachEvent(event("ros2_ext:rmw_" + kind + "_qos"), event("").with("reliable", 1)));
  }
  // No object existed before the session, so there is no state dump.
  EXPECT_THAT(trace, HasNoEvent(event("ros2_ext:state_dump_begin")));
  expect_reported(sandbox.trace_directory() / "ext");
}

}  // namespace
