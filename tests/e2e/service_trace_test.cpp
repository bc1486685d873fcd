// SPDX-License-Identifier: Apache-2.0
// The trace of services: those that every node has, and one that a client calls.
#include <gmock/gmock.h>

#include <fstream>
#include <optional>

#include "tests/e2e/recorded_trace.hpp"
#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

namespace fs = std::filesystem;
using namespace test_support;
using testing::ElementsAre;
using Events = std::vector<RecordedEvent>;

constexpr const char* kLaunchFile = R"(<launch>
  <trace session-name="service" context-fields="procname vpid vtid" subbuffer-size-ust="1048576"/>
  <node pkg="demo_nodes" exec="add_two_ints_server" name="server"/>
  <node pkg="demo_nodes" exec="add_two_ints_client" name="client" on_exit="shutdown">
    <param name="count" value="3"/>
  </node>
</launch>
)";

bool is_publication(const RecordedEvent& event) {
  return event.name == "ros2:rclcpp_publish" || event.name == "ros2:rcl_publish" || event.name == "ros2:rmw_publish";
}

// The events of a process's main thread, without those of its publications: log lines, parameter events, the graph.
Events events_of(const RecordedTrace& trace, const std::string& procname) {
  Events events;
  for (const RecordedEvent& event : trace.events) {
    if (event.procname == procname && event.vpid == event.vtid && !is_publication(event)) {
      events.push_back(event);
    }
  }
  return events;
}

std::vector<std::string> names(const Events& events) {
  std::vector<std::string> result;
  for (const RecordedEvent& event : events) {
    result.push_back(event.name.substr(event.name.find(':') + 1));
  }
  return result;
}

Events all_of(const Events& events, const std::string& name, const std::string& field, std::uint64_t value) {
  Events found;
  for (const RecordedEvent& event : events) {
    if (event.name == "ros2:" + name && event.number(field) == value) {
      found.push_back(event);
    }
  }
  return found;
}

// The events of the creation of a service, from the first one; fails the test if there are none.
std::optional<Events> creation_of(const Events& events, const std::string& service) {
  for (std::size_t i = 0; i + 2 < events.size(); ++i) {
    if (events[i].name == "ros2:rcl_service_init" && events[i].text("service_name") == service) {
      return Events{events[i], events[i + 1], events[i + 2]};
    }
  }
  ADD_FAILURE() << "no service " << service;
  return std::nullopt;
}

// One line per entity that a node makes by itself.
std::vector<std::string> initial_entities(const Events& events) {
  std::vector<std::string> result;
  for (const RecordedEvent& event : events) {
    if (event.name == "ros2:rcl_publisher_init") {
      result.push_back("publisher " + event.text("topic_name"));
    } else if (event.name == "ros2:rcl_service_init") {
      result.push_back("service " + event.text("service_name"));
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
  const RecordedTrace trace = read_trace(sandbox.trace_directory() / "service");
  EXPECT_EQ(trace.losses, 0U);
  const Events server = events_of(trace, "add_two_ints_se");
  const Events client = events_of(trace, "add_two_ints_cl");

  // The entities that a node makes by itself, in this order.
  EXPECT_THAT(
      initial_entities(server),
      ElementsAre("publisher /rosout", "service /server/get_parameters", "service /server/get_parameter_types",
                  "service /server/set_parameters", "service /server/set_parameters_atomically",
                  "service /server/describe_parameters", "service /server/list_parameters",
                  "publisher /parameter_events", "service /server/get_type_description", "service /add_two_ints"));

  const auto service = creation_of(server, "/add_two_ints");
  ASSERT_TRUE(service);
  EXPECT_THAT(names(*service),
              ElementsAre("rcl_service_init", "rclcpp_service_callback_added", "rclcpp_callback_register"));
  const std::uint64_t rmw_service = service->at(0).number("rmw_service_handle");
  const std::uint64_t callback = service->at(1).number("callback");
  EXPECT_EQ(service->at(1).number("service_handle"), service->at(0).number("service_handle"));
  EXPECT_EQ(service->at(2).number("callback"), callback);
  EXPECT_NE(service->at(2).text("symbol"), "");

  std::vector<std::uint64_t> gid;
  std::uint64_t rmw_client = 0;
  for (std::size_t i = 0; i + 1 < client.size(); ++i) {
    if (client[i].name == "ros2:rmw_client_init") {
      gid = client[i].arrays.at("gid");
      rmw_client = client[i].number("rmw_client_handle");
      EXPECT_EQ(client[i + 1].name, "ros2:rcl_client_init");
      EXPECT_EQ(client[i + 1].number("rmw_client_handle"), rmw_client);
      EXPECT_EQ(client[i + 1].text("service_name"), "/add_two_ints");
    }
  }
  ASSERT_EQ(gid.size(), 16U);

  const Events sent = all_of(client, "rmw_send_request", "rmw_client_handle", rmw_client);
  const Events answered = all_of(client, "rmw_take_response", "rmw_client_handle", rmw_client);
  ASSERT_EQ(sent.size(), 3U);
  ASSERT_EQ(answered.size(), 3U);
  std::size_t request = 0;
  for (std::size_t i = 1; i + 3 < server.size(); ++i) {
    if (server[i].name != "ros2:rmw_take_request") {
      continue;
    }
    ASSERT_LT(request, 3U);
    const Events exchange(server.begin() + static_cast<std::ptrdiff_t>(i) - 1,
                          server.begin() + static_cast<std::ptrdiff_t>(i) + 4);
    // The execution of a service has no event of its own.
    EXPECT_THAT(names(exchange), ElementsAre("rclcpp_executor_get_next_ready", "rmw_take_request", "callback_start",
                                             "callback_end", "rmw_send_response"));
    EXPECT_EQ(exchange[1].number("rmw_service_handle"), rmw_service);
    EXPECT_EQ(exchange[1].number("taken"), 1U);
    EXPECT_EQ(exchange[2].number("callback"), callback);
    EXPECT_EQ(exchange[2].number("is_intra_process"), 0U);
    for (const RecordedEvent* event : {&exchange[1], &exchange[4]}) {
      EXPECT_EQ(event->arrays.at("client_gid"), gid);
      EXPECT_EQ(event->number("sequence_number"), request + 1);
    }
    EXPECT_EQ(sent[request].number("sequence_number"), request + 1);
    EXPECT_EQ(answered[request].number("sequence_number"), request + 1);
    EXPECT_EQ(answered[request].number("taken"), 1U);
    EXPECT_EQ(answered[request].number("source_timestamp"), exchange[4].number("timestamp"));
    ++request;
  }
  EXPECT_EQ(request, 3U);
}

}  // namespace
