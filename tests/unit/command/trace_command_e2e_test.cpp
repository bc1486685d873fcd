// SPDX-License-Identifier: Apache-2.0
// `launch trace` as a program, on a session daemon of the test's own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"
#include "tests/unit/session/trace_reading.hpp"

namespace {

using test_support::Command;
using test_support::CommandResult;
using test_support::run_command;
using test_support::RunningCommand;
using test_support::Sandbox;
using trace_test::listed_sessions;
using trace_test::read_trace;
using trace_test::TracedApp;

struct TraceCommandE2e : testing::Test {
  // Runs `launch trace` interactively around one traced application; `end` ends it.
  template <typename End>
  CommandResult record(End end) {
    RunningCommand command({.argv = {TRACE_COMMAND, "-s", "run"}});
    EXPECT_TRUE(command.wait_for_output("press enter to start..."));
    EXPECT_EQ(run_command({"lttng", "list"}).exit_code, 1) << "something was started before the first Enter";
    command.write("\n");
    EXPECT_TRUE(command.wait_for_output("press enter to stop..."));
    TracedApp(30, 20).end();
    end(command);
    return command.wait();
  }

  void expect_recorded(const CommandResult& result) {
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.err, "");
    EXPECT_EQ(result.out,
              "userspace tracing enabled (42 events)\n"
              "kernel tracing disabled\n"
              "syscalls tracing disabled\n"
              "context (3 fields)\n"
              "writing tracing session to: " +
                  trace +
                  "\n"
                  "press enter to start...\n"
                  "press enter to stop...\n"
                  "stopping & destroying tracing session\n"
                  "no events lost\n");
    EXPECT_TRUE(result.output_closed) << "the session daemon holds our output open";
    EXPECT_EQ(read_trace(trace).complaints, "");
    EXPECT_EQ(read_trace(trace).events["ros2:rclcpp_callback_register"], 30);
    EXPECT_EQ(listed_sessions(), "");
  }

  Sandbox sandbox;
  std::string trace = sandbox.trace_directory() / "run";
};

TEST_F(TraceCommandE2e, EnterEndsTheTrace) {
  expect_recorded(record([](RunningCommand& command) { command.write("\n"); }));
}

TEST_F(TraceCommandE2e, SigintEndsTheTrace) {
  expect_recorded(record([](RunningCommand& command) { command.send_signal(SIGINT); }));
}

TEST_F(TraceCommandE2e, SigtermEndsTheTrace) {
  expect_recorded(record([](RunningCommand& command) { command.send_signal(SIGTERM); }));
}

TEST_F(TraceCommandE2e, SigintBeforeTheFirstEnterCreatesNothing) {
  RunningCommand command({.argv = {TRACE_COMMAND, "-s", "run"}});
  ASSERT_TRUE(command.wait_for_output("press enter to start..."));
  command.send_signal(SIGINT);
  EXPECT_EQ(command.wait().exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(trace));
  EXPECT_EQ(run_command({"lttng", "list"}).exit_code, 1) << "a session daemon was started";
}

TEST_F(TraceCommandE2e, VerbsControlASession) {
  EXPECT_EQ(run_command({TRACE_COMMAND, "start", "run"}).exit_code, 0);
  EXPECT_THAT(listed_sessions(), testing::HasSubstr("run [active]"));
  TracedApp app(10, 10);
  EXPECT_EQ(run_command({TRACE_COMMAND, "pause", "run"}).exit_code, 0);
  EXPECT_THAT(listed_sessions(), testing::HasSubstr("run [inactive]"));
  app.fire_again();
  EXPECT_EQ(run_command({TRACE_COMMAND, "resume", "run"}).exit_code, 0);
  app.fire_again();
  const CommandResult stopped = run_command({TRACE_COMMAND, "stop", "run"});
  EXPECT_EQ(stopped.exit_code, 0);
  EXPECT_EQ(stopped.out, "stopping & destroying tracing session\nno events lost\n");
  app.end();
  EXPECT_EQ(read_trace(trace).events["ros2:rclcpp_callback_register"], 20);
  EXPECT_EQ(listed_sessions(), "");
}

TEST_F(TraceCommandE2e, SnapshotIsRecordedByItsVerb) {
  EXPECT_EQ(run_command({TRACE_COMMAND, "start", "run", "--snapshot-mode"}).exit_code, 0);
  TracedApp app(10, 10);
  EXPECT_EQ(run_command({TRACE_COMMAND, "record_snapshot", "run"}).exit_code, 0);
  EXPECT_EQ(run_command({TRACE_COMMAND, "stop", "run"}).exit_code, 0);
  app.end();
  EXPECT_EQ(read_trace(trace).events["ros2:rclcpp_callback_register"], 10);
}

TEST_F(TraceCommandE2e, ListStatusAndEventsTellWhatTheDaemonKnows) {
  EXPECT_EQ(run_command({TRACE_COMMAND, "list"}).out, "no trace sessions\n");
  EXPECT_EQ(run_command({"lttng", "list"}).exit_code, 1) << "a session daemon was started";
  ASSERT_EQ(run_command({TRACE_COMMAND, "start", "run", "-u", "ros2:*"}).exit_code, 0);
  TracedApp app(10, 10);
  EXPECT_EQ(run_command({TRACE_COMMAND, "list"}).out, "run (recording) " + trace + "\n");
  EXPECT_THAT(run_command({TRACE_COMMAND, "status", "run"}).out,
              testing::MatchesRegex("run \\(recording\\) .*\n  ust channel ros2: .*\n    1 event rule: ros2:\\*\n"
                                    "  no events lost\n"));
  EXPECT_THAT(run_command({TRACE_COMMAND, "events"}).out,
              testing::ContainsRegex("\n  ros2:rcl_init \\(traced_app [0-9]+\\)\n"));
  app.end();
  ASSERT_EQ(run_command({TRACE_COMMAND, "pause", "run"}).exit_code, 0);
  EXPECT_EQ(run_command({TRACE_COMMAND, "list"}).out, "run (paused) " + trace + "\n");
  const CommandResult unknown = run_command({TRACE_COMMAND, "status", "walk"});
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_EQ(unknown.err,
            "error: there is no trace session 'walk'\nhint: `launch trace list` shows the sessions that exist\n");
  EXPECT_EQ(run_command({TRACE_COMMAND, "stop", "run"}).exit_code, 0);
}

TEST_F(TraceCommandE2e, VerbOnASessionThatDoesNotExistIsAnError) {
  ASSERT_EQ(run_command({"lttng-sessiond", "--daemonize"}).exit_code, 0);
  const CommandResult result = run_command({TRACE_COMMAND, "pause", "run"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err,
            "error: cannot pause trace session 'run': Session name not found\n"
            "hint: `launch trace list` shows the sessions that exist\n");
}

TEST_F(TraceCommandE2e, WithoutLttngTheExitCodeIsTwo) {
  const CommandResult result =
      run_command({.argv = {TRACE_COMMAND, "start", "run"}, .environment = {{"PATH", "/nowhere"}}});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err,
            "error: cannot trace: lttng-sessiond is not installed or not in PATH\n"
            "hint: install LTTng: sudo apt-get install lttng-tools liblttng-ust-dev\n");
}

}  // namespace
