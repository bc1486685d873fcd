// SPDX-License-Identifier: Apache-2.0
// Real processes that hang in several ways are found, and what follows is done.
#include <gmock/gmock.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using namespace test_support;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

constexpr std::chrono::seconds kPatience(60);

class Health : public testing::Test {
 protected:
  CommandResult launch(const std::string& actions) {
    return run_command({.argv = {LAUNCH_PROGRAM, write(actions)}}, kPatience);
  }
  std::string write(const std::string& actions) {
    const fs::path path = sandbox_.directory() / "system.launch.xml";
    write_file(path, "<launch>\n" + actions + "\n</launch>\n");
    return path.string();
  }
  // A node that hangs as `how` says, after a quarter of a second, and ends the launch by it.
  CommandResult hang(const std::string& how, const std::string& watch) {
    return launch(R"xml(<executable name="node" output="screen" sigterm_timeout="0.2")xml"
                  R"xml( sigkill_timeout="0.2" cmd=")xml" HANGING_NODE " " +
                  how + "\">" + watch + "</executable>");
  }

  Sandbox sandbox_;
};

constexpr const char* kExecutor = R"xml(<watch kind="executor" timeout="1" on_unhealthy="shutdown"/>)xml";

TEST_F(Health, FindsACallbackThatSleepsForEver) {
  const CommandResult result = hang("sleep", kExecutor);
  EXPECT_THAT(
      result.err + result.out,
      ContainsRegex("\\[node-1\\]: process is unhealthy: a timer callback has run for [0-9]+\\.[0-9] s, its thread "
                    "sleeps \\(.*system.launch.xml:2:"));
  EXPECT_EQ(result.exit_code, 3) << result.out << result.err;
}

TEST_F(Health, FindsADeadlock) {
  const CommandResult result = hang("deadlock", kExecutor);
  EXPECT_THAT(result.err + result.out, HasSubstr("process is unhealthy: a timer callback has run for"));
  EXPECT_EQ(result.exit_code, 3);
}

TEST_F(Health, FindsACallbackThatComputesForEver) {
  const CommandResult result = hang("compute", kExecutor);
  EXPECT_THAT(result.err + result.out, HasSubstr("process is unhealthy: a timer callback has run for"));
  EXPECT_EQ(result.exit_code, 3);
}

TEST_F(Health, FindsOneHangingThreadOfAnExecutorWithSeveral) {
  const CommandResult result = hang("threads", kExecutor);
  EXPECT_THAT(result.err + result.out, HasSubstr("process is unhealthy: a timer callback has run for"));
  EXPECT_EQ(result.exit_code, 3);
}

TEST_F(Health, FindsALoopThatSpinsNoMore) {
  const CommandResult result = hang("away", kExecutor);
  EXPECT_THAT(result.err + result.out, HasSubstr("process is unhealthy: no executor has spun for "));
  EXPECT_EQ(result.exit_code, 3);
}

TEST_F(Health, FindsANodeThatHangsBeforeItSpins) {
  const CommandResult result = hang("constructor", kExecutor);
  EXPECT_THAT(result.err + result.out, HasSubstr("process is unhealthy: no executor has begun to spin for "));
  EXPECT_EQ(result.exit_code, 3);
}

TEST_F(Health, FindsANodeThatPrintsNoMore) {
  const CommandResult result =
      hang("sleep", R"xml(<watch kind="output" pattern="^tick" timeout="1" on_unhealthy="shutdown"/>)xml");
  EXPECT_THAT(result.err + result.out,
              HasSubstr("process is unhealthy: it has not printed a line that matches '^tick' for"));
  EXPECT_EQ(result.exit_code, 3);
}

TEST_F(Health, FindsACommandThatFails) {
  const CommandResult result = launch(R"xml(<executable name="one" cmd="sleep 1000" cwd="/">
                  <env name="WORD" value="no answer"/>
                  <watch kind="command" cmd="sh -c 'echo $WORD in $PWD; exit 3'" interval="0.1" on_unhealthy="shutdown"/>
                </executable>)xml");
  EXPECT_THAT(result.err + result.out,
              HasSubstr("process is unhealthy: the command of its watch has ended with exit code 3 (no answer in /)"));
  EXPECT_EQ(result.exit_code, 3);
}

TEST_F(Health, FindsAProcessThatIsStopped) {
  const CommandResult result = launch(R"xml(<executable name="one" cmd="sh -c 'kill -STOP $$'">
                  <watch kind="blocked" timeout="0.5" on_unhealthy="shutdown"/>
                </executable>)xml");
  EXPECT_THAT(result.err + result.out, HasSubstr("process is unhealthy: it has been stopped by a signal for"));
  EXPECT_EQ(result.exit_code, 3);
}

TEST_F(Health, RestartsAHungNodeAndTellsHandlersOfIt) {
  const CommandResult result = launch(R"xml(<executable name="node" sigterm_timeout="0.2" sigkill_timeout="0.2"
                                            cmd=")xml" HANGING_NODE R"xml( sleep">
                                  <watch kind="executor" timeout="1" on_unhealthy="restart"/>
                                </executable>
                                <on_health_change process="node" to="unhealthy">
                                  <log message="handler: $(var event.process) $(var event.health): $(var event.reason)"/>
                                </on_health_change>
                                <on_health_change process="node" to="healthy">
                                  <log message="handler: healthy"/>
                                </on_health_change>
                                <on_process_exit process="node" once="true">
                                  <on_process_exit process="node"><shutdown/></on_process_exit>
                                </on_process_exit>)xml");
  EXPECT_THAT(result.out, AllOf(HasSubstr("handler: healthy"),
                                HasSubstr("handler: node-1 unhealthy: a timer callback has run for "),
                                HasSubstr("restarting the process, because it is unhealthy")));
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.out + result.err, HasSubstr("  node-1: "));
}

