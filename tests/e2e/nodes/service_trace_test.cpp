// SPDX-License-Identifier: Apache-2.0
// The trace of services: those that every node has, and one that a client calls.
#include <gmock/gmock.h>

#include <fstream>

#include "launch_trace_testing/matchers.hpp"
#include "tests/support/command.hpp"
#include "tests/support/main_thread.hpp"
#include "tests/support/sandbox.hpp"

namespace {

namespace fs = std::filesystem;
using namespace launch_trace_testing;
using namespace test_support;
using testing::ElementsAre;

constexpr const char* kLaunchFile = R"(<launch>
  <trace session-name="service" context-fields="procname vpid vtid" subbuffer-size-ust="1048576"/>
  <node pkg="demo_nodes" exec="add_two_ints_server" name="server"/>
  <node pkg="demo_nodes" exec="add_two_ints_client" name="client" on_exit="shutdown">
    <param name="count" value="3"/>
  </node>
</launch>
)";
constexpr int kRequests = 3;

EventQuery of_server(const std::string& name) {
  return of_main_thread("add_two_ints_server", name);
}
EventQuery of_client(const std::string& name) {
  return of_main_thread("add_two_ints_client", name);
}

bool is_publication(const Event& event) {
  return event.name() == "ros2:rclcpp_publish" || event.name() == "ros2:rcl_publish" ||
         event.name() == "ros2:rmw_publish";
}

// The names of events of the main thread of the server around this one, from `before` earlier ones to `after` later
// ones, without those of publications: log lines, parameter events, the graph.
std::vector<std::string> names_around(const Trace& trace, const Event& middle, std::ptrdiff_t before,
                                      std::ptrdiff_t after) {
  const Events thread =
      of_server("*").that("no publication", [](const Event& event) { return !is_publication(event); }).select(trace);
  return names(around(thread, middle, before, after));
}

// One line per entity that the server makes.
std::vector<std::string> entities(const Trace& trace) {
  std::vector<std::string> result;
  for (const Event* const event : of_server("rcl_*_init").select(trace)) {
    if (event->name() == "ros2:rcl_publisher_init") {
      result.push_back("publisher " + event->text("topic_name"));
    } else if (event->name() == "ros2:rcl_service_init") {
      result.push_back("service " + event->text("service_name"));
    }
  }
  return result;
}

TEST(ServiceTrace, TellsWhoAskedWhomAndWhen) {
  Sandbox sandbox;
  const fs::path file = sandbox.directory() / "service.launch.xml";
  std::ofstream(file) << kLaunchFile;
  const CommandResult result = run_command({LAUNCH_PROGRAM, file.string()});
  ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
  const Trace trace(sandbox.trace_directory() / "service");
  EXPECT_THAT(trace, LostNothing());

  // The entities that a node makes by itself, in this order.
  EXPECT_THAT(
      entities(trace),
      ElementsAre("publisher /rosout", "service /server/get_parameters", "service /server/get_parameter_types",
                  "service /server/set_parameters", "service /server/set_parameters_atomically",
                  "service /server/describe_parameters", "service /server/list_parameters",
                  "publisher /parameter_events", "service /server/get_type_description", "service /add_two_ints"));

  const Event& service = *only(trace, of_server("rcl_service_init").with("service_name", "/add_two_ints"));
  EXPECT_THAT(names_around(trace, service, 0, 2),
              ElementsAre("rcl_service_init", "rclcpp_service_callback_added", "rclcpp_callback_register"));
  const Event& added =
      *only(trace, of_server("rclcpp_service_callback_added").with("service_handle", service.handle("service_handle")));
  EXPECT_THAT(trace, HasFieldOfKind(of_server("rclcpp_callback_register").with("callback", added.at("callback")),
                                    "symbol", FieldKind::kNonEmptyText));

  const Event& client = *only(trace, of_client("rcl_client_init").with("service_name", "/add_two_ints"));
  const EventQuery client_init = of_client("rmw_client_init").with("rmw_client_handle", client.at("rmw_client_handle"));
  EXPECT_THAT(trace, HasFieldOfKind(client_init, "gid", FieldKind::kArray, 16));
  const Event& rmw_client = *only(trace, client_init);
  EXPECT_EQ(of_client("*").after(rmw_client).first(trace), &client);

  const auto of_this_client = [&](const std::string& name) {
    return of_client(name).with("rmw_client_handle", client.at("rmw_client_handle"));
  };
  EXPECT_THAT(trace, HasEvents(of_this_client("rmw_send_request"), exactly(kRequests)));
  EXPECT_THAT(trace, HasEvents(of_this_client("rmw_take_response"), exactly(kRequests)));
  EXPECT_THAT(trace, HasEvents(of_server("rmw_take_request"), exactly(kRequests)));
  for (int number = 1; number <= kRequests; ++number) {
    SCOPED_TRACE(number);
    only(trace, of_this_client("rmw_send_request").with("sequence_number", number));
    const auto for_request = [&](const std::string& name) {
      return of_server(name)
          .with("client_gid", rmw_client.at("gid"))
          .with("sequence_number", number)
          .with("rmw_service_handle", service.at("rmw_service_handle"));
    };
    const Event& taken = *only(trace, for_request("rmw_take_request").with("taken", 1));
    // The execution of a service has no event of its own.
    EXPECT_THAT(names_around(trace, taken, 1, 3), ElementsAre("rclcpp_executor_get_next_ready", "rmw_take_request",
                                                              "callback_start", "callback_end", "rmw_send_response"));
    const Event& start = *of_server("callback_start").after(taken).first(trace);
    EXPECT_EQ(start.handle("callback"), added.handle("callback"));
    EXPECT_EQ(start.number("is_intra_process"), 0);
    const Event& response = *only(trace, for_request("rmw_send_response"));
    only(trace, of_this_client("rmw_take_response")
                    .with("sequence_number", number)
                    .with("taken", 1)
                    .with("source_timestamp", response.at("timestamp")));
  }
  // Each request leads to a response, and each response to one that is taken.
  EXPECT_THAT(trace, HappensBefore(of_client("rmw_send_request"), of_server("rmw_send_response")));
  EXPECT_THAT(trace, HappensBefore(of_server("rmw_send_response"), of_client("rmw_take_response")));
}

}  // namespace
