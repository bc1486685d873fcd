// SPDX-License-Identifier: Apache-2.0
// An action between two processes, and its trace.
#include <gmock/gmock.h>

#include <fstream>
#include <set>

#include "tests/e2e/recorded_trace.hpp"
#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

// Runs server and client with a trace; `parameter` is a parameter of the client. Returns what they printed.
std::string run_action(const Sandbox& sandbox, const std::string& parameter) {
  const std::filesystem::path file = sandbox.directory() / "action.launch.xml";
  std::ofstream(file) << R"(<launch>
  <trace session-name="action" events-ust="ros2:* ros2_ext:*" context-fields="procname vpid vtid" subbuffer-size-ust="1048576"/>
  <node pkg="demo_nodes" exec="fibonacci_action_server" name="server" output="screen">
    <param name="period_ms" value="20"/>
  </node>
  <node pkg="demo_nodes" exec="fibonacci_action_client" name="client" output="screen" on_exit="shutdown">
    )" << parameter << R"(
  </node>
</launch>
)";
  const CommandResult result = run_command({LAUNCH_PROGRAM, file.string()});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  return result.out + result.err;
}

TEST(Action, ComputesASequence) {
  Sandbox sandbox;
  const std::string output = run_action(sandbox, R"(<param name="order" value="5"/>)");
  EXPECT_THAT(output, HasSubstr("Received goal request with order 5"));
  EXPECT_THAT(output, HasSubstr("Feedback: 0 1 1 2"));
  EXPECT_THAT(output, HasSubstr("Goal succeeded: 0 1 1 2 3 5"));

  const RecordedTrace trace = read_trace(sandbox.trace_directory() / "action");
  std::set<std::string> services, clients, topics;
  std::set<std::uint64_t> action_services;
  std::size_t waitables = 0;
  for (const RecordedEvent& event : trace.events) {
    if (event.name == "ros2:rcl_service_init" && event.text("service_name").starts_with("/fibonacci")) {
      services.insert(event.text("service_name"));
      action_services.insert(event.number("service_handle"));
    } else if (event.name == "ros2:rcl_client_init") {
      clients.insert(event.text("service_name"));
    } else if (event.name == "ros2:rcl_publisher_init" && event.text("topic_name").starts_with("/fibonacci")) {
      topics.insert(event.text("topic_name"));
    } else if (event.name == "ros2:rclcpp_service_callback_added" && event.procname == "fibonacci_actio") {
      EXPECT_EQ(action_services.count(event.number("service_handle")), 0U) << "services of actions have no callback";
    } else if (event.name == "ros2_ext:rclcpp_executor_execute_waitable") {
      ++waitables;
    }
  }
  const auto expected = UnorderedElementsAre("/fibonacci/_action/send_goal", "/fibonacci/_action/cancel_goal",
                                             "/fibonacci/_action/get_result");
  EXPECT_THAT(services, expected);
  EXPECT_THAT(clients, expected);
  EXPECT_THAT(topics, UnorderedElementsAre("/fibonacci/_action/feedback", "/fibonacci/_action/status"));
  // At least these: the goal, its response, the request for the result and the result.
  EXPECT_GE(waitables, 4U);
}

TEST(Action, IsCanceledByItsClient) {
  Sandbox sandbox;
  const std::string output =
      run_action(sandbox, R"(<param name="order" value="40"/><param name="cancel_after" value="2"/>)");
  EXPECT_THAT(output, HasSubstr("Received request to cancel goal"));
  EXPECT_THAT(output, HasSubstr("Goal was canceled: 0 1 1 2"));
}

TEST(Action, IsRejectedByItsServer) {
  Sandbox sandbox;
  const RunningCommand server(
      {.argv = {std::string(BUILD_DIRECTORY) + "/prefix/lib/demo_nodes/fibonacci_action_server"}});
  const CommandResult client =
      run_command({std::string(BUILD_DIRECTORY) + "/prefix/lib/demo_nodes/fibonacci_action_client", "--ros-args", "-p",
                   "order:=47"});
  EXPECT_EQ(client.exit_code, 1);
  EXPECT_THAT(client.err, HasSubstr("Goal was rejected by server"));
}

}  // namespace
