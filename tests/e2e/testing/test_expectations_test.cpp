// SPDX-License-Identifier: Apache-2.0
// What tests in launch files expect of the ROS graph and of traces, with nodes of the stack.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>

#include "tests/e2e/testing/launch_test_fixture.hpp"
#include "tests/support/sanitized.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Not;

namespace fs = std::filesystem;

class TestExpectations : public LaunchTestFixture {
 protected:
  CommandResult run_file(const std::string& actions) { return run({write("a.launch.xml", actions), "-j", "1"}); }
};

TEST_F(TestExpectations, AttributesGoTogetherOrNot) {
  const CommandResult result = run_file(R"xml(
  <test name="t">
    <message topic="/n" type="std_msgs/msg/Int64" absent="true" min_rate="2"/>
    <graph node="/n" parameter="p"/>
    <graph topic="/n" parameter="p" value="3"/>
    <graph node="/n" value="3"/>
    <graph node="/n" parameter="p" value="3" state="active"/>
    <output text="a" when="shutdown" within="3"/>
    <output text="a" when="later"/>
    <events_in_order><event name="ros2:rcl_init"/></events_in_order>
    <allocations node="/n" state="activ"/>
  </test>)xml");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(plain(result.err), R"x(a.launch.xml:4:59: error: absent means max="0": it goes without min, max and rates
    4 |     <message topic="/n" type="std_msgs/msg/Int64" absent="true" min_rate="2"/>
      |                                                           ^~~~
a.launch.xml:5:33: error: the parameter has no value that is waited for
    5 |     <graph node="/n" parameter="p"/>
      |                                 ^
      = help: give value="…"
a.launch.xml:6:34: error: parameter goes with a node only
    6 |     <graph topic="/n" parameter="p" value="3"/>
      |                                  ^
a.launch.xml:7:29: error: value goes with a parameter only
    7 |     <graph node="/n" value="3"/>
      |                             ^
      = help: give parameter="…", its name
a.launch.xml:8:33: error: either a state or a parameter is waited for
    8 |     <graph node="/n" parameter="p" value="3" state="active"/>
      |                                 ^
      = help: write one for each
a.launch.xml:9:46: error: within counts from the begin of the test: it goes without when="shutdown"
    9 |     <output text="a" when="shutdown" within="3"/>
      |                                              ^
a.launch.xml:10:28: error: when can be running or shutdown, got 'later'
   10 |     <output text="a" when="later"/>
      |                            ^~~~~
a.launch.xml:11:6: error: an order needs two events at least
   11 |     <events_in_order><event name="ros2:rcl_init"/></events_in_order>
      |      ^~~~~~~~~~~~~~~
      = help: give each one: <event name="…"/>
a.launch.xml:12:35: error: state can be active, unconfigured, inactive, finalized or any, got 'activ'
   12 |     <allocations node="/n" state="activ"/>
      |                                   ^~~~~
      = help: did you mean 'active'?
)x");
}

TEST_F(TestExpectations, TimesThatCannotBeAreErrorsAtTheirPlace) {
  const auto error_of = [&](const std::string& test) {
    const CommandResult result = run_file(test);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(result.out, "");
    return plain(result.err);
  };
  EXPECT_EQ(error_of(R"(<test name="t" timeout="1e300"><output text="a"/></test>)"),
            R"(a.launch.xml:2:25: error: a time of 1e+300 s is too long
    2 | <test name="t" timeout="1e300"><output text="a"/></test>
      |                         ^~~~~
      = help: a billion seconds at most
)");
  EXPECT_THAT(error_of(R"(<test name="t" duration="inf"><output text="a"/></test>)"),
              HasSubstr("a.launch.xml:2:26: error: a time of inf s is too long\n"));
  EXPECT_THAT(error_of(R"(<test name="t"><output text="a" within="1e12"/></test>)"),
              HasSubstr("a.launch.xml:2:41: error: a time of 1e+12 s is too long\n"));
  EXPECT_THAT(error_of(R"xml(<test name="t" duration="$(eval '10 ** 20')"><output text="a"/></test>)xml"),
              HasSubstr("a.launch.xml:2:26: error: a time of 1e+20 s is too long\n"));
  EXPECT_EQ(error_of(R"(<test name="t"><latency topic="/a" max_ms="1" min_ms="5"/></test>)"),
            R"(a.launch.xml:2:44: error: max_ms is less than min_ms, 5
    2 | <test name="t"><latency topic="/a" max_ms="1" min_ms="5"/></test>
      |                                            ^
)");
}

