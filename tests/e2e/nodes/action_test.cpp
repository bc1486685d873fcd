// SPDX-License-Identifier: Apache-2.0
// An action between two processes, and its trace.
#include <gmock/gmock.h>

#include <fstream>
#include <set>

#include "launch_trace_testing/matchers.hpp"
#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace launch_trace_testing;
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

std::set<std::string> texts(const Trace& trace, const EventQuery& query, const std::string& field) {
  std::set<std::string> texts;
  for (const Event* const event : query.select(trace)) {
    texts.insert(event->text(field));
  }
  return texts;
}

TEST(Action, ComputesASequence) {
  Sandbox sandbox;
  const std::string output = run_action(sandbox, R"(<param name="order" value="5"/>)");
  EXPECT_THAT(output, HasSubstr("Received goal request with order 5"));
  EXPECT_THAT(output, HasSubstr("Feedback: 0 1 1 2"));
  EXPECT_THAT(output, HasSubstr("Goal succeeded: 0 1 1 2 3 5"));

  const Trace trace(sandbox.trace_directory() / "action");
  const EventQuery services = event("ros2:rcl_service_init").where("service_name =~ '^/fibonacci'");
  const auto expected = UnorderedElementsAre("/fibonacci/_action/send_goal", "/fibonacci/_action/cancel_goal",
                                             "/fibonacci/_action/get_result");
  EXPECT_THAT(texts(trace, services, "service_name"), expected);
  EXPECT_THAT(texts(trace, event("ros2:rcl_client_init"), "service_name"), expected);
  EXPECT_THAT(texts(trace, event("ros2:rcl_publisher_init").where("topic_name =~ '^/fibonacci'"), "topic_name"),
              UnorderedElementsAre("/fibonacci/_action/feedback", "/fibonacci/_action/status"));
  for (const Event* const service : services.select(trace)) {  // services of actions have no callback
    EXPECT_THAT(trace, HasNoEvent(event("ros2:rclcpp_service_callback_added")
                                      .in_process(service->vpid())
                                      .with("service_handle", service->at("service_handle"))));
  }
  // At least these: the goal, its response, the request for the result and the result.
  EXPECT_THAT(trace, HasEvents(event("ros2_ext:rclcpp_executor_execute_waitable"), at_least(4)));
  // The client takes it itself, and no callback of the trace runs for it.
  EXPECT_THAT(trace, Delivers({.topic = "/fibonacci/_action/feedback", .subscriber = "/client"}, at_least(1)));
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
