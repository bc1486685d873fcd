// SPDX-License-Identifier: Apache-2.0
// `launch test`: the tests of launch files, those that pass and those that do not.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/mount.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/e2e/testing/launch_test_fixture.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;
using testing::Not;

namespace fs = std::filesystem;

class TestCommand : public LaunchTestFixture {
 protected:
  // Waits until a process of a test has made the file.
  bool appears(const std::string& name) const {
    const fs::path path = sandbox_.directory() / name;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!fs::exists(path) && std::chrono::steady_clock::now() < end) {
      ::usleep(10'000);
    }
    return fs::exists(path);
  }
};

TEST_F(TestCommand, TellsWhatHasFailedAtItsPlace) {
  const std::string file = write("a.launch.xml", R"xml(
  <executable name="counter" shell="true" cmd="for i in 1 2 3; do echo count $i; done; exec cat"/>
  <test name="counts to four">
    <output process="counter" text="count 4" within="0.2"/>
  </test>)xml");
  const CommandResult result = run({file});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(plain(result.out), R"(FAIL  a.launch.xml: counts to four  T s
a.launch.xml:5:6: error: there was not a line with 'count 4' from 'counter' within 0.2 s
    5 |     <output process="counter" text="count 4" within="0.2"/>
      |      ^~~~~~
      = expected: a line with 'count 4'
      = seen: none in 3 lines
      = last lines of counter-1:
          count 1
          count 2
          count 3
      = files: DIR/0001-counts_to_four

1 test: 0 passed, 1 failed, in T s
)");
  EXPECT_EQ(result.err, "");
}