TEST_F(TestExpectations, AFieldThatAMessageLacksIsAnErrorAtItsPlace) {
  const CommandResult result = run_file(R"xml(
  <test name="t">
    <message topic="/n" type="std_msgs/msg/Int64" where="date > 3"/>
  </test>)xml");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(plain(result.err), HasSubstr("a.launch.xml:4:58: error: std_msgs/msg/Int64 has no field 'date'\n"));
}

TEST_F(TestExpectations, AMistakeInAMessageIsAnErrorAtItsPlace) {
  const auto error = [this](const std::string& attributes) {
    const CommandResult result =
        run_file("<test name=\"t\">\n<message topic=\"/n\" type=\"std_msgs/msg/" + attributes + "/>\n</test>");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(result.out, "");
    return plain(result.err);
  };
  EXPECT_THAT(error("Int46\""), HasSubstr("a.launch.xml:3:27: error: "));
  EXPECT_THAT(error("Int64\" min=\"3\" max=\"2\""), HasSubstr("a.launch.xml:3:60: error: max is less than min, 3\n"));
  EXPECT_THAT(error("Int64\" min_rate=\"3\" max_rate=\"2\""),
              HasSubstr("a.launch.xml:3:70: error: max_rate is less than min_rate, 3\n"));
}

TEST_F(TestExpectations, ParametersHaveValues) {
  const CommandResult result = run_file(R"xml(
  <node pkg="demo_nodes" exec="add_two_ints_server"><param name="count" value="3"/></node>
  <test name="is set">
    <change_parameter node="/add_two_ints_server" parameter="count" value="5">
      <depends_on node="/add_two_ints_server" parameter="count" value="3"/>
    </change_parameter>
    <graph node="/add_two_ints_server" parameter="count" value="5.0" within="60"/>
    <exit process="change_parameter"/>
  </test>
  <test name="has another">
    <graph node="/add_two_ints_server" parameter="count" value="3"/>
    <graph node="/add_two_ints_server" parameter="count" value="4" within="5"/>
  </test>)xml");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(plain(result.out), HasSubstr("PASS  a.launch.xml: is set  T s\n")) << result.out << result.err;
  EXPECT_THAT(
      plain(result.out),
      HasSubstr(
          R"(a.launch.xml:13:6: error: it did not happen within 5 s: parameter 'count' of '/add_two_ints_server' is 4
   13 |     <graph node="/add_two_ints_server" parameter="count" value="4" within="5"/>
      |      ^~~~~
      = expected: parameter 'count' of '/add_two_ints_server' is 4
      = seen: it is 3
)"));
}

TEST_F(TestExpectations, TransitionsAreSteps) {
  const CommandResult result = run_file(R"xml(
  <lifecycle_node pkg="lifecycle" exec="lifecycle_talker" name="lc_talker" namespace=""/>
  <test name="becomes active">
    <transition name="first" node="/lc_talker" transition="configure"/>
    <transition name="second" node="/lc_talker" transition="activate">
      <depends_on node="/lc_talker" state="inactive"/>
    </transition>
    <graph node="/lc_talker" state="active" within="60"/>
    <exit process="first"/>
    <exit process="second"/>
  </test>
  <test name="can't be activated yet">
    <transition name="first" node="/lc_talker" transition="activate"/>
    <exit process="first"/>
  </test>)xml");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(plain(result.out), HasSubstr("PASS  a.launch.xml: becomes active  T s\n")) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("error: 'first' has exited with code 1\n"));
  EXPECT_THAT(result.out, HasSubstr("'/lc_talker' has no transition 'activate' now"));
}

TEST_F(TestExpectations, AMistakeInATransitionIsToldAtItsPlace) {
  const CommandResult result = run_file(R"xml(
  <test name="t">
    <transition name="first" node="/lc_talker" transition="activte"/>
    <exit process="first"/>
  </test>)xml");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(
      plain(result.err),
      R"(a.launch.xml:4:60: error: there is no transition 'activte', expected configure, activate, deactivate, cleanup or shutdown
    4 |     <transition name="first" node="/lc_talker" transition="activte"/>
      |                                                            ^~~~~~~
      = help: did you mean 'activate'?
)");
}

