// SPDX-License-Identifier: Apache-2.0
// Every example runs, in both formats, and does what the table of launch_examples/README.md says.
#include <gmock/gmock.h>

#include <ostream>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"
#include "tests/support/sanitized.hpp"

namespace {

using test_support::CommandResult;
using testing::HasSubstr;

struct Example {
  const char* name;
  std::vector<std::string> arguments;
  std::vector<std::string> expected;  // parts of the output
};

void PrintTo(const Example& row, std::ostream* out) {
  *out << row.name;
}

class Examples : public testing::TestWithParam<std::tuple<Example, const char*>> {};

TEST_P(Examples, DoWhatTheReadmeSays) {
  test_support::Sandbox sandbox;
  const auto& [example, format] = GetParam();
  const std::string name = example.name;
  if (test_support::kSanitized && (name == "06_trace_options" || name == "26_trace_action")) {
    GTEST_SKIP() << test_support::kMallocIsTaken;
  }
  std::vector<std::string> argv = {LAUNCH_PROGRAM,
                                   std::string(EXAMPLES_DIRECTORY "/") + example.name + ".launch." + format};
  argv.insert(argv.end(), example.arguments.begin(), example.arguments.end());
  const CommandResult result = test_support::run_command(argv);
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_EQ(result.err, "");
  for (const std::string& part : example.expected) {
    EXPECT_THAT(result.out, HasSubstr(part));
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, Examples,
    testing::Combine(
        testing::Values(
            Example{"02_names",
                    {"seconds:=10"},
                    {"[listener-2] ", "[listener-3] ",
                     "[left.ear]: I heard: [Hello World: ", "[right.ear]: I heard: [Hello World: "}},
            Example{"03_conditions",
                    {"verbose:=yes"},
                    {"mode sim, rate 10", "inside the group the rate is 1000", "outside it is still 10"}},
            Example{"04_include", {}, {"mode robot, rate 50", "after the include, mode is robot"}},
            Example{"05_processes",
                    {},
                    {"[greeter-1] hello", "[greeter-1] world", "[clock-2] tick", "that was it",
                     "sending signal 'SIGINT' to process[waiter-3]"}},
            Example{"06_trace_options", {}, {"trace written to: "}},
            Example{"07_services",
                    {},
                    {"the client will ask 3 times", "[add_two_ints_server]: 2 + 3 = 5",
                     "[add_two_ints_client]: 2 + 3 = 5"}},
            Example{"08_composition",
                    {},
                    {"Loaded node '/talker' in container '/container'",
                     "Loaded node '/ear/listener' in container '/container'",
                     "[ear.listener]: I heard: [Hello World: ", "trace is complete"}},
            Example{"09_events",
                    {},
                    {"[calibrate-1] calibrated", "[server-2] listening", "[client-3] asking",
                     "client-3 is done, the server may go", "sending signal 'SIGINT' to process[server-2]",
                     "[park-4] parked"}},
            Example{"10_action",
                    {"cancel_after:=2"},
                    {"[fibonacci_action_server]: Received goal request with order 8",
                     "[fibonacci_action_client]: Feedback: 0 1 1",
                     "[fibonacci_action_client]: Goal was canceled: 0 1 1 2", "trace written to: "}},
            Example{"11_lifecycle",
                    {},
                    {"waits until '/lc_talker' is active", "[lc_talker]: on_activate() is called.",
                     "[lc_listener]: data_callback: Lifecycle HelloWorld #",
                     "Transition from state shuttingdown to finalized", "trace is complete"}},
            Example{"12_reference_system",
                    {"messages:=2"},
                    {"[VehicleDBWSystem]: ", " messages from FrontLidarDriver: min ", "trace written to: "}},
            Example{"20_flight_recorder", {}, {"snapshot written to: ", "(unlucky-3 died of SIGSEGV)"}},
            Example{"21_trace_channels", {}, {"trace is complete: no events lost"}},
            Example{
                "22_lost_events", {}, {"trace is incomplete: ", "lost in ust channel ros2", " would have held them"}},
            Example{"23_dual_session", {}, {"no trace was written: no snapshot was taken"}},
            Example{"26_trace_action",
                    {},
                    {"answered after", "process[ping-2] was required", "trace is complete: no events lost"}},
            Example{"27_late_start",
                    {},
                    {"I heard: [Hello World: ", "writing tracing session to: ", ", 2 processes, none lost)"}},
            Example{"28_deadline", {}, {"snapshot written to: ", "(a message was taken after more than 0.01 ms)"}},
            Example{"29_ros2_tracing",
                    {},
                    {"[test_pong]: [output] are you there?", "[test_ping]: [output] yes, here I am",
                     "trace written to: ", "/my-tracing-session (", "trace is complete: no events lost"}},
            Example{"45_crash", {"--ignore-failures"}, {"crash bundle of unlucky-2: ", "(unlucky-2 died of SIGSEGV)"}},
            Example{"54_health",
                    {"--ignore-failures"},
                    {"process is unhealthy: an executor has not woken up for a timer",
                     "restarting the process, because it is unhealthy", "talker-1 runs again"}},
            Example{"55_limits", {}, {"waits until 'talker' is healthy", "I heard: [Hello World: "}},
            Example{"56_attach", {"seconds:=1"}, {"[calculator-2]: process started"}},
            Example{"57_groups", {"seconds:=1.5"}, {"[worker-3] copy 1 works"}},
            Example{"59_machines",
                    {"arm:=env", std::string("launch:=") + LAUNCH_PROGRAM},
                    {"[arm:camera-1] the camera runs on ", "[wheels-2] the wheels wait no longer, on "}},
            Example{"58_companion",
                    {"container:=component_container_mt"},
                    {"[order-2] the talker can be heard", "Loaded node '/listener' in container '/box'",
                     "[listener]: I heard: [Hello World: "}}),
        testing::Values("xml", "yaml")),
    [](const auto& row) { return std::string(std::get<0>(row.param).name + 3) + "_" + std::get<1>(row.param); });

}  // namespace
