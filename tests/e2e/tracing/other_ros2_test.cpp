// SPDX-License-Identifier: Apache-2.0
// Nodes of other ROS 2 distributions in a trace, with our tracetools.
#include "tests/e2e/tracing/other_ros2_fixture.hpp"

namespace other_ros2 {
namespace {

struct Distribution {
  const char* name;
  const char* version;
  std::size_t gid_size;     // in its traces
  std::size_t given_bytes;  // of it that the middleware gives
  bool tells_publisher;     // in rmw_publish
  bool traces_services;     // in rmw
};

// Names the test.
void PrintTo(const Distribution& distribution, std::ostream* out) {
  *out << distribution.name;
}

const std::vector<Distribution> kDistributions = {{"humble", "4.1.1", 24, 24, false, false},
                                                  {"iron", "6.3.2", 24, 16, false, false},
                                                  {"jazzy", "8.2.4", 24, 16, true, false},
                                                  {"kilted", "8.6.0", 16, 16, true, true},
                                                  {"newest", "8.10.1", 16, 16, true, true}};

class OfEachDistribution : public OtherRos2, public testing::WithParamInterface<Distribution> {
 protected:
  std::string node(const std::string& arguments) const {
    return OtherRos2::node(prefix_of(GetParam().name), arguments);
  }
};

INSTANTIATE_TEST_SUITE_P(Distributions, OfEachDistribution, testing::ValuesIn(kDistributions),
                         [](const auto& each) { return std::string(each.param.name); });

std::vector<std::string> names_of(const std::map<std::string, std::uint64_t>& numbers) {
  std::vector<std::string> names;
  for (const auto& [name, value] : numbers) {
    names.push_back(name);
  }
  return names;
}

TEST_P(OfEachDistribution, ASessionThatBeginsLaterHasNamesAndTheFieldsOfTheDistribution) {
  RunningCommand launch({.argv = {LAUNCH_PROGRAM, write("<trace session-name=\"run\"/>\n" + node("1000000 1000"))}});
  ASSERT_TRUE(launch.wait_for_output("cycle 100.")) << launch.out() << launch.err();
  record_late(launch);
  expect_end(launch);

  const CommandResult told =
      run_command({LAUNCH_PROGRAM, "report", "--json", (sandbox_.trace_directory() / "late").string()});
  ASSERT_EQ(told.exit_code, 0) << told.err;
  const json report = json::parse(told.out);
  std::vector<std::string> callbacks;
  for (const json& callback : report["callbacks"]) {
    std::string text = callback["node"].get<std::string>() + " " + callback["owner"].get<std::string>();
    text += callback.contains("topic") ? " " + callback["topic"].get<std::string>() : "";
    callbacks.push_back(text + " " + callback["symbol"].get<std::string>());
  }
  EXPECT_THAT(callbacks, AllOf(Contains("/talker timer Talker::talk()"),
                               Contains("/talker subscription /orders Talker::order()")));

  const RecordedTrace late = trace("late");
  std::map<std::string, RecordedEvent> events = first_of_each(late);
  const Distribution& expected = GetParam();
  EXPECT_EQ(events["ros2:rcl_init"].text("version"), expected.version);
  EXPECT_EQ(events["ros2:rcl_publisher_init"].text("topic_name"), "/chatter");
  std::vector<std::uint64_t> gid(expected.gid_size);
  for (std::uint64_t i = 0; i < 16; ++i) {
    gid[i] = 1 + i;
  }
  EXPECT_EQ(events["ros2:rmw_publisher_init"].arrays["gid"], gid);
  if (expected.tells_publisher) {
    EXPECT_THAT(names_of(events["ros2:rmw_publish"].numbers),
                ElementsAre("message", "rmw_publisher_handle", "timestamp"));
    EXPECT_EQ(events["ros2:rmw_publish"].number("rmw_publisher_handle"), 0x21u);
  } else {
    EXPECT_THAT(names_of(events["ros2:rmw_publish"].numbers), ElementsAre("message"));
  }
  EXPECT_EQ(events["ros2:rmw_publish"].number("message"), 0xa0u);
  EXPECT_EQ(events.contains("ros2:rmw_client_init"), expected.traces_services);
  EXPECT_EQ(events.contains("ros2:rmw_take_request"), expected.traces_services);
  std::map<std::uint64_t, std::string> symbols;
  for (const RecordedEvent& event : late.events) {
    if (event.name == "ros2:rclcpp_callback_register") {
      symbols[event.number("callback")] = event.text("symbol");
    }
  }
  EXPECT_EQ(symbols[0x51], std::string(expected.version).starts_with("4.") ? "UNKNOWN_demangling_failed" : "(null)");
}

TEST_P(OfEachDistribution, TheVerdictHasTheCountsOfTheProcess) {
  const CommandResult result =
      run_command({LAUNCH_PROGRAM, write("<trace session-name=\"run\"/>\n" + node("500 100"))});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, Not(HasSubstr("WARNING"))) << result.out;
  const json told = verdict();
  EXPECT_EQ(told["complete"], true);
  ASSERT_THAT(told["processes"], SizeIs(1));
  const json& process = told["processes"][0];
  EXPECT_EQ(process["callbacks"], 1000);
  EXPECT_EQ(process["missed_events"], 0);
  EXPECT_EQ(process["lost"], 0);
  EXPECT_GE(process["recorded_after_s"], 0);
  std::uint64_t recorded = 0;
  for (const RecordedEvent& event : trace("run").events) {
    recorded += event.name.starts_with("ros2:") ? 1 : 0;
  }
  EXPECT_EQ(process["events"], recorded);
  const fs::path prefix = prefix_of(GetParam().name);
  EXPECT_EQ(told["tracetools"], (json::array({{{"process", "talker"},
                                               {"uses", "own"},
                                               {"theirs", (prefix / "lib/libtracetools.so").string()},
                                               {"version", GetParam().version}}})));
}

TEST_P(OfEachDistribution, MaxOverheadDropsItsEvents) {
  RunningCommand launch({.argv = {LAUNCH_PROGRAM, write("<trace session-name=\"run\" max-overhead=\"0.001%\" "
                                                        "drop-order=\"layers callbacks\"/>\n" +
                                                        node("1000000 300"))}});
  ASSERT_TRUE(launch.wait_for_output("there is nothing left to drop")) << launch.out() << launch.err();
  expect_end(launch);
  const json cuts = verdict()["cuts"];
  ASSERT_THAT(cuts, SizeIs(2));
  EXPECT_EQ(cuts[0]["class"], "layers");
  EXPECT_GT(cuts[0]["rate"], cuts[1]["rate"]);
}

TEST_P(OfEachDistribution, WhatIsLateMakesASnapshot) {
  RunningCommand launch({.argv = {LAUNCH_PROGRAM, write("<trace session-name=\"run\" snapshot-on-late-callback=\"20\" "
                                                        "snapshot-on-late-message=\"60000\"/>\n" +
                                                        node("1000000 1000 late"))}});
  ASSERT_TRUE(launch.wait_for_output("a message was taken after more than 60000 ms")) << launch.out() << launch.err();
  ASSERT_TRUE(launch.wait_for_output("a callback took more than 20 ms")) << launch.out() << launch.err();
  expect_end(launch);
  std::vector<std::string> late;
  fs::path newest;
  for (const auto& entry : fs::directory_iterator(sandbox_.trace_directory() / "run")) {
    newest = std::max(newest, entry.path());
  }
  for (const RecordedEvent& event : read_trace(newest).events) {
    if (event.name.starts_with("ros2_deadline:")) {
      late.push_back(event.name);
    }
  }
  EXPECT_THAT(late, UnorderedElementsAre("ros2_deadline:message", "ros2_deadline:callback"));
}

TEST_F(OtherRos2, NodesOfAllDistributionsAreInOneTrace) {
  constexpr std::size_t kOfEach = 4;
  std::string actions = "<trace session-name=\"run\"/>\n";
  for (const Distribution& distribution : kDistributions) {
    for (std::size_t i = 0; i < kOfEach; ++i) {
      actions += node(prefix_of(distribution.name), "20 100", distribution.name);
    }
  }
  const CommandResult result = run_command({LAUNCH_PROGRAM, write(actions)});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  const json told = verdict();
  EXPECT_EQ(told["complete"], true) << told["absent"];
  ASSERT_THAT(told["processes"], SizeIs(kOfEach * kDistributions.size()));
  for (const json& process : told["processes"]) {
    EXPECT_EQ(process["missed_events"], 0) << "it has waited for the session daemon";
    EXPECT_EQ(process["callbacks"], 40);
  }
  std::map<std::string, std::size_t> of_version;
  std::map<std::size_t, std::size_t> sizes;
  for (const RecordedEvent& event : trace("run").events) {
    if (event.name == "ros2:rcl_init") {
      ++of_version[event.text("version")];
    } else if (event.name == "ros2:rmw_publisher_init") {
      ++sizes[event.arrays.at("gid").size()];
    }
  }
  for (const Distribution& distribution : kDistributions) {
    EXPECT_EQ(of_version[distribution.version], kOfEach);
  }
  EXPECT_THAT(sizes, ElementsAre(testing::Pair(16, 2 * kOfEach), testing::Pair(24, 3 * kOfEach)));
}

// There lttng-ust has registered the process before our tracetools is asked for anything.
TEST_F(OtherRos2, ANodeThatWasLinkedWithLttngIsReachedFromItsBeginningOn) {
  const CommandResult result =
      run_command({LAUNCH_PROGRAM, write("<trace session-name=\"run\"/>\n" +
                                         node(prefix_of("humble"), "100 100", "talker", "lttng_node"))});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  const json told = verdict();
  EXPECT_EQ(told["complete"], true) << told["absent"];
  ASSERT_THAT(told["processes"], SizeIs(1));
  EXPECT_GE(told["processes"][0]["recorded_after_s"], 0);
  EXPECT_EQ(told["processes"][0]["missed_events"], 0);
  EXPECT_EQ(told["processes"][0]["callbacks"], 200);
}

TEST_F(OtherRos2, ADistributionThatWasBuiltWithoutLttngIsRecorded) {
  const CommandResult result =
      run_command({LAUNCH_PROGRAM, write("<trace session-name=\"run\"/>\n" + node(prefix_of("silent"), "100 100"))});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  const json told = verdict();
  EXPECT_EQ(told["complete"], true);
  ASSERT_THAT(told["processes"], SizeIs(1));
  EXPECT_EQ(told["processes"][0]["callbacks"], 200);
}

TEST_F(OtherRos2, ANodeInPythonGetsOursWhenItLoadsTheLibraries) {
  const CommandResult result =
      run_command({LAUNCH_PROGRAM, write("<trace session-name=\"run\"/>\n" +
                                         node(prefix_of("jazzy"), "200 100", "py", "python_talker"))});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  const json told = verdict();
  EXPECT_EQ(told["tracetools"][0]["uses"], "own");
  ASSERT_THAT(told["processes"], SizeIs(1));
  EXPECT_EQ(told["processes"][0]["callbacks"], 400);
  EXPECT_EQ(told["processes"][0]["lost"], 0);
}

TEST_F(OtherRos2, WhatANodeExecutesGetsNeitherThreadsNorCounts) {
  const fs::path prefix = prefix_of("jazzy");
  // The shell is the program; the node is what it executes at last.
  const std::string command = (prefix / "lib/demo/talker").string();
  const CommandResult result = run_command(
      {LAUNCH_PROGRAM, write("<trace session-name=\"run\"/>\n<executable name=\"sh\" output=\"screen\" cmd=\"sh -c "
                             "'grep -c liblttng-ust.so "
                             "/proc/self/maps; grep -c stand_ins/8.1/libtracetools.so /proc/self/maps; exec " +
                             command + " 100 100' " + command + "\"><env name=\"LD_LIBRARY_PATH\" value=\"" +
                             (prefix / "lib").string() + "\"/></executable>")});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, ContainsRegex("\\] 0\n.*\\] [1-9]")) << "preloaded, and asleep";
  ASSERT_THAT(verdict()["processes"], SizeIs(1));
  EXPECT_EQ(verdict()["processes"][0]["callbacks"], 200);
}

TEST_F(OtherRos2, WhatANodeExecutesMayBeOfAnotherRos2) {
  const CommandResult result =
      run_command({LAUNCH_PROGRAM, write("<trace session-name=\"run\"/>\n<set_env name=\"LD_PRELOAD\" "
                                         "value=\"libdl.so.2\"/>\n" +
                                         node(prefix_of("iron"), "10 10") + "<unset_env name=\"LD_PRELOAD\"/>\n" +
                                         node(prefix_of("humble"), "10 10"))});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("] LD_PRELOAD: libdl.so.2\n"), HasSubstr("] LD_PRELOAD: none\n")));
}

}  // namespace
}  // namespace other_ros2