TEST_F(TestCommand, PassesWhenEverythingHasHappenedAndRemovesItsFiles) {
  const std::string file = write("a.launch.xml", R"xml(
  <arg name="word"/>
  <executable name="server" shell="true" cmd="echo one; echo two $(var word) >&amp;2; exec cat"/>
  <test name="speaks">
    <in_order process="server"><line text="one"/></in_order>
    <output process="server" pattern="^two b" stream="stderr"/>
    <output text="three" absent="true"/>
    <exit process="server" when="shutdown" code="SIGINT"/>
    <resources process="server" max_memory="1G"/>
  </test>
  <test name="has a step">
    <executable cmd="true" name="step"/>
    <exit process="step"/>
  </test>)xml");
  const CommandResult result = run({file, "-j", "2", "word:=b"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(plain(result.out), HasSubstr("PASS  a.launch.xml: speaks  T s\n"));
  EXPECT_THAT(plain(result.out), HasSubstr("PASS  a.launch.xml: has a step  T s\n"));
  EXPECT_THAT(plain(result.out), HasSubstr("\n2 tests: 2 passed, in T s\n"));
  EXPECT_TRUE(fs::is_empty(fs::path(::getenv("ROS_HOME")) / "test"));
}

TEST_F(TestCommand, AProcessThatFailsWithoutBeingNamedFailsTheTest) {
  const std::string file = write("a.launch.xml", R"xml(
  <executable name="bad" shell="true" cmd="echo oh; exit 7"/>
  <executable name="good" cmd="cat"/>
  <test name="t"><output process="good" text="never"/></test>)xml");
  const CommandResult result = run({file});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(plain(result.out), R"(FAIL  a.launch.xml: t  T s
a.launch.xml:3:4: error: bad-1 has exited with code 7
    3 |   <executable name="bad" shell="true" cmd="echo oh; exit 7"/>
      |    ^~~~~~~~~~
      = help: if that is right: <exit process="bad" code="7"/>
      = last lines of bad-1:
          oh
      = not judged, because the run ended: 1 expectation
      = files: DIR/0001-t

1 test: 0 passed, 1 failed, in T s
)");
}

TEST_F(TestCommand, ATestThatDoesNotEndHasTimedOut) {
  const std::string file = write("a.launch.xml", R"xml(
  <executable name="server" cmd="cat"/>
  <test name="silent" timeout="0.3"><output text="late" absent="true"/></test>
  <test name="waits" timeout="0.3"><exit process="server"/></test>)xml");
  const CommandResult result = run({file, "-j", "1"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, HasSubstr("error: the system has not ended within 0.3 s, the timeout of the test\n"));
  EXPECT_THAT(result.out, HasSubstr("      = help: duration=\"…\" ends it after a while\n"));
  EXPECT_THAT(result.out, HasSubstr("error: 'server' has not exited within 0.3 s, the timeout of the test\n"));
  EXPECT_THAT(result.out, HasSubstr("      = seen: it was still running\n"));
}

TEST_F(TestCommand, ADurationEndsATestThatWaitsForNothing) {
  const std::string file = write("a.launch.xml", R"xml(
  <executable name="server" cmd="cat"/>
  <test name="silent" duration="0.2"><output text="late" absent="true"/></test>)xml");
  const CommandResult result = run({file});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
}

TEST_F(TestCommand, AMistakeIsToldBeforeAnythingStarts) {
  const std::string good = write("good.launch.xml", R"xml(
  <executable cmd="touch started" cwd="$(dirname)"/><test name="t"><exit process="touch"/></test>)xml");
  const std::string bad = write("bad.launch.xml", R"xml(
  <executable name="server" cmd="cat"/>
  <test name="a"><output process="sever" text="x"/></test>
  <test name="a"><output pattern="(" process="server"/></test>)xml");
  CommandResult result = run({good, bad});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(plain(result.err), HasSubstr("bad.launch.xml:5:35: error: "));
  write("bad.launch.xml", R"xml(
  <executable name="server" cmd="cat"/>
  <test name="a"><output process="sever" text="x"/></test>
  <test name="a"><output process="server"/></test>)xml");
  result = run({good, bad});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(plain(result.err), R"(bad.launch.xml:4:35: error: no process is named 'sever'
    4 |   <test name="a"><output process="sever" text="x"/></test>
      |                                   ^~~~~
      = help: did you mean 'server'?
bad.launch.xml:5:15: error: two tests are named 'a'
    5 |   <test name="a"><output process="server"/></test>
      |               ^
      = help: in a loop, put $(index …) or $(for-var …) into the name
)");
  EXPECT_FALSE(fs::exists(sandbox_.directory() / "started"));
}

TEST_F(TestCommand, ANameIsOneLine) {
  const std::string file = write("a.launch.xml", R"xml(
  <test name="two&#10;lines"><output text="a"/></test>)xml");
  const CommandResult result = run({file});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(plain(result.err),
            R"(a.launch.xml:3:15: error: the name of the test has a line break or another control character
    3 |   <test name="two&#10;lines"><output text="a"/></test>
      |               ^~~~~~~~~~~~~
      = help: it stands on one line in reports
)");
}

TEST_F(TestCommand, ADirectoryThatCantBeMadeFailsTheTests) {
  const std::string file = write("a.launch.xml", R"xml(
  <test name="one"><executable name="step" cmd="true"/><exit process="step"/></test>
  <test name="two"><executable name="step" cmd="true"/><exit process="step"/></test>)xml");
  const fs::path directory = sandbox_.directory() / "results";
  fs::create_directories(directory);
  write_file(directory / "0001-one", "a file is in the way");
  const CommandResult result = run({file, "-j", "1", "--directory", directory.string()});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(plain(result.out), HasSubstr("a.launch.xml:3:4: error: the test can't be started: "));
  EXPECT_THAT(plain(result.out), HasSubstr("PASS  a.launch.xml: two  T s\n"));
}

TEST_F(TestCommand, AFullDiskTakesNoResultAway) {
  const std::string file = write("a.launch.xml", R"xml(
  <executable name="flood" shell="true" cmd="head -c 4000000 /dev/zero | tr '\0' 'x' | fold; echo over; exit 3" output="both"/>
  <test name="bad"><exit process="flood"/></test>
  <test name="good"><exit process="flood" code="3"/></test>)xml");
  const fs::path directory = sandbox_.directory() / "full";
  fs::create_directories(directory);
  // The sandbox has a mount namespace of its own.
  ASSERT_EQ(::mount("tmpfs", directory.c_str(), "tmpfs", 0, "size=1m"), 0);
  const CommandResult result = run({file, "-j", "1", "--directory", directory.string()});
  ::umount(directory.c_str());
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, HasSubstr("error: 'flood' has exited with code 3\n"));
  EXPECT_THAT(plain(result.out), HasSubstr("PASS  a.launch.xml: good  T s\n"));
}

TEST_F(TestCommand, ATestWhoseLauncherIsKilledHasFailed) {
  const std::string file = write("a.launch.xml", R"xml(
  <test name="kills it"><executable name="step" shell="true" cmd="kill -9 $PPID; sleep 1000"/><exit process="step"/></test>)xml");
  const CommandResult result = run({file});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(plain(result.out), HasSubstr("a.launch.xml:3:4: error: the process of the test has ended with signal "
                                           "SIGKILL, without a result\n"));
}

// A report for other programs shows the last output of such a test, whatever bytes it has.
TEST_F(TestCommand, OutputThatIsNoTextLeavesTheResultsReadable) {
  const std::string bytes = sandbox_.directory() / "bytes";
  write_file(bytes, "before \xff\xfe\x01 after\n");
  const std::string file =
      write("a.launch.xml", R"xml(
  <test name="kills it"><executable name="step" shell="true" output="screen" cmd="cat )xml" +
                                bytes + R"xml(; kill -9 $PPID; sleep 1000"/><exit process="step"/></test>
  <test name="fails"><executable name="step" cmd="cat )xml" +
                                bytes + R"xml("/><output process="step" text="none"/></test>)xml");
  const std::string junit = sandbox_.directory() / "junit.xml";
  const std::string json = sandbox_.directory() / "result.json";
  EXPECT_EQ(run({file, "--junit", junit, "--json", json}).exit_code, 1);
  const CommandResult read =
      run_command({.argv = {"python3", "-c",
                            "import json, sys, xml.etree.ElementTree as tree\n"
                            "print(len(json.load(open(sys.argv[2]))['tests']))\n"
                            "print(sum('before \ufffd\ufffd after' in (failure.text or '') for failure in "
                            "tree.parse(sys.argv[1]).iter('failure')))\n",
                            junit, json}},
                  std::chrono::seconds(20));
  EXPECT_EQ(read.out, "2\n2\n") << read.err;
}

// They are read before anything starts, when no run is there yet.
TEST_F(TestCommand, ALaunchFileMayReadTheVariablesThatEachRunHas) {
  const std::string file = write("a.launch.xml", R"xml(
  <executable name="p" cmd="echo $(env ROS_HOME) $(env ROS_LOG_DIR) $(env ROS_TRACE_DIR) domain $(env ROS_DOMAIN_ID) seed $(env LAUNCH_TEST_SEED)"/>
  <test name="t"><output process="p" pattern="0001-t__seed_1_/ros .*0001-t__seed_1_/log .*/own_traces domain [0-9]+ seed 1$"/></test>)xml");
  const CommandResult result =
      run_command({.argv = {"env", "-u", "ROS_HOME", "-u", "ROS_LOG_DIR", "-u", "ROS_TRACE_DIR", "-u", "ROS_DOMAIN_ID",
                            LAUNCH_PROGRAM, "test", file, "--seeds", "1"}},
                  std::chrono::seconds(60));
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
}

TEST_F(TestCommand, ATestExpectsSomething) {
  const std::string file = write("a.launch.xml", R"xml(<test name="t"/>)xml");
  const CommandResult result = run({file});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(plain(result.err), R"(a.launch.xml:2:2: error: the test expects nothing
    2 | <test name="t"/>
      |  ^~~~
      = help: say what must happen: <output text="…"/>, <exit process="…"/>, …
)");
  const std::string none = write("b.launch.xml", "");
  EXPECT_THAT(plain(run({none}).err), HasSubstr("b.launch.xml:1:1: error: the launch file has no test\n"));
}

TEST_F(TestCommand, APlainLaunchPassesOverTests) {
  const std::string file = write("a.launch.xml", R"xml(
  <executable cmd="echo system" output="screen"/>
  <test name="t"><executable cmd="echo test" output="screen"/><output text="never"/></test>)xml");
  const CommandResult result = run_command({LAUNCH_PROGRAM, file});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("[echo-1] system"));
  EXPECT_THAT(result.out, Not(HasSubstr("[echo-2] test")));
  const CommandResult check = run_command({LAUNCH_PROGRAM, "check", file});
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
}

TEST_F(TestCommand, WritesResultsForOtherPrograms) {
  write("tests/a.launch.xml", R"xml(
  <executable cmd="echo &lt;hello&gt;" name="greeter"/>
  <test name="good"><output text="hello"/></test>
  <test name="bad &amp; ugly"><output text="&lt;bye&gt;"/></test>)xml");
  write("tests/no_test.launch.xml", R"xml(<executable cmd="true"/>)xml");
  const fs::path out = sandbox_.directory() / "out";
  const CommandResult result = run({(sandbox_.directory() / "tests").string(), "--junit", out / "j.xml", "--tap",
                                    out / "t.tap", "--json", out / "r.json", "--directory", out / "files", "--keep"});
  EXPECT_EQ(result.exit_code, 1);
  const std::string junit = read_file(out / "j.xml");
  EXPECT_THAT(junit, HasSubstr("<testsuites name=\"launch test\" tests=\"2\" failures=\"1\" errors=\"0\""));
  EXPECT_THAT(junit, HasSubstr("<testcase name=\"bad &amp; ugly\""));
  EXPECT_THAT(junit, HasSubstr("<failure message=\"there was not a line with '&lt;bye>' before the system ended\">"));
  EXPECT_EQ(run_command({"xmllint", "--noout", out / "j.xml"}).exit_code, 0);
  const std::string tap = read_file(out / "t.tap");
  EXPECT_THAT(tap, HasSubstr("TAP version 13\n1..2\nok 1 - "));
  EXPECT_THAT(tap, HasSubstr("\nnot ok 2 - "));
  const auto json = nlohmann::json::parse(read_file(out / "r.json"));
  EXPECT_EQ(json["passed"], 1);
  EXPECT_EQ(json["tests"][1]["outcome"], "failed");
  EXPECT_EQ(json["tests"][1]["failures"][0]["line"], 5);
  EXPECT_TRUE(fs::exists(out / "files" / "0001-good" / "output.txt"));
}

TEST_F(TestCommand, EachTurnOfALoopIsATestAndNamesChooseThem) {
  const std::string file = write("a.launch.xml", R"xml(
  <for len="3" name="i"><test name="turn $(index i)">
    <executable name="say" cmd="echo $(index i)"/><output process="say" text="$(index i)"/>
  </test></for>)xml");
  EXPECT_EQ(plain(run({file, "--list"}).out),
            "a.launch.xml:3: turn 0\na.launch.xml:3: turn 1\na.launch.xml:3: turn 2\n");
  const CommandResult result = run({file, "-n", "turn 1"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(plain(result.out), HasSubstr("\n1 test: 1 passed, in T s\n"));
  EXPECT_THAT(run({file, "-n", "turn 1", "turns:=2"}).err, HasSubstr("warning: "));
  EXPECT_THAT(run({file, "-n", "turn1"}).err, HasSubstr("error: no test is named 'turn1'\n"));
  EXPECT_EQ(run({file, "-j", "none"}).exit_code, 2);
}

TEST_F(TestCommand, TestsBesideEachOtherHaveDomainsAndDirectoriesOfTheirOwn) {
  const std::string file = write("a.launch.xml", R"xml(
  <for len="8" name="i"><test name="turn $(index i)">
    <executable name="say" shell="true"
                cmd="cd $(dirname); echo $ROS_DOMAIN_ID $ROS_HOME &gt; seen-$(index i); until [ -e seen-0 -a -e seen-7 ]; do sleep 0.05; done"/>
    <exit process="say"/>
  </test></for>)xml");
  const CommandResult result = run({file, "-j", "8"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  std::set<std::string> domains;
  std::set<std::string> homes;
  for (int i = 0; i < 8; ++i) {
    std::ifstream seen(sandbox_.directory() / ("seen-" + std::to_string(i)));
    std::string domain;
    std::string home;
    seen >> domain >> home;
    domains.insert(domain);
    homes.insert(home);
  }
  EXPECT_EQ(domains.size(), 8U);
  EXPECT_EQ(homes.size(), 8U);
}

TEST_F(TestCommand, CtrlCEndsTheTestsAndLeavesNothing) {
  const std::string file = write("a.launch.xml", R"xml(
  <executable name="server" shell="true" cmd="touch $(dirname)/up; exec cat"/>
  <test name="t"><output text="never"/></test>)xml");
  RunningCommand command({.argv = {LAUNCH_PROGRAM, "test", file}});
  ASSERT_TRUE(appears("up"));
  command.send_signal(SIGINT);
  const CommandResult result = command.wait();
  EXPECT_EQ(result.exit_code, 130) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("error: the test was interrupted\n"));
  Sandbox::wait_until_daemons_are_left();
}

TEST_F(TestCommand, TestsEndWhenTheRunnerIsKilled) {
  const std::string file = write("a.launch.xml", R"xml(
  <executable name="server" shell="true" cmd="touch $(dirname)/up; exec cat"/>
  <test name="t"><output text="never"/></test>)xml");
  RunningCommand command({.argv = {LAUNCH_PROGRAM, "test", file}});
  ASSERT_TRUE(appears("up"));
  command.send_signal(SIGKILL);
  command.wait();
  Sandbox::wait_until_daemons_are_left();
}

TEST_F(TestCommand, AMistakeInAnExpectationOfTheTraceIsToldAtItsPlace) {
  const std::string file = write("a.launch.xml", R"xml(
  <executable name="server" cmd="cat"/>
  <test name="a"><event name="ros2:callback_start" where="callback = 1"/></test>)xml");
  CommandResult result = run({file});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(plain(result.err), HasSubstr("a.launch.xml:4:68: error: "));
  write("a.launch.xml", R"xml(<test name="a"><event name="ros2:callback_strat"/></test>)xml");
  result = run({file});
  EXPECT_EQ(plain(result.err),
            R"(a.launch.xml:2:29: error: ROS 2 has no event 'ros2:callback_strat'; did you mean 'ros2:callback_start'?
    2 | <test name="a"><event name="ros2:callback_strat"/></test>
      |                             ^~~~~~~~~~~~~~~~~~~
)");
  write("a.launch.xml",
        R"xml(<test name="a"><latency topic="/a" nodes="/a /b" max_ms="1"/><callback node="a"/></test>)xml");
  result = run({file});
  EXPECT_THAT(plain(result.err), HasSubstr("a.launch.xml:2:17: error: either a topic or nodes\n"));
  EXPECT_THAT(plain(result.err), HasSubstr("a.launch.xml:2:63: error: there is no bound\n"));
}

TEST_F(TestCommand, ARunWithoutEventsFailsWhatIsExpectedOfItsTrace) {
  const std::string file = write("a.launch.xml", R"xml(
  <executable name="step" cmd="true"/>
  <test name="a"><exit process="step"/><event name="ros2:rcl_init"/></test>
  <test name="b"><exit process="step"/><event name="ros2:rcl_init" max="0"/></test>)xml");
  const CommandResult result = run({file});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, HasSubstr(": b  "));
  EXPECT_THAT(result.out, HasSubstr("error: the trace is empty\n"));
  EXPECT_THAT(result.out, HasSubstr("error: the trace does not hold the events 'ros2:rcl_init' as expected\n"));
}

TEST_F(TestCommand, TracesOfTestsBesideEachOtherAreKeptApart) {
  // All have one topic and nodes of one name. Each must see its own publisher alone.
  const std::string file = write("a.launch.xml", R"xml(
  <node pkg="demo_nodes" exec="pong"/>
  <node pkg="demo_nodes" exec="ping" on_exit="shutdown">
    <param name="count" value="3"/><param name="period_ms" value="20"/>
  </node>
  <for len="6" name="i"><test name="turn $(index i)">
    <exit process="ping"/>
    <event name="ros2:rcl_publisher_init" where="topic_name == '/ping'" min="1" max="1"/>
    <event name="ros2:rcl_publisher_init" where="topic_name == '/pong'" process="pong" min="1" max="1"/>
    <event name="ros2:rcl_publisher_init" where="topic_name == '/pong'" process="ping" max="0"/>
    <delivery topic="/ping" min="3" max_lost="100"/>
  </test></for>)xml");
  const CommandResult result = run({file, "-j", "6"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
}

TEST_F(TestCommand, ATestThatFailsRunsAgainAndTheResultSaysSo) {
  const std::string file = write("a.launch.xml", R"xml(
  <executable name="flip" shell="true" cmd="mkdir $(dirname)/made 2&gt;/dev/null &amp;&amp; exit 3; exit 0"/>
  <test name="flaky"><exit process="flip"/></test>)xml");
  const fs::path junit = sandbox_.directory() / "j.xml";
  const CommandResult result = run({file, "--retries", "2", "--github", "--junit", junit});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr(" s  (2 attempts)\n      = first attempt: 'flip' has exited with code 3\n"));
  EXPECT_THAT(result.out, HasSubstr("1 test: 1 passed (1 only after a retry), in "));
  EXPECT_THAT(result.out,
              HasSubstr(",line=4,title=flaky::passed in attempt 2; the first: 'flip' has exited with code 3\n"));
  EXPECT_THAT(read_file(junit), HasSubstr("<flakyFailure message=\"'flip' has exited with code 3\"/>"));
  fs::remove(sandbox_.directory() / "made");
  EXPECT_THAT(run({file, "--github"}).out, HasSubstr(",line=4,title=flaky::"));
}

TEST_F(TestCommand, RepeatsTestsAndStopsAtTheFirstFailure) {
  // The fourth run fails.
  const std::string file = write("a.launch.xml", R"xml(
  <executable name="count" shell="true" cwd="$(dirname)"
              cmd="for i in 1 2 3; do mkdir run$i 2&gt;/dev/null &amp;&amp; exit 0; done; exit 1"/>
  <test name="t"><exit process="count"/></test>)xml");
  CommandResult result = run({file, "--until-failure", "-j", "1"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(plain(result.out), HasSubstr("PASS  a.launch.xml: t #3  T s\nFAIL  a.launch.xml: t #4  T s\n"));
  EXPECT_THAT(plain(result.out), HasSubstr("\n4 tests: 3 passed, 1 failed, in T s\n"));
  result = run({file, "--repeat", "2", "-j", "1"});
  EXPECT_THAT(plain(result.out), HasSubstr("\n2 tests: 0 passed, 2 failed, in T s\n"));
  EXPECT_EQ(run({file, "--repeat", "0"}).exit_code, 2);
}

TEST_F(TestCommand, ShardsHoldEachTestOnce) {
  const std::string file = write("a.launch.xml", R"xml(
  <executable name="say" cmd="true"/>
  <for len="5" name="i"><test name="t$(index i)"><exit process="say"/></test></for>)xml");
  EXPECT_EQ(plain(run({file, "--list", "--shard", "1/2"}).out),
            "a.launch.xml:4: t0\na.launch.xml:4: t2\na.launch.xml:4: t4\n");
  EXPECT_EQ(plain(run({file, "--list", "--shard", "2/2"}).out), "a.launch.xml:4: t1\na.launch.xml:4: t3\n");
  EXPECT_EQ(run({file, "--list", "--shard", "3/2"}).err,
            "launch test: error: --shard 3/2: there are only 2 parts\n      = help: see 'launch test --help'\n");
}

TEST_F(TestCommand, AnEngineGetsEachTestAndGivesItsResult) {
  const std::string file = write("a.launch.xml", R"xml(
  <arg name="code"/>
  <executable name="say" shell="true" cmd="echo of $BY_ENGINE; exit $(var code)"/>
  <test name="good 'one' $ &amp; all"><exit process="say" code="3"/><output text="of engine"/></test>
  <test name="bad"><exit process="say" code="4"/></test>)xml");
  // The command line goes through a shell, as it does with ssh.
  const fs::path engine = sandbox_.directory() / "engine";
  write_file(engine, "#!/bin/sh\necho something else\nexport BY_ENGINE=engine\neval \"$@\"\n");
  fs::permissions(engine, fs::perms::owner_all);
  CommandResult result = run({file, "code:=3", "--engine", engine});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(plain(result.out), HasSubstr("PASS  a.launch.xml: good 'one' $ & all  T s\n"));
  EXPECT_THAT(plain(result.out),
              HasSubstr("FAIL  a.launch.xml: bad  T s\na.launch.xml:6:21: error: 'say' has exited with code 3\n"));
  result = run({file, "code:=3", "-n", "bad", "--engine", "echo no"});
  EXPECT_THAT(plain(result.out),
              HasSubstr("a.launch.xml:6:4: error: the engine has ended with code 0, without a result\n"));
  EXPECT_THAT(result.out, HasSubstr("      |    ^~~~\nno "));
}

TEST_F(TestCommand, CTestRunsLaunchFilesOfAProject) {
  write("project/test/good.launch.xml", R"xml(
  <arg name="word"/>
  <executable name="say" cmd="printenv GREETING"/>
  <test name="says"><output process="say" text="$(var word)"/></test>)xml");
  write("project/test/bad.launch.xml", R"xml(<executable name="say" cmd="true"/>
  <test name="fails"><exit process="say" code="1"/></test>)xml");
  write_file(sandbox_.directory() / "project/CMakeLists.txt", R"cmake(cmake_minimum_required(VERSION 3.16)
project(mine LANGUAGES NONE)
find_package(launch_test REQUIRED)
find_package(launch_testing_ament_cmake REQUIRED)
enable_testing()
add_launch_test(test/good.launch.xml ARGS word:=hello ENV GREETING=hello TIMEOUT 90 LABELS system)
add_launch_test(test/bad.launch.xml TARGET bad)
)cmake");
  const fs::path build = sandbox_.directory() / "build";
  const CommandResult configured = run_command({.argv = {CMAKE, "-S", sandbox_.directory() / "project", "-B", build,
                                                         "-DCMAKE_PREFIX_PATH=" BUILD_DIRECTORY "/prefix"}},
                                               std::chrono::seconds(100));
  ASSERT_EQ(configured.exit_code, 0) << configured.out << configured.err;
  const std::string ctest = fs::path(CMAKE).parent_path() / "ctest";
  const CommandResult good =
      run_command({.argv = {ctest, "--test-dir", build, "-L", "^system$", "-V"}}, std::chrono::seconds(100));
  EXPECT_EQ(good.exit_code, 0) << good.out << good.err;
  EXPECT_THAT(good.out, HasSubstr("test_good.launch.xml"));
  EXPECT_THAT(read_file(build / "test_results/mine/test_good.launch.xml.xunit.xml"),
              HasSubstr("<testcase name=\"says\""));
  const CommandResult bad =
      run_command({.argv = {ctest, "--test-dir", build, "-R", "^bad$"}}, std::chrono::seconds(100));
  EXPECT_EQ(bad.exit_code, 8) << bad.out << bad.err;
  EXPECT_THAT(read_file(build / "test_results/mine/bad.xunit.xml"), HasSubstr("'say' has exited with code 0"));
}

class ExampleTests : public testing::TestWithParam<const char*> {};

TEST_P(ExampleTests, PassOrFailAsTheReadmeSays) {
  Sandbox sandbox;
  const std::string folder = EXAMPLES_DIRECTORY "/";
  const CommandResult good = run_command({.argv = {LAUNCH_PROGRAM, "test", folder + "40_test.launch." + GetParam()}},
                                         std::chrono::seconds(100));
  EXPECT_EQ(good.exit_code, 0) << good.out << good.err;
  EXPECT_THAT(good.out, HasSubstr("\n3 tests: 3 passed, in "));
  const CommandResult bad = run_command(
      {.argv = {LAUNCH_PROGRAM, "test", folder + "41_failing_test.launch." + GetParam()}}, std::chrono::seconds(100));
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_THAT(bad.out, HasSubstr("\n4 tests: 0 passed, 4 failed, in "));
  EXPECT_THAT(bad.out, HasSubstr("error: there is a line with 'count 3' from 'counter'\n"));
  EXPECT_THAT(bad.out, HasSubstr("error: 'crash' has exited with code 2\n"));
  EXPECT_THAT(bad.out, HasSubstr("      = expected: an exit with code 3\n"));
  EXPECT_THAT(bad.out, HasSubstr("error: unexpected-2 has exited with code 7\n"));
  const CommandResult traced = run_command(
      {.argv = {LAUNCH_PROGRAM, "test", folder + "42_trace_test.launch." + GetParam()}}, std::chrono::seconds(100));
  EXPECT_EQ(traced.exit_code, 0) << traced.out << traced.err;
  const CommandResult late = run_command(
      {.argv = {LAUNCH_PROGRAM, "test", folder + "43_latency_budget.launch." + GetParam()}}, std::chrono::seconds(100));
  EXPECT_EQ(late.exit_code, 1);
  EXPECT_THAT(late.out, HasSubstr("error: messages of '/ping' do not take the time that is expected\n"));
  EXPECT_THAT(late.out, HasSubstr(" outside; least "));
  EXPECT_THAT(late.out, HasSubstr("error: the chain /ping /pong does not take the time that is expected\n"));
  EXPECT_THAT(late.out, HasSubstr("nearest events:"));
}

TEST_P(ExampleTests, OfFaultsDoWhatTheirCommentsSay) {
  const std::string folder = EXAMPLES_DIRECTORY "/";
  const CommandResult faults = run_command(
      {.argv = {LAUNCH_PROGRAM, "test", folder + "46_faults.launch." + GetParam()}}, std::chrono::seconds(100));
  EXPECT_EQ(faults.exit_code, 0) << faults.out << faults.err;
  EXPECT_THAT(faults.out, HasSubstr("(1 of 1 fault)\n"));
  const CommandResult crash = run_command({.argv = {LAUNCH_PROGRAM, "test", folder + "46_faults.launch." + GetParam(),
                                                    "-n", "ping ends well", "--seed", "9", "--shrink"}},
                                          std::chrono::seconds(100));
  EXPECT_EQ(crash.exit_code, 1) << crash.out << crash.err;
  EXPECT_THAT(crash.out, HasSubstr("      = shrunk to 1 of "));
  EXPECT_THAT(crash.out, HasSubstr(": kill of 'ping' at "));
  const CommandResult messages =
      run_command({.argv = {LAUNCH_PROGRAM, "test", folder + "48_message_faults.launch." + GetParam(), "--seeds", "3"}},
                  std::chrono::seconds(100));
  EXPECT_EQ(messages.exit_code, 0) << messages.out << messages.err;
  EXPECT_THAT(messages.out, HasSubstr("6 tests: 6 passed, in "));
  const CommandResult network = run_command(
      {.argv = {LAUNCH_PROGRAM, "test", folder + "49_network_faults.launch." + GetParam()}}, std::chrono::seconds(100));
  EXPECT_EQ(network.exit_code, 0) << network.out << network.err;
  EXPECT_THAT(network.out, HasSubstr("2 tests: 2 passed, in "));
  const CommandResult clock = run_command(
      {.argv = {LAUNCH_PROGRAM, "test", folder + "47_clock_faults.launch." + GetParam()}}, std::chrono::seconds(100));
  EXPECT_EQ(clock.exit_code, 0) << clock.out << clock.err;
  const CommandResult services =
      run_command({.argv = {LAUNCH_PROGRAM, "test", folder + "52_service_faults.launch." + GetParam(), "--seeds", "2"}},
                  std::chrono::seconds(100));
  EXPECT_EQ(services.exit_code, 0) << services.out << services.err;
  EXPECT_THAT(services.out, HasSubstr("6 tests: 6 passed, in "));
  const CommandResult disk = run_command(
      {.argv = {LAUNCH_PROGRAM, "test", folder + "53_full_disk.launch." + GetParam()}}, std::chrono::seconds(100));
  EXPECT_EQ(disk.exit_code, 0) << disk.out << disk.err;
  EXPECT_THAT(disk.out, HasSubstr("2 tests: 2 passed, in "));
}

INSTANTIATE_TEST_SUITE_P(Both, ExampleTests, testing::Values("xml", "yaml"));

}  // namespace
