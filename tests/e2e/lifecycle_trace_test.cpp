// SPDX-License-Identifier: Apache-2.0
// The trace of a managed node: its state machine, and each of its steps.
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>

#include "tests/e2e/recorded_trace.hpp"
#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

namespace fs = std::filesystem;
using namespace test_support;
using testing::Each;
using testing::ElementsAre;
using Events = std::vector<RecordedEvent>;

constexpr const char* kLaunchFile = R"(<launch>
  <trace session-name="lifecycle" context-fields="procname vpid vtid" subbuffer-size-ust="1048576"/>
  <node pkg="lifecycle" exec="lifecycle_talker" name="led" namespace="/here"/>
  <node pkg="lifecycle" exec="lifecycle_service_client" on_exit="shutdown">
    <param name="node" value="/here/led"/>
    <param name="period_ms" value="0"/>
  </node>
</launch>
)";

// The events of the managed node's process, in the thread that made it.
Events events_of_talker(const RecordedTrace& trace) {
  Events events;
  std::copy_if(trace.events.begin(), trace.events.end(), std::back_inserter(events), [](const RecordedEvent& event) {
    return event.procname == "lifecycle_talke" && event.vpid == event.vtid;
  });
  return events;
}

Events named(const Events& events, const std::string& name) {
  Events found;
  std::copy_if(events.begin(), events.end(), std::back_inserter(found),
               [&](const RecordedEvent& event) { return event.name == "ros2:" + name; });
  return found;
}

TEST(LifecycleTrace, TellsOfTheStateMachineAndItsTransitions) {
  Sandbox sandbox;
  const fs::path file = sandbox.directory() / "lifecycle.launch.xml";
  std::ofstream(file) << kLaunchFile;
  const CommandResult result = run_command({LAUNCH_PROGRAM, file.string()});
  ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
  const RecordedTrace trace = read_trace(sandbox.trace_directory() / "lifecycle");
  EXPECT_EQ(trace.losses, 0U);
  const Events events = events_of_talker(trace);

  const Events nodes = named(events, "rcl_node_init");
  ASSERT_EQ(nodes.size(), 1U);
  EXPECT_EQ(nodes[0].text("node_name"), "led");
  EXPECT_EQ(nodes[0].text("namespace"), "/here");

  const auto init = std::find_if(events.begin(), events.end(), [](const RecordedEvent& event) {
    return event.name == "ros2:rcl_lifecycle_state_machine_init";
  });
  ASSERT_NE(init, events.end());
  EXPECT_EQ(named(events, "rcl_lifecycle_state_machine_init").size(), 1U);
  EXPECT_EQ(init->number("node_handle"), nodes[0].number("node_handle"));
  EXPECT_EQ(init->numbers.size(), 2U);
  const std::uint64_t machine = init->number("state_machine");
  EXPECT_NE(machine, 0U);

  // Its services and its topic exist already.
  std::vector<std::string> services;
  for (const RecordedEvent& event : named(Events(events.begin(), init), "rcl_service_init")) {
    services.push_back(event.text("service_name"));
  }
  ASSERT_GE(services.size(), 5U);
  services.erase(services.begin(), services.end() - 5);
  EXPECT_THAT(services, ElementsAre("/here/led/change_state", "/here/led/get_state", "/here/led/get_available_states",
                                    "/here/led/get_available_transitions", "/here/led/get_transition_graph"));
  const Events publishers = named(Events(events.begin(), init), "rcl_publisher_init");
  EXPECT_EQ(publishers.back().text("topic_name"), "/here/led/transition_event");
  EXPECT_EQ(publishers.back().number("node_handle"), init->number("node_handle"));
  const std::uint64_t publisher = publishers.back().number("publisher_handle");

  std::vector<std::string> steps;
  std::vector<std::uint64_t> machines;
  std::uint64_t published = 0;
  for (const RecordedEvent& event : events) {
    if (event.name == "ros2:rcl_publish" && event.number("publisher_handle") == publisher) {
      ++published;
    } else if (event.name == "ros2:rcl_lifecycle_transition") {
      steps.push_back(event.text("start_label") + " > " + event.text("goal_label"));
      machines.push_back(event.number("state_machine"));
      EXPECT_EQ(published, steps.size());  // each is published before it is traced
    }
  }
  EXPECT_THAT(steps, ElementsAre("unconfigured > configuring", "configuring > inactive", "inactive > activating",
                                 "activating > active", "active > deactivating", "deactivating > inactive",
                                 "inactive > activating", "activating > active", "active > deactivating",
                                 "deactivating > inactive", "inactive > cleaningup", "cleaningup > unconfigured",
                                 "unconfigured > shuttingdown", "shuttingdown > finalized"));
  EXPECT_THAT(machines, Each(machine));
}

}  // namespace
