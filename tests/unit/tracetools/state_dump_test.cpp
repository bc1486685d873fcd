// SPDX-License-Identifier: Apache-2.0
// A session that starts while a process runs already gets the objects that live at that time.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using test_support::run_command;
using test_support::RunningCommand;
using testing::ElementsAreArray;
using testing::IsEmpty;

using Lines = std::vector<std::string>;

// The events of fire_all_events.cpp about objects, in its order.
const Lines kInitEvents = {
    R"(ros2:rcl_init: { context_handle = 0x1, version = "8.10.1" })",
    R"(ros2:rcl_node_init: { node_handle = 0x1, rmw_handle = 0x2, node_name = "ping", namespace = "/robot" })",
    R"(ros2:rmw_publisher_init: { rmw_publisher_handle = 0x1, gid = GID })",
    R"(ros2:rcl_publisher_init: { publisher_handle = 0x1, node_handle = 0x2, rmw_publisher_handle = 0x3, topic_name = "/ping", queue_depth = 10 })",
    R"(ros2:rmw_subscription_init: { rmw_subscription_handle = 0x1, gid = GID })",
    R"(ros2:rcl_subscription_init: { subscription_handle = 0x1, node_handle = 0x2, rmw_subscription_handle = 0x3, topic_name = "/pong", queue_depth = 5 })",
    R"(ros2:rclcpp_subscription_init: { subscription_handle = 0x1, subscription = 0x2 })",
    R"(ros2:rclcpp_subscription_callback_added: { subscription = 0x1, callback = 0x2 })",
    R"(ros2:rcl_service_init: { service_handle = 0x1, node_handle = 0x2, rmw_service_handle = 0x3, service_name = "/add" })",
    R"(ros2:rclcpp_service_callback_added: { service_handle = 0x1, callback = 0x2 })",
    R"(ros2:rmw_client_init: { rmw_client_handle = 0x1, gid = GID })",
    R"(ros2:rcl_client_init: { client_handle = 0x1, node_handle = 0x2, rmw_client_handle = 0x3, service_name = "/add" })",
    R"(ros2:rcl_timer_init: { timer_handle = 0x1, period = 500000000 })",
    R"(ros2:rclcpp_timer_callback_added: { timer_handle = 0x1, callback = 0x2 })",
    R"(ros2:rclcpp_timer_link_node: { timer_handle = 0x1, node_handle = 0x2 })",
    R"x(ros2:rclcpp_callback_register: { callback = 0x1, symbol = "(null)" })x",
    R"(ros2:rcl_lifecycle_state_machine_init: { node_handle = 0x1, state_machine = 0x2 })",
    R"(ros2_ext:rcl_lifecycle_state: { state_machine = 0x1, label = "configuring" })",
    R"(ros2:rclcpp_ipb_to_subscription: { ipb = 0x1, subscription = 0x2 })",
    R"(ros2:rclcpp_buffer_to_ipb: { buffer = 0x1, ipb = 0x2 })",
    R"(ros2:rclcpp_construct_ring_buffer: { buffer = 0x1, capacity = 18446744073709551615 })",
    R"(ros2:message_link_periodic_async: { _subs_length = 2, subs = [ [0] = 0x51, [1] = 0x52 ], _pubs_length = 1, pubs = [ [0] = 0x61 ] })",
    R"(ros2:message_link_partial_sync: { _subs_length = 1, subs = [ [0] = 0x51 ], _pubs_length = 0, pubs = [ ] })",
    R"(ros2_ext:rmw_service_init: { rmw_service_handle = 0x1, gid = GID })",
    R"(ros2_ext:rmw_publisher_qos: { rmw_publisher_handle = 0x1, reliable = 1, history_depth = 10, transient_local = 0 })",
    R"(ros2_ext:rmw_subscription_qos: { rmw_subscription_handle = 0x1, reliable = 0, history_depth = 0, transient_local = 1, is_filtered = 1 })",
};
constexpr const char* kGid =
    "[ [0] = 1, [1] = 2, [2] = 3, [3] = 4, [4] = 5, [5] = 6, [6] = 7, [7] = 8, [8] = 9, [9] = 10, [10] = 11, [11] = "
    "12, "
    "[12] = 0, [13] = 0, [14] = 30, [15] = 255 ]";

