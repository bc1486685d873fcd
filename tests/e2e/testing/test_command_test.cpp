// SPDX-License-Identifier: Apache-2.0
// `launch test`: the tests of launch files, those that pass and those that do not.
#include <gmock/gmock.h>
#include <sys/mount.h>

#include <filesystem>

#include "tests/e2e/testing/launch_test_fixture.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;
using testing::Not;

namespace fs = std::filesystem;

class TestCommand : public LaunchTestFixture {};

TEST_F(TestCommand, TellsWhatHasFailedAtItsPlace) {
  const std::string file = write("a.launch.xml", R"xml(
  <executable name="counter" shell="true" cmd="for i in 1 2 3; do echo count $i; done; exec cat"/>
  <test name="counts to four">
    <output process="counter" text="count 4" within="2"/>
  </test>)xml");
  const CommandResult result = run({file});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(plain(result.out), R"(FAIL  a.launch.xml: counts to four  T s
a.launch.xml:5:6: error: there was not a line with 'count 4' from 'counter' within 2 s
    5 |     <output process="counter" text="count 4" within="2"/>
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
      = not judged: 1 expectation
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

}  // namespace
