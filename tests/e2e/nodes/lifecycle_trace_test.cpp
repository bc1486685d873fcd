// SPDX-License-Identifier: Apache-2.0
// The trace of a managed node: its state machine, and each of its steps.
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
  <trace session-name="lifecycle" context-fields="procname vpid vtid" subbuffer-size-ust="1048576"/>
  <node pkg="lifecycle" exec="lifecycle_talker" name="led" namespace="/here"/>
  <node pkg="lifecycle" exec="lifecycle_service_client" on_exit="shutdown">
    <param name="node" value="/here/led"/>
    <param name="period_ms" value="0"/>
  </node>
</launch>
)";

// Events of the managed node's process, in the thread that made it.
EventQuery of_talker(const std::string& name) {
  return of_main_thread("lifecycle_talker", name);
}

std::vector<std::string> texts(const std::vector<const Event*>& events, const std::string& field) {
  std::vector<std::string> texts;
  for (const Event* const event : events) {
    texts.push_back(event->text(field));
  }
  return texts;
}

TEST(LifecycleTrace, TellsOfTheStateMachineAndItsTransitions) {
  Sandbox sandbox;
  const fs::path file = sandbox.directory() / "lifecycle.launch.xml";
  std::ofstream(file) << kLaunchFile;
  const CommandResult result = run_command({LAUNCH_PROGRAM, file.string()});
  ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
  const Trace trace(sandbox.trace_directory() / "lifecycle");
  EXPECT_THAT(trace, LostNothing());

  ASSERT_THAT(trace, HasEvents(of_talker("rcl_node_init"), exactly(1)));
  const Event& node = *of_talker("rcl_node_init").first(trace);
  EXPECT_EQ(node.text("node_name"), "led");
  EXPECT_EQ(node.text("namespace"), "/here");
  ASSERT_THAT(trace, HasEvents(of_talker("rcl_lifecycle_state_machine_init"), exactly(1)));
  const Event& init = *of_talker("rcl_lifecycle_state_machine_init").first(trace);
  EXPECT_THAT(init.event_class().fields, ElementsAre("node_handle", "state_machine"));
  EXPECT_EQ(init.handle("node_handle"), node.handle("node_handle"));
  const std::uint64_t machine = init.handle("state_machine");
  EXPECT_NE(machine, 0U);

  // Its services and its topic exist already.
  std::vector<std::string> services = texts(of_talker("rcl_service_init").before(init).select(trace), "service_name");
  ASSERT_GE(services.size(), 5U);
  services.erase(services.begin(), services.end() - 5);
  EXPECT_THAT(services, ElementsAre("/here/led/change_state", "/here/led/get_state", "/here/led/get_available_states",
                                    "/here/led/get_available_transitions", "/here/led/get_transition_graph"));
  const Event& publisher = *of_talker("rcl_publisher_init").before(init).select(trace).back();
  EXPECT_EQ(publisher.text("topic_name"), "/here/led/transition_event");
  EXPECT_EQ(publisher.handle("node_handle"), init.handle("node_handle"));

  // Each step is published before it is traced.
  const std::vector<const Event*> steps = of_talker("rcl_lifecycle_transition").select(trace);
  const EventQuery publications = of_talker("rcl_publish").with("publisher_handle", publisher.at("publisher_handle"));
  for (std::size_t i = 0; i < steps.size(); ++i) {
    EXPECT_EQ(EventQuery(publications).before(*steps[i]).select(trace).size(), i + 1);
  }
  EXPECT_THAT(
      texts(steps, "start_label"),
      ElementsAre("unconfigured", "configuring", "inactive", "activating", "active", "deactivating", "inactive",
                  "activating", "active", "deactivating", "inactive", "cleaningup", "unconfigured", "shuttingdown"));
  EXPECT_THAT(texts(steps, "goal_label"), ElementsAre("configuring", "inactive", "activating", "active", "deactivating",
                                                      "inactive", "activating", "active", "deactivating", "inactive",
                                                      "cleaningup", "unconfigured", "shuttingdown", "finalized"));
  EXPECT_THAT(trace, EachEvent(of_talker("rcl_lifecycle_transition"), event("").with("state_machine", machine)));
}

}  // namespace