Lines state_dump(const Lines& events) {
  const std::string count = "{ events = " + std::to_string(events.size()) + " }";
  Lines dump = {"ros2_ext:state_dump_begin: " + count};
  dump.insert(dump.end(), events.begin(), events.end());
  dump.push_back("ros2_ext:state_dump_end: " + count);
  return dump;
}

Lines twice(Lines lines) {
  const Lines once = lines;
  lines.insert(lines.end(), once.begin(), once.end());
  return lines;
}

struct StateDump : testing::Test {
  void run(const std::vector<std::string>& argv) {
    const auto result = run_command(argv);
    ASSERT_EQ(result.exit_code, 0) << testing::PrintToString(argv) << result.out << result.err;
  }

  void create_session(const std::string& name) {
    run({"lttng", "create", name, "--output=" + (sandbox.directory() / name).string()});
    run({"lttng", "enable-event", "--userspace", "ros2:*,ros2_ext:*", "--session=" + name});
  }

  // The application takes the commands of the session daemon one after the other, and dumps its state before it takes
  // the next one. So the dump for `lttng start` is recorded when `lttng stop` returns.
  void finish_session(const std::string& name) {
    run({"lttng", "stop", name});
    run({"lttng", "destroy", name});
  }

  // The recorded events, "provider:event: { fields }" each.
  Lines recorded(const std::string& name) {
    const auto text = run_command({"babeltrace2", (sandbox.directory() / name).string()});
    EXPECT_EQ(text.exit_code, 0) << text.err;
    Lines lines;
    std::istringstream stream(text.out);
    for (std::string line; std::getline(stream, line);) {
      const std::size_t event = line.find(" ros2");
      const std::size_t cpu = line.find("{ cpu_id", event);
      std::string fields = line.substr(line.find("}, ", cpu) + 3);
      if (const std::size_t gid = fields.find(kGid); gid != std::string::npos) {
        fields.replace(gid, std::string(kGid).size(), "GID");
      }
      lines.push_back(line.substr(event + 1, cpu - event - 1) + fields);
    }
    return lines;
  }

  test_support::Sandbox sandbox;
};

TEST_F(StateDump, TellsALateSessionOfAllObjectsInTheOrderOfTheirCreation) {
  run({"lttng-sessiond", "--daemonize"});
  RunningCommand process({.argv = {FIRE_ALL_EVENTS, "--stay"}});
  ASSERT_TRUE(process.wait_for_output("ready"));
  create_session("late");
  run({"lttng", "start", "late"});
  finish_session("late");
  process.close_input();
  EXPECT_EQ(process.wait().exit_code, 0);
  EXPECT_THAT(recorded("late"), ElementsAreArray(state_dump(kInitEvents)));
}

TEST_F(StateDump, ComesForASessionDaemonThatIsYoungerThanTheProcess) {
  RunningCommand process({.argv = {FIRE_ALL_EVENTS, "--stay"}});
  ASSERT_TRUE(process.wait_for_output("ready"));
  run({"lttng-sessiond", "--daemonize"});
  // lttng-ust tries again to reach a daemon every few seconds, or as soon as the daemon wakes it.
  for (;;) {
    const auto list = run_command({"lttng", "list", "--userspace"});
    ASSERT_EQ(list.exit_code, 0) << list.err;
    if (list.out.find("ros2:rcl_init") != std::string::npos) {
      break;
    }
  }
  create_session("late");
  run({"lttng", "start", "late"});
  finish_session("late");
  EXPECT_THAT(recorded("late"), ElementsAreArray(state_dump(kInitEvents)));
}

