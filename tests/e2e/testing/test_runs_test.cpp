// SPDX-License-Identifier: Apache-2.0
// `launch test`: which tests run, how often, and beside which others.
#include <gmock/gmock.h>
#include <signal.h>

#include <fstream>
#include <set>

#include "tests/e2e/testing/launch_test_fixture.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;

namespace fs = std::filesystem;

class TestRuns : public LaunchTestFixture {};

TEST_F(TestRuns, EachTurnOfALoopIsATestAndNamesChooseThem) {
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

TEST_F(TestRuns, TestsBesideEachOtherHaveDomainsAndDirectoriesOfTheirOwn) {
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

TEST_F(TestRuns, CtrlCEndsTheTestsAndLeavesNothing) {
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

TEST_F(TestRuns, TestsEndWhenTheRunnerIsKilled) {
  const std::string file = write("a.launch.xml", R"xml(
  <executable name="server" shell="true" cmd="touch $(dirname)/up; exec cat"/>
  <test name="t"><output text="never"/></test>)xml");
  RunningCommand command({.argv = {LAUNCH_PROGRAM, "test", file}});
  ASSERT_TRUE(appears("up"));
  command.send_signal(SIGKILL);
  command.wait();
  Sandbox::wait_until_daemons_are_left();
}

TEST_F(TestRuns, TracesOfTestsBesideEachOtherAreKeptApart) {
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

TEST_F(TestRuns, ATestThatFailsRunsAgainAndTheResultSaysSo) {
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

TEST_F(TestRuns, RepeatsTestsAndStopsAtTheFirstFailure) {
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

TEST_F(TestRuns, ShardsHoldEachTestOnce) {
  const std::string file = write("a.launch.xml", R"xml(
  <executable name="say" cmd="true"/>
  <for len="5" name="i"><test name="t$(index i)"><exit process="say"/></test></for>)xml");
  EXPECT_EQ(plain(run({file, "--list", "--shard", "1/2"}).out),
            "a.launch.xml:4: t0\na.launch.xml:4: t2\na.launch.xml:4: t4\n");
  EXPECT_EQ(plain(run({file, "--list", "--shard", "2/2"}).out), "a.launch.xml:4: t1\na.launch.xml:4: t3\n");
  EXPECT_EQ(run({file, "--list", "--shard", "3/2"}).err,
            "launch test: error: --shard 3/2: there are only 2 parts\n      = help: see 'launch test --help'\n");
}

}  // namespace
