// SPDX-License-Identifier: Apache-2.0
// Events of plain fields are recorded without LTTng's generated probes. Sessions get what these would have recorded.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using test_support::run_command;
using test_support::RunningCommand;
using test_support::Sandbox;

void succeed(const std::vector<std::string>& argv) {
  const auto result = run_command(argv);
  ASSERT_EQ(result.exit_code, 0) << testing::PrintToString(argv) << result.out << result.err;
}

struct Recording : testing::Test {
  void SetUp() override { succeed({"lttng-sessiond", "--daemonize"}); }

  void create(const std::string& session) {
    succeed({"lttng", "create", session, "--output=" + (sandbox.directory() / session).string()});
  }
  void enable(const std::string& session, const std::string& event, const std::vector<std::string>& further = {}) {
    std::vector<std::string> argv = {"lttng", "enable-event", "--userspace", event, "--session=" + session};
    argv.insert(argv.end(), further.begin(), further.end());
    succeed(argv);
  }
  // What `fire_all_events` leaves in a trace, without times: "rmw_take: taken = 1" for `fields` = "taken".
  std::vector<std::string> events_of(const std::string& session) const {
    const auto text = run_command({"babeltrace2", "--names=none", (sandbox.directory() / session).string()});
    EXPECT_EQ(text.exit_code, 0) << text.err;
    std::vector<std::string> events;
    std::istringstream stream(text.out);
    for (std::string line; std::getline(stream, line);) {
      const std::size_t name = line.find("ros2:") + 5;
      const std::size_t payload = line.rfind('{');
      events.push_back(line.substr(name, line.find(':', name) - name) + " " + line.substr(payload));
    }
    return events;
  }

  Sandbox sandbox;
};

using Events = std::vector<std::string>;

TEST_F(Recording, LeavesTheDecisionToAFilter) {
  create("some");
  enable("some", "ros2:rmw_take", {"--filter", "taken == 1 && source_timestamp == -1"});
  enable("some", "ros2:rcl_publish", {"--filter", "message != 2"});
  enable("some", "ros2:rcl_take", {"--filter", "message == 1"});
  succeed({"lttng", "start", "some"});
  succeed({FIRE_ALL_EVENTS});
  succeed({"lttng", "destroy", "some"});
  EXPECT_EQ(events_of("some"), (Events{"rmw_take { 0x1, 0xFFFFFFFFFFFFFFFF, -1, 1 }", "rcl_take { 0x1 }"}));
}

TEST_F(Recording, HappensInEachSessionThatWantsTheEvent) {
  create("all");
  enable("all", "ros2:rcl_*take");
  create("filtered");
  enable("filtered", "ros2:rcl_take,ros2:rclcpp_take", {"--filter", "message == 2"});
  create("stopped");
  enable("stopped", "ros2:rcl_take");
  create("one");
  enable("one", "ros2:rcl_take");
  for (const char* const session : {"all", "filtered", "stopped", "one"}) {
    succeed({"lttng", "start", session});
  }
  succeed({FIRE_ALL_EVENTS});
  succeed({"lttng", "stop", "stopped"});
  succeed({FIRE_ALL_EVENTS});
  succeed({"lttng", "destroy", "--all"});
  EXPECT_EQ(events_of("all"), (Events{"rcl_take { 0x1 }", "rcl_take { 0x1 }"}));
  EXPECT_EQ(events_of("filtered"), Events{});
  EXPECT_EQ(events_of("stopped"), (Events{"rcl_take { 0x1 }"}));
  EXPECT_EQ(events_of("one"), (Events{"rcl_take { 0x1 }", "rcl_take { 0x1 }"}));
}

// An event goes to each channel of a session, with the fields of its context.
TEST_F(Recording, HappensInEachChannel) {
  create("channels");
  succeed({"lttng", "enable-channel", "--userspace", "first"});
  succeed({"lttng", "enable-channel", "--userspace", "second"});
  enable("channels", "ros2:callback_end", {"--channel=first"});
  enable("channels", "ros2:callback_end", {"--channel=second"});
  succeed({"lttng", "add-context", "--userspace", "--channel=second", "--type=vpid"});
  succeed({"lttng", "start", "channels"});
  succeed({FIRE_ALL_EVENTS});
  succeed({"lttng", "destroy", "channels"});
  EXPECT_EQ(events_of("channels"), (Events{"callback_end { 0x1 }", "callback_end { 0x1 }"}));
}

// A trigger needs the values of the fields, too.
TEST_F(Recording, SetsOffATrigger) {
  create("started");
  enable("started", "ros2:callback_end");
  succeed({"lttng", "add-trigger", "--condition=event-rule-matches", "--type=user:tracepoint", "--name=ros2:rmw_take",
           "--filter=source_timestamp == -1", "--action=start-session", "started"});
  succeed({FIRE_ALL_EVENTS});
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  constexpr const char* kActive = "<enabled>true</enabled>";
  std::string list;
  do {
    list = run_command({"lttng", "--mi=xml", "list"}).out;
  } while (list.find(kActive) == std::string::npos && std::chrono::steady_clock::now() < deadline);
  EXPECT_NE(list.find(kActive), std::string::npos) << list;
}

// The first event of a message asks for the memory that the later ones will need. That memory is gone when a session
// is.
TEST_F(Recording, GoesOnWhileSessionsComeAndGo) {
  RunningCommand process(test_support::Command{.argv = {MESSAGES_COME_AND_GO}});
  ASSERT_TRUE(process.wait_for_output("ready"));
  constexpr int kSessions = 8;
  std::size_t most_threads = 0;  // on a busy machine a session may end before each thread had its turn
  for (int i = 0; i < kSessions; ++i) {
    const std::string session = "session" + std::to_string(i);
    create(session);
    enable(session, "ros2:*");
    succeed({"lttng", "add-context", "--userspace", "--session=" + session, "--type=vtid"});
    succeed({"lttng", "start", session});
    succeed({"lttng", "list", "--userspace"});
    succeed({"lttng", "destroy", session});
    // Each thread's events, in the order of a message's way. The first and the last message may be cut off.
    const std::vector<std::string> way = {
        "rclcpp_publish",          "rcl_publish", "rmw_publish", "rclcpp_executor_get_next_ready",
        "rclcpp_executor_execute", "rmw_take",    "rcl_take",    "rclcpp_take",
        "callback_start"};
    const auto text = run_command({"babeltrace2", (sandbox.directory() / session).string()});
    ASSERT_EQ(text.exit_code, 0) << text.err;
    std::map<std::string, std::string> last_of_thread;
    std::istringstream stream(text.out);
    for (std::string line; std::getline(stream, line);) {
      const std::string name = line.substr(line.find("ros2:") + 5, line.find(": {") - line.find("ros2:") - 5);
      std::string& last =
          last_of_thread[line.substr(0, line.find(" }, {", line.find("vtid = "))).substr(line.find("vtid = "))];
      const auto place = std::find(way.begin(), way.end(), last);
      if (place != way.end()) {
        EXPECT_EQ(name, place + 1 == way.end() ? way.front() : *(place + 1)) << line;
      }
      last = name;
    }
    EXPECT_LE(last_of_thread.size(), 3u) << text.out;
    most_threads = std::max(most_threads, last_of_thread.size());
  }
  EXPECT_EQ(most_threads, 3u);
  process.close_input();
  EXPECT_EQ(process.wait().exit_code, 0);
}

}  // namespace
