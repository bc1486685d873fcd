// SPDX-License-Identifier: Apache-2.0
// Nodes of other ROS 2 distributions in a trace, with our tracetools and with theirs. The nodes are programs of
// tests/support/other_ros2/, which call tracetools as rclcpp of each distribution does.
#include <gmock/gmock.h>
#include <signal.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/support/command.hpp"
#include "tests/support/recorded_trace.hpp"
#include "tests/support/sandbox.hpp"

namespace {

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

class OfEachDistribution : public OtherRos2, public testing::WithParamInterface<Distribution> {
 protected:
  std::string node(const std::string& arguments) const {
    return OtherRos2::node(prefix_of(GetParam().name), arguments);
  }
};

INSTANTIATE_TEST_SUITE_P(Distributions, OfEachDistribution, testing::ValuesIn(kDistributions),
                         [](const auto& each) { return std::string(each.param.name); });

std::map<std::string, RecordedEvent> first_of_each(const RecordedTrace& trace) {
  std::map<std::string, RecordedEvent> events;
  for (const RecordedEvent& event : trace.events) {
    events.emplace(event.name, event);
  }
  return events;
}

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

TEST_F(OtherRos2, WhatIsLaunchedLaterIsSaidWhenItStarts) {
  RunningCommand launch(
      {.argv = {LAUNCH_PROGRAM, write("<trace session-name=\"run\" tracetools=\"own\"/>\n<timer period=\"0.1\">\n" +
                                      node(prefix_of("forked"), "1 1", "camera") + "</timer>\n" +
                                      node(prefix_of("iron"), "3000 100"))}});
  const CommandResult result = launch.wait();
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out,
              HasSubstr("[WARNING] [launch.trace]: these processes keep the tracetools of their ROS 2: camera "
                        "(its tracetools has ros_trace_dds_write, which ours lacks); without effect on them: "
                        "counts of events"));
  EXPECT_EQ(result.out.find("keep the tracetools"), result.out.rfind("keep the tracetools"));
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

TEST_F(OtherRos2, TheirsIsSaidOnceWithAllThatHasNoEffect) {
  RunningCommand launch(
      {.argv = {
           LAUNCH_PROGRAM,
           write("<trace session-name=\"run\" tracetools=\"theirs\" events-ust=\"ros2:* ros2_ext:rcl_node_fini\" "
                 "max-overhead=\"50%\" snapshot-on-late-callback=\"20\" snapshot-on-late-message=\"60000\"/>\n" +
                 node(prefix_of("iron"), "300 100", "talker") + node(prefix_of("jazzy"), "300 100", "listener"))}});
  const CommandResult result = launch.wait();
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  const std::string warning =
      "[WARNING] [launch.trace]: these processes keep the tracetools of their ROS 2: talker, listener "
      "(tracetools=\"theirs\"); without effect on them: max-overhead, snapshot-on-late-callback, "
      "snapshot-on-late-message, events-ust 'ros2_ext:rcl_node_fini', counts of events and of losses, "
      "recorded_after_s, "
      "a longer wait for the session daemon, names in sessions that begin later\n";
  EXPECT_THAT(result.out, HasSubstr(warning));
  EXPECT_EQ(result.out.find("keep the tracetools"), result.out.rfind("keep the tracetools"));
}

TEST_F(OtherRos2, TheirsRecordsWhatTheirsRecords) {
  const CommandResult result =
      run_command({LAUNCH_PROGRAM, write("<trace session-name=\"run\" tracetools=\"theirs\"/>\n" +
                                         node(prefix_of("iron"), "100 100"))});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  const json told = verdict();
  ASSERT_THAT(told["processes"], SizeIs(1));
  EXPECT_FALSE(told["processes"][0].contains("recorded_after_s"));
  EXPECT_EQ(told["tracetools"], (json::array({{{"process", "talker"},
                                               {"uses", "theirs"},
                                               {"theirs", (prefix_of("iron") / "lib/libtracetools.so").string()},
                                               {"version", "6.3.2"},
                                               {"reason", "tracetools=\"theirs\""}}})));
  std::map<std::string, RecordedEvent> events = first_of_each(trace("run"));
  EXPECT_TRUE(events.contains("ros2:rmw_publish"));
  EXPECT_FALSE(events.contains("ros2:rcl_publish")) << "theirs is a part of a tracetools";
}

TEST_F(OtherRos2, ALibraryThatDoesNotFitStays) {
  const std::string actions = "<trace session-name=\"run\" TRACETOOLS max-overhead=\"50%\"/>\n" +
                              node(prefix_of("forked"), "100 100", "camera") +
                              "<executable name=\"arm\" cmd=\"" OTHER_ROS2 "/static_node 100 100\"/>" +
                              node(prefix_of("iron"), "100 100");
  const auto with = [&](const std::string& attribute) {
    std::string text = actions;
    return text.replace(text.find("TRACETOOLS"), 10, attribute);
  };
  const CommandResult result = run_command({LAUNCH_PROGRAM, write(with(""))});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out,
              HasSubstr("[WARNING] [launch.trace]: these processes keep the tracetools of their ROS 2: camera (its "
                        "tracetools has ros_trace_dds_write, which ours lacks), arm (it is linked statically); without "
                        "effect on them: max-overhead, counts of events and of losses, recorded_after_s, a longer wait "
                        "for the session daemon, names in sessions that begin later\n"));
  const json told = verdict();
  std::vector<std::string> used;
  for (const json& use : told["tracetools"]) {
    used.push_back(use["process"].get<std::string>() + " " + use["uses"].get<std::string>());
  }
  EXPECT_THAT(used, ElementsAre("camera theirs", "arm theirs", "talker own"));

  const CommandResult refused = run_command({LAUNCH_PROGRAM, write(with("tracetools=\"own\" append-trace=\"true\""))});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err,
              HasSubstr("tracing setup failed: tracetools=\"own\" cannot be had for camera: its tracetools has "
                        "ros_trace_dds_write, which ours lacks"));
  EXPECT_THAT(refused.out, Not(HasSubstr("process started")));
}

TEST_F(OtherRos2, NothingIsSaidToBeWhereNothingWasWritten) {
  const CommandResult result = run_command(
      {LAUNCH_PROGRAM, write("<trace session-name=\"run\" launch-events=\"false\"/>\n<executable cmd=\"true\"/>")});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_EQ(fs::exists(sandbox_.trace_directory() / "run"), result.out.find("trace written to:") != std::string::npos)
      << result.out;
}

}  // namespace
