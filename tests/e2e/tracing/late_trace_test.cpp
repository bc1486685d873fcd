// SPDX-License-Identifier: Apache-2.0
// Tracing that starts when the system already runs: the trace is as readable as one from the beginning.
#include <gmock/gmock.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace test_support;
using nlohmann::json;
using testing::UnorderedElementsAre;

json report_on(const Sandbox& sandbox) {
  const CommandResult report =
      run_command({LAUNCH_PROGRAM, "report", "--json", (sandbox.trace_directory() / "late").string()});
  EXPECT_EQ(report.exit_code, 0) << report.err;
  return json::parse(report.out);
}

// The owner and the name of a callback.
std::string description(const json& callback) {
  std::string owner = callback["owner"];
  if (callback.contains("topic")) {
    owner += " " + callback["topic"].get<std::string>();
  }
  return callback["node"].get<std::string>() + ", " + owner + ": " + callback["symbol"].get<std::string>();
}

class LateTrace : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(listener_.wait_for_output("I heard")) << listener_.out() << listener_.err(); }

  // Records, while the nodes run, at least one message from the timer of one to the callback of the other.
  void record(
      const std::vector<std::string>& events, const std::function<void()>& meanwhile = [] {}) {
    std::vector<std::string> argv = {LAUNCH_PROGRAM, "trace", "-s", "late", "-u"};
    argv.insert(argv.end(), events.begin(), events.end());
    RunningCommand trace({.argv = argv});
    ASSERT_TRUE(trace.wait_for_output("press enter to start..."));
    trace.write("\n");
    ASSERT_TRUE(trace.wait_for_output("press enter to stop...")) << trace.out() << trace.err();
    meanwhile();
    for (int message = 0; message < 3; ++message) {
      wait_for_message();
    }
    trace.write("\n");
    const CommandResult traced = trace.wait();
    ASSERT_EQ(traced.exit_code, 0) << traced.out << traced.err;
  }

  void wait_for_message() {
    ASSERT_TRUE(listener_.wait_for_output("Hello World: " + std::to_string(next_message()) + "]"));
  }

  void expect_readable(const json& report) {
    std::vector<std::string> callbacks;
    for (const json& callback : report["callbacks"]) {
      callbacks.push_back(description(callback));
    }
    EXPECT_THAT(callbacks,
                UnorderedElementsAre(
                    "/talker, timer: demo_nodes_cpp::Talker::Talker(rclcpp::NodeOptions const&)::{lambda()#1}",
                    "/listener, subscription /chatter: demo_nodes_cpp::(anonymous namespace)::listen(rclcpp::Node&, "
                    "rclcpp::QoS const&)::{lambda(std_msgs::msg::String const&)#1}"));
    for (const json& topic : report["topics"]) {
      if (topic["name"] != "/chatter") {
        continue;
      }
      EXPECT_EQ(topic["publishers"], 1);
      EXPECT_EQ(topic["subscriptions"], 1);
      EXPECT_GE(topic["latency"]["count"].get<int>(), 2);
    }
    EXPECT_EQ(report["unknown_messages"], 0);
  }

  int count(const json& report, const std::string& event) {
    for (const json& counted : report["event_counts"]) {
      if (counted["name"] == event) {
        return counted["total"];
      }
    }
    return 0;
  }

  Sandbox sandbox_;
  RunningCommand talker_{{.argv = {std::string(BUILD_DIRECTORY) + "/prefix/lib/demo_nodes/talker"}}};
  RunningCommand listener_{{.argv = {std::string(BUILD_DIRECTORY) + "/prefix/lib/demo_nodes/listener"}}};

 private:
  // The number in the last greeting that was received, plus one.
  int next_message() const {
    const std::string& out = listener_.err();
    const std::string greeting = "Hello World: ";
    return std::stoi(out.substr(out.rfind(greeting) + greeting.size())) + 1;
  }
};

TEST_F(LateTrace, NamesNodesTopicsAndCallbacks) {
  record({"ros2:*"});
  const json report = report_on(sandbox_);
  expect_readable(report);
  EXPECT_EQ(count(report, "ros2:rcl_node_init"), 2);
}

TEST_F(LateTrace, CountsObjectsOnceThatAreToldTwice) {
  record({"ros2:*", "ros2_ext:*"}, [this] {
    wait_for_message();
    const CommandResult again = run_command({"lttng", "regenerate", "statedump", "--session=late"});
    EXPECT_EQ(again.exit_code, 0) << again.out << again.err;
  });
  const json report = report_on(sandbox_);
  expect_readable(report);
  // Each process tells its state when the session starts and when it is asked again. If it is asked before it has told
  // its state for the first time, it tells it once.
  const int dumps = count(report, "ros2_ext:state_dump_begin");
  EXPECT_GE(dumps, 3);
  EXPECT_LE(dumps, 4);
  EXPECT_EQ(count(report, "ros2_ext:state_dump_end"), dumps);
  EXPECT_EQ(count(report, "ros2:rcl_node_init"), dumps);
}

}  // namespace