TEST_F(TestExpectations, EventsComeInTheirOrder) {
  const std::string system = R"xml(
  <node pkg="demo_nodes" exec="pong"/>
  <node pkg="demo_nodes" exec="ping" on_exit="shutdown"><param name="count" value="3"/><param name="period_ms" value="20"/></node>)xml";
  const CommandResult good = run_file(system + R"xml(
  <test name="in order">
    <exit process="ping" within="60"/>
    <events_in_order>
      <event name="ros2:rcl_init" process="ping"/>
      <event name="ros2:rcl_publisher_init" where="topic_name == '/ping'" process="ping"/>
      <event name="ros2:rclcpp_publish" process="ping"/>
      <event name="ros2:callback_start" process="pong"/>
    </events_in_order>
  </test>)xml");
  EXPECT_EQ(good.exit_code, 0) << good.out << good.err;
  const CommandResult bad = run_file(system + R"xml(
  <test name="in order">
    <exit process="ping" within="60"/>
    <events_in_order>
      <event name="ros2:rclcpp_publish" process="ping"/>
      <event name="ros2:rcl_init" process="ping"/>
    </events_in_order>
  </test>)xml");
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_THAT(bad.out, HasSubstr("a.launch.xml:7:6: error: the events do not come in this order\n"));
}

TEST_F(TestExpectations, CallbacksOfAnActiveNodeAskForMemoryOrDoNot) {
  if (test_support::kSanitized) {
    GTEST_SKIP() << test_support::kMallocIsTaken;
  }
  const std::string system = R"xml(
  <lifecycle_node pkg="lifecycle" exec="lifecycle_talker" name="lc_talker" namespace="" autostart="true">
    <param name="period_ms" value="20"/>
  </lifecycle_node>)xml";
  const CommandResult result = run_file(system + R"xml(
  <test name="many">
    <message topic="/lifecycle_chatter" type="std_msgs/msg/String" min="5" within="60"/>
    <allocations node="/lc_talker" max="1000000"/>
    <allocations node="/lc_talker" state="any" max="1000000"/>
  </test>
  <test name="none">
    <message topic="/lifecycle_chatter" type="std_msgs/msg/String" min="5" within="60"/>
    <allocations node="/lc_talker"/>
  </test>
  <test name="never">
    <message topic="/lifecycle_chatter" type="std_msgs/msg/String" min="5" within="60"/>
    <allocations node="/lc_talker" state="finalized"/>
  </test>)xml");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(plain(result.out), HasSubstr("PASS  a.launch.xml: many  T s\n")) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("error: '/lc_talker' asks for memory while it is active\n"));
  EXPECT_THAT(result.out, HasSubstr("      = expected: the callbacks of '/lc_talker' ask for memory at most 0 times "
                                    "while it is active\n"));
  EXPECT_THAT(result.out, HasSubstr("error: '/lc_talker' was never finalized\n"));
}

TEST_F(TestExpectations, WhatAProcessSaysAtItsEndIsExpectedOfTheShutdown) {
  const std::string system = R"xml(
  <executable name="server" shell="true" cmd="finish() { echo bye; exit 0; }; trap finish INT; echo ready; while true; do sleep 0.05; done"/>)xml";
  const CommandResult result = run_file(system + R"xml(
  <test name="good">
    <output process="server" text="ready"/>
    <output process="server" text="bye" when="shutdown"/>
    <output process="server" text="ready" when="shutdown" absent="true"/>
  </test>
  <test name="bad">
    <output process="server" text="ready"/>
    <output process="server" text="good bye" when="shutdown"/>
  </test>)xml");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(plain(result.out), HasSubstr("PASS  a.launch.xml: good  T s\n"));
  EXPECT_THAT(result.out,
              HasSubstr("a.launch.xml:11:6: error: there was not a line with 'good bye' from 'server' at the "
                        "shutdown\n"));
}