TEST_F(StateDump, CanBeAskedForAgain) {
  run({"lttng-sessiond", "--daemonize"});
  RunningCommand process({.argv = {FIRE_ALL_EVENTS, "--stay"}});
  ASSERT_TRUE(process.wait_for_output("ready"));
  create_session("late");
  run({"lttng", "start", "late"});
  run({"lttng", "regenerate", "statedump", "--session=late"});
  finish_session("late");
  EXPECT_THAT(recorded("late"), ElementsAreArray(twice(state_dump(kInitEvents))));
}

// Such a session has the objects from their beginning, and has never got a dump.
TEST_F(StateDump, CanBeAskedForByASessionThatWasThereBeforeTheProcess) {
  run({"lttng-sessiond", "--daemonize"});
  create_session("early");
  run({"lttng", "start", "early"});
  RunningCommand process({.argv = {FIRE_ALL_EVENTS, "--stay"}});
  ASSERT_TRUE(process.wait_for_output("ready"));
  run({"lttng", "regenerate", "statedump", "--session=early"});
  // A pause is no wish for all objects.
  run({"lttng", "stop", "early"});
  run({"lttng", "start", "early"});
  finish_session("early");
  const Lines events = recorded("early");
  const Lines dump = state_dump(kInitEvents);
  ASSERT_GT(events.size(), dump.size());
  EXPECT_THAT(Lines(events.end() - static_cast<std::ptrdiff_t>(dump.size()), events.end()), ElementsAreArray(dump));
  EXPECT_EQ(std::count(events.begin(), events.end(), dump.front()), 1);
}

TEST_F(StateDump, LeavesOutObjectsThatAreGone) {
  run({"lttng-sessiond", "--daemonize"});
  RunningCommand process({.argv = {FIRE_ALL_EVENTS, "--stay-empty"}});
  ASSERT_TRUE(process.wait_for_output("ready"));
  create_session("late");
  run({"lttng", "start", "late"});
  finish_session("late");
  EXPECT_THAT(recorded("late"), IsEmpty());
}

// Threads make and end objects while sessions start and ask again. An object whose end is recorded must not be dumped
// afterwards. An object that lives at the end is in the last dump.
TEST_F(StateDump, AgreesWithObjectsThatComeAndGo) {
  run({"lttng-sessiond", "--daemonize"});
  create_session("busy");
  RunningCommand process({.argv = {OBJECTS_COME_AND_GO}});
  ASSERT_TRUE(process.wait_for_output("ready"));
  run({"lttng", "start", "busy"});
  for (int i = 0; i < 5; ++i) {
    run({"lttng", "regenerate", "statedump", "--session=busy"});
  }
  process.close_input();
  ASSERT_TRUE(process.wait_for_output("rest"));
  run({"lttng", "regenerate", "statedump", "--session=busy"});
  finish_session("busy");
  process.send_signal(SIGTERM);
  EXPECT_EQ(process.wait().err, "");

  const Lines events = recorded("busy");
  EXPECT_GE(std::count_if(events.begin(), events.end(),
                          [](const std::string& event) { return event.starts_with("ros2_ext:state_dump_begin"); }),
            7);
  EXPECT_THAT(Lines(events.end() - 4, events.end()),
              ElementsAreArray(state_dump({"ros2:rcl_timer_init: { timer_handle = 0x1, period = 1 }",
                                           "ros2:rcl_timer_init: { timer_handle = 0x2, period = 2 }"})));
  // Each handle is used once, so an init event after the end of its object is a dead object in a dump.
  std::set<std::string> ended;
  for (const std::string& event : events) {
    const std::size_t begin = event.find("timer_handle = ");
    if (begin == std::string::npos) {
      continue;
    }
    const std::string handle = event.substr(begin, event.find_first_of(", ", begin + 15) - begin);
    if (event.starts_with("ros2_ext:rcl_timer_fini")) {
      ended.insert(handle);
    }
    if (event.starts_with("ros2:rcl_timer_init")) {
      EXPECT_EQ(ended.count(handle), 0U) << event;
    }
  }
  EXPECT_FALSE(ended.empty());
}

}  // namespace
