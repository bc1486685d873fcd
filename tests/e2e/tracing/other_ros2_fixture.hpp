// SPDX-License-Identifier: Apache-2.0
// The common part of the tests of nodes of other ROS 2 distributions. The nodes are programs of
// tests/support/other_ros2/, which call tracetools as rclcpp of each distribution does.
#pragma once

#include <gmock/gmock.h>
#include <signal.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/support/command.hpp"
#include "tests/support/recorded_trace.hpp"
#include "tests/support/sandbox.hpp"

namespace other_ros2 {

namespace fs = std::filesystem;
using namespace test_support;
using nlohmann::json;
using testing::AllOf;
using testing::Contains;
using testing::ContainsRegex;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;
using testing::UnorderedElementsAre;

inline std::map<std::string, RecordedEvent> first_of_each(const RecordedTrace& trace) {
  std::map<std::string, RecordedEvent> events;
  for (const RecordedEvent& event : trace.events) {
    events.emplace(event.name, event);
  }
  return events;
}

class OtherRos2 : public testing::Test {
 protected:
  std::string write(const std::string& actions) const {
    const fs::path path = sandbox_.directory() / "system.launch.xml";
    write_file(path, "<launch>\n" + actions + "\n</launch>\n");
    return path.string();
  }

  static fs::path prefix_of(const std::string& distribution) { return fs::path(OTHER_ROS2) / distribution; }

  static std::string node(const fs::path& prefix, const std::string& arguments, const std::string& name = "talker",
                          const std::string& program = "talker") {
    return "<executable name=\"" + name + "\" output=\"screen\" cmd=\"" + (prefix / "lib/demo" / program).string() +
           " " + arguments + "\"><env name=\"LD_LIBRARY_PATH\" value=\"" + (prefix / "lib").string() +
           "\"/></executable>\n";
  }

  json verdict(const std::string& session = "run") const {
    return json::parse(read_file(sandbox_.trace_directory() / session / "verdict.json"));
  }

  RecordedTrace trace(const std::string& session) const { return read_trace(sandbox_.trace_directory() / session); }

  // A session that begins when the node runs, and records cycles of it.
  void record_late(RunningCommand& launch) {
    RunningCommand late({.argv = {LAUNCH_PROGRAM, "trace", "-s", "late", "-u", "ros2:*"}});
    ASSERT_TRUE(late.wait_for_output("press enter to start..."));
    late.write("\n");
    ASSERT_TRUE(late.wait_for_output("press enter to stop...")) << late.out() << late.err();
    wait_for_cycles(launch, 200);
    late.write("\n");
    ASSERT_EQ(late.wait().exit_code, 0) << late.out() << late.err();
  }

  static void wait_for_cycles(RunningCommand& launch, int number) {
    const std::string word = "cycle ";
    const std::size_t last = launch.out().rfind(word);
    const int done = last == std::string::npos ? 0 : std::stoi(launch.out().substr(last + word.size()));
    ASSERT_TRUE(launch.wait_for_output(word + std::to_string(done + number) + ".")) << launch.out() << launch.err();
  }

  static void expect_end(RunningCommand& launch) {
    launch.send_signal(SIGINT);
    const CommandResult result = launch.wait();
    EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  }

  Sandbox sandbox_;
};

}  // namespace other_ros2