TEST_F(TestExpectations, AProcessThatIsLeftBehindFailsTheTest) {
  // The daemon has left the group when it writes to the fifo, for which its parent waits. Then it waits for a line in
  // another fifo, which nobody writes, so its name stays that of the shell.
  const std::string fifo = sandbox_.directory() / "fifo";
  const std::string never = sandbox_.directory() / "never";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  ASSERT_EQ(::mkfifo(never.c_str(), 0600), 0);
  write_file(sandbox_.directory() / "daemon.sh", "echo > " + fifo + "; read x < " + never + "\n");
  const CommandResult result = run_file(R"xml(
  <executable name="parent" shell="true" cmd="setsid sh $(dirname)/daemon.sh &amp; read x &lt; $(dirname)/fifo; echo started"/>
  <test name="t"><output process="parent" text="started"/><exit process="parent"/></test>)xml");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, HasSubstr("a.launch.xml:4:4: error: parent-1 left 1 process running: sh ("));
}

TEST_F(TestExpectations, AFailedTestLeavesPagesOfItsTracesAndBundlesOfItsCrashes) {
  const CommandResult result = run_file(R"xml(
  <trace session-name="own"/>
  <node pkg="demo_nodes" exec="pong"/>
  <node pkg="demo_nodes" exec="ping" name="pinger"><param name="count" value="3"/><param name="period_ms" value="20"/></node>
  <test name="t">
    <executable name="dies" shell="true" cmd="echo last words; kill -SEGV $$">
      <depends_on process="pinger" condition="exited"/>
    </executable>
    <exit process="dies"/>
    <event name="ros2:rcl_init" min="2"/>
  </test>
  <test name="expects the crash" >
    <executable name="dies" shell="true" cmd="kill -SEGV $$"/>
    <exit process="dies" code="SIGSEGV"/>
    <output text="never" within="0.5"/>
  </test>)xml");
  EXPECT_EQ(result.exit_code, 1);
  std::vector<fs::path> directories;
  for (const auto& run : fs::directory_iterator(fs::path(::getenv("ROS_HOME")) / "test")) {
    for (const auto& test : fs::directory_iterator(run)) {
      directories.push_back(test.path());
    }
  }
  std::sort(directories.begin(), directories.end());
  ASSERT_EQ(directories.size(), 2u) << result.out;
  for (const char* const traces : {"trace", "own_traces"}) {
    ASSERT_TRUE(fs::exists(directories[0] / traces)) << result.out;
    EXPECT_TRUE(fs::exists(fs::directory_iterator(directories[0] / traces)->path() / "report.html")) << result.out;
  }
  ASSERT_TRUE(fs::exists(directories[0] / "crashes")) << result.out;
  const fs::path bundle = fs::directory_iterator(directories[0] / "crashes")->path();
  EXPECT_THAT(bundle.filename().string(), testing::StartsWith("dies-"));
  EXPECT_TRUE(fs::exists(bundle / "crash.txt"));
  EXPECT_FALSE(fs::exists(directories[1] / "crashes"));
}

TEST_F(TestExpectations, TestsOfOneSessionNameRunBesideEachOther) {
  std::string tests = R"xml(
  <trace session-name="mine"/>
  <executable name="server" shell="true" cmd="echo ready; exec cat"/>)xml";
  for (int i = 0; i < 6; ++i) {
    tests += "<test name=\"" + std::to_string(i) + R"xml("><output process="server" text="ready"/></test>)xml";
  }
  const CommandResult result = run({write("a.launch.xml", tests), "-j", "6"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
}

}  // namespace