TEST_F(Health, ASignalLeavesACrashBundleAndTheHangIsDescribedInAnotherOne) {
  const CommandResult result = hang("sleep\" crash-dir=\"" + (sandbox_.directory() / "crashes").string(),
                                    R"xml(<watch kind="executor" timeout="1" on_unhealthy="signal"/>)xml");
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("bundle of node-1, which is unhealthy: "), HasSubstr("crash bundle of node-1: ")));
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(sandbox_.directory() / "crashes")) {
    files.push_back(entry.path().filename().string());
  }
  EXPECT_EQ(std::count(files.begin(), files.end(), "health.txt"), 1);
  EXPECT_EQ(std::count(files.begin(), files.end(), "crash.txt"), 1);
  EXPECT_EQ(result.exit_code, 3);
}

TEST_F(Health, AProcessStartsWhenAnotherOneIsHealthy) {
  const CommandResult result = launch(R"xml(<executable name="node" cmd=")xml" HANGING_NODE R"xml( idle">
                                  <watch kind="executor"/>
                                </executable>
                                <executable cmd="echo it is healthy" output="screen" on_exit="shutdown">
                                  <depends_on process="node" condition="healthy" timeout="20"/>
                                </executable>)xml");
  EXPECT_THAT(result.out, AllOf(HasSubstr("waits until 'node' is healthy"), HasSubstr("it is healthy\n")));
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
}

TEST_F(Health, IsInPsAndInEvents) {
  RunningCommand launch({.argv = {LAUNCH_PROGRAM, write(R"xml(<executable name="node" sigterm_timeout="0.2"
                           sigkill_timeout="0.2" cmd=")xml" HANGING_NODE R"xml( sleep">
                           <watch kind="executor" timeout="2"/></executable>)xml")}});
  ASSERT_TRUE(launch.wait_for_output("process started", kPatience));
  RunningCommand events({.argv = {LAUNCH_PROGRAM, "events"}});
  ASSERT_TRUE(events.wait_for_output(R"("event":"health","process":"node-1","health":"unhealthy","reason":"a timer)",
                                     kPatience));
  const CommandResult table = run_command({LAUNCH_PROGRAM, "ps"});
  EXPECT_THAT(table.out, HasSubstr("running, unhealthy"));
  const CommandResult json = run_command({LAUNCH_PROGRAM, "ps", "--json"});
  EXPECT_THAT(json.out, AllOf(ContainsRegex("\"health\": *\"unhealthy\""),
                              ContainsRegex("\"health_reason\": *\"a timer callback has run for 2")));
  launch.send_signal(SIGINT);
  launch.wait(kPatience);
}

TEST_F(Health, AStopByTheTerminalIsNoHang) {
  RunningCommand launch(
      {.argv = {LAUNCH_PROGRAM, write(R"xml(<executable name="node" output="screen" cmd=")xml" HANGING_NODE
                                      R"xml( ever"><watch kind="executor" timeout="1"/></executable>)xml")}});
  ASSERT_TRUE(launch.wait_for_output("tick 5", kPatience));
  launch.send_signal(SIGTSTP);
  // The launch stops itself and all its processes.
  run_command({"sleep", "3"});
  launch.send_signal(SIGCONT);
  ASSERT_TRUE(launch.wait_for_output("tick 40", kPatience));
  launch.send_signal(SIGINT);
  const CommandResult result = launch.wait(kPatience);
  EXPECT_THAT(result.out + result.err, Not(HasSubstr("unhealthy")));
  EXPECT_EQ(result.exit_code, 0);
}

TEST_F(Health, AForeignProgramIsNotJudgedAndTheUserIsTold) {
  RunningCommand launch({.argv = {LAUNCH_PROGRAM, write(R"xml(<executable name="other" cmd="sleep 60">
                           <watch kind="executor" timeout="0.5" on_unhealthy="restart"/></executable>)xml")}});
  ASSERT_TRUE(launch.wait_for_output("it tells nothing of its executors, so they can't be watched", kPatience));
  launch.send_signal(SIGINT);
  EXPECT_THAT(launch.wait(kPatience).out, Not(HasSubstr("unhealthy")));
}

TEST_F(Health, AProcessIsGivenUpWhenItStartsTooOften) {
  const CommandResult result = launch(R"xml(<executable name="flapping" cmd="false" respawn="true" respawn_delay="0.05"
                                            start_limit="4" start_limit_interval="30"/>
                                <on_start_limit process="flapping">
                                  <log message="handler: given up after $(var event.starts) starts"/>
                                </on_start_limit>)xml");
  const std::string all = result.out + result.err;
  EXPECT_THAT(all, HasSubstr("process has been started 4 times in 30 s; it is not started again"));
  EXPECT_THAT(all, HasSubstr("handler: given up after 4 starts"));
  EXPECT_THAT(all, HasSubstr("the last of 4 failures"));
  EXPECT_EQ(result.exit_code, 3);
}

TEST_F(Health, AProcessThatStartsTooOftenEndsTheLaunch) {
  const CommandResult result = launch(R"xml(<executable name="flapping" cmd="false" respawn="true" respawn_delay="0.05"
                                            start_limit="3" on_start_limit="shutdown"/>
                                <executable cmd="sleep 1000"/>)xml");
  EXPECT_THAT(result.out + result.err,
              HasSubstr("process[flapping-1] has reached its limit of starts: shutting down launched system"));
  EXPECT_EQ(result.exit_code, 3);
}

}  // namespace
