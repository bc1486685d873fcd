// SPDX-License-Identifier: Apache-2.0
// Each expectation of a test on a system in which nothing happens: it fails, unless it expects just that.
#include <gmock/gmock.h>

#include <array>
#include <nlohmann/json.hpp>

#include "tests/e2e/testing/launch_test_fixture.hpp"

namespace {

using namespace test_support;

struct Case {
  const char* expectation;
  const char* message;  // of the failure; "" if the test passes
};

// A node waits for messages, another process waits for nothing. What a test waits for does not come within its timeout.
// A trace needs the node: a test of one waits for it.
constexpr std::array kCases = {
    Case{R"(duration="0.5"><exit process="p" within="0.3"/>)", "'p' has not exited within 0.3 s"},
    Case{R"(duration="0.5"><exit process="p" when="shutdown" code="7"/>)", "'p' has exited with signal SIGINT"},
    Case{R"(duration="0.5"><output text="never" within="0.3"/>)", "there was not a line with 'never' within 0.3 s"},
    Case{R"(duration="0.5"><output text="never" when="shutdown"/>)",
         "there was not a line with 'never' at the shutdown"},
    Case{R"(duration="0.5"><output text="never" absent="true"/>)", ""},
    Case{R"(duration="0.5"><output text="never" max="2"/>)", ""},
    Case{R"(timeout="2"><in_order process="p"><line text="a"/><line text="b"/></in_order>)",
         "line 1 of 2 did not come from 'p' within 2 s, the timeout of the test"},
    Case{R"(duration="0.5"><graph node="/map" within="0.3"/>)", "it did not happen within 0.3 s: node '/map' is there"},
    Case{R"(duration="0.5"><graph topic="/map" within="0.3"/>)",
         "it did not happen within 0.3 s: topic '/map' is published"},
    Case{R"(duration="0.5"><graph service="/map" within="0.3"/>)",
         "it did not happen within 0.3 s: service '/map' is offered"},
    Case{R"(duration="0.5"><graph node="/pong" state="active" within="0.3"/>)",
         "it did not happen within 0.3 s: '/pong' is active"},
    Case{R"(duration="0.5"><graph node="/pong" parameter="rate" value="20" within="0.3"/>)",
         "it did not happen within 0.3 s: parameter 'rate' of '/pong' is 20"},
    Case{R"(duration="0.5"><graph node="/map" absent="true"/>)", ""},
    Case{R"(duration="0.5"><message topic="/ping" type="std_msgs/msg/Int64" within="0.3"/>)",
         "there was not a message on '/ping' within 0.3 s"},
    Case{R"(timeout="2"><message topic="/ping" type="std_msgs/msg/Int64" absent="true"/>)",
         "a message on '/ping' could not come"},
    Case{R"(timeout="2"><message topic="/ping" type="std_msgs/msg/Int64" max="3"/>)",
         "a message on '/ping' could not come"},
    Case{R"(duration="0.5"><message topic="/ping" type="std_msgs/msg/Int64" absent="true" without_publisher="true"/>)",
         ""},
    Case{R"(timeout="2"><message topic="/ping" type="std_msgs/msg/Int64" min_rate="3"/>)",
         "there was not 2 times a message on '/ping' within 2 s, the timeout of the test"},
    Case{R"(timeout="2"><message topic="/ping" type="std_msgs/msg/Int64" max_rate="3"/>)",
         "there was not 2 times a message on '/ping' within 2 s, the timeout of the test"},
    Case{R"(duration="0.5"><resources process="p" max_memory="1G" max_processor_time="2"/>)", ""},
    Case{R"(duration="0.5"><resources process="p" max_memory="1K"/>)", "p-2 has used too much memory"},
    Case{R"(timeout="30"><graph node="/pong"/><event name="ros2:callback_start"/>)",
         "the trace does not hold the events 'ros2:callback_start' as expected"},
    Case{R"(timeout="30"><graph node="/pong"/><event name="ros2:callback_start" max="0"/>)", ""},
    Case{R"(timeout="30"><graph node="/pong"/><event name="ros2:rcl_node_init" max="0"/>)",
         "the trace does not hold the events 'ros2:rcl_node_init' as expected"},
    Case{R"(timeout="30"><graph node="/pong"/><event name="ros2:rcl_node_init" where="nope == 3" max="0"/>)",
         "the trace does not hold the events 'ros2:rcl_node_init' as expected"},
    Case{
        R"(timeout="30"><graph node="/pong"/><events_in_order><event name="ros2:rcl_init"/><event name="ros2:callback_start"/></events_in_order>)",
        "the events do not come in this order"},
    Case{R"(timeout="30"><graph node="/pong"/><delivery topic="/ping"/>)", "too few messages of '/ping' have arrived"},
    Case{R"(timeout="30"><graph node="/pong"/><delivery topic="/ping" max_lost="0"/>)",
         "too few messages of '/ping' have arrived"},
    Case{R"(timeout="30"><graph node="/pong"/><latency topic="/ping" max_ms="5"/>)",
         "messages of '/ping' do not take the time that is expected"},
    Case{R"(timeout="30"><graph node="/pong"/><latency nodes="/ping /pong" max_ms="5"/>)",
         "the chain /ping /pong was not gone through"},
    Case{R"(timeout="30"><graph node="/pong"/><callback node="/pong" topic="/ping" max_ms="5"/>)",
         "callbacks do not take the time that is expected"},
    Case{R"(timeout="30"><graph node="/pong"/><timer_period node="/pong" period_ms="100" jitter_ms="5"/>)",
         "the timer of 100 ms of '/pong' has not fired twice"},
    Case{R"(timeout="30"><graph node="/pong"/><timer_period node="/pong" period_ms="100" max_missed="0"/>)",
         "the timer of 100 ms of '/pong' has not fired twice"},
    Case{R"(timeout="30"><graph node="/pong"/><allocations node="/pong" state="active" max="0"/>)",
         "'/pong' was never active"},
    Case{R"(timeout="30"><graph node="/pong"/><allocations node="/pong" state="any" max="0"/>)",
         "no callback of '/pong' has run"},
};

class NothingHappens : public LaunchTestFixture {};

TEST_F(NothingHappens, FailsEveryExpectationButThatOfNothing) {
  std::string tests = R"(
  <node pkg="demo_nodes" exec="pong" name="pong"/>
  <executable name="p" cmd="sleep 1000"/>)";
  for (std::size_t i = 0; i < kCases.size(); ++i) {
    tests += "\n  <test name=\"" + std::to_string(i) + "\" " + kCases[i].expectation + "</test>";
  }
  const std::string json = sandbox_.directory() / "result.json";
  const CommandResult result = run({write("a.launch.xml", tests), "-j", "8", "--json", json});
  EXPECT_EQ(result.exit_code, 1);
  ASSERT_TRUE(std::filesystem::exists(json)) << result.err;
  const auto results = nlohmann::json::parse(read_file(json))["tests"];
  ASSERT_EQ(results.size(), kCases.size());
  for (std::size_t i = 0; i < kCases.size(); ++i) {
    const nlohmann::json& failures = results[i]["failures"];
    const std::string first = failures.empty() ? "" : failures[0].value("message", "");
    EXPECT_EQ(first, kCases[i].message) << kCases[i].expectation << results[i].dump(2);
    EXPECT_LE(failures.size(), 1U) << results[i].dump(2);
  }
}

}  // namespace
