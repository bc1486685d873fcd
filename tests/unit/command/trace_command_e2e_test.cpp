// SPDX-License-Identifier: Apache-2.0
// `launch trace` as a program, on a session daemon of the test's own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

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
                  "trace written to: " +
                  trace + "\ntrace is complete: no events lost\n");
    EXPECT_TRUE(result.output_closed) << "the session daemon holds our output open";
    EXPECT_EQ(read_trace(trace).complaints, "");
    EXPECT_EQ(read_trace(trace).events["ros2:rclcpp_callback_register"], 30);
    EXPECT_EQ(listed_sessions(), "");
  }

  // From now on it accepts connections, and answers nothing. Returns its number.
  static pid_t stop_session_daemon() {
    const pid_t daemon = std::stoi(
        test_support::read_file(geteuid() == 0 ? "/run/lttng/lttng-sessiond.pid"
                                               : std::string(getenv("LTTNG_HOME")) + "/.lttng/lttng-sessiond.pid"));
    kill(daemon, SIGSTOP);
    EXPECT_EQ(waitpid(daemon, nullptr, WUNTRACED), daemon);  // it is an orphan now, so it is a child of the sandbox
    return daemon;
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
  EXPECT_THAT(test_support::read_file(trace + "/verdict.json"), testing::HasSubstr("\"complete\": true"));
  app.fire_again();
  EXPECT_EQ(run_command({TRACE_COMMAND, "resume", "run"}).exit_code, 0);
  app.fire_again();
  const CommandResult stopped = run_command({TRACE_COMMAND, "stop", "run"});
  EXPECT_EQ(stopped.exit_code, 0);
  EXPECT_EQ(stopped.out, "stopping & destroying tracing session\ntrace written to: " + trace +
                             "\ntrace is complete: no events lost\n");
  app.end();
  EXPECT_EQ(read_trace(trace).events["ros2:rclcpp_callback_register"], 20);
  EXPECT_EQ(listed_sessions(), "");
}

TEST_F(TraceCommandE2e, StartGoesOnWhenNobodyReadsItsOutput) {
  const std::string command = std::string(TRACE_COMMAND) + " start run -l; echo $? >&2";
  EXPECT_EQ(run_command({"sh", "-c", "(" + command + ") | true"}).err, "0\n");
  EXPECT_THAT(listed_sessions(), testing::HasSubstr("run [active]"));
  EXPECT_EQ(run_command({TRACE_COMMAND, "stop", "run"}).exit_code, 0);
}

// The signal comes before, while or after the session is made.
TEST_F(TraceCommandE2e, ASignalLeavesNoSessionHalfMade) {
  EXPECT_EQ(run_command({TRACE_COMMAND, "start", "other"}).exit_code, 0) << "the daemon runs now";
  for (int i = 0; i < 8; ++i) {
    RunningCommand start({.argv = {TRACE_COMMAND, "start", "run", "-a"}});
    if (i != 0) {
      ASSERT_TRUE(start.wait_for_output("writing tracing session to: ")) << start.err();
    }
    start.send_signal(i % 2 == 0 ? SIGTERM : SIGHUP);
    const CommandResult result = start.wait();
    if (result.exit_code == 0) {
      EXPECT_EQ(run_command({TRACE_COMMAND, "stop", "run"}).exit_code, 0);
    } else if (result.signal == 0) {
      EXPECT_EQ(result.err, "launch trace start: error: interrupted: session 'run' was ended again\n");
    }
    EXPECT_THAT(listed_sessions(), testing::Not(testing::HasSubstr("run [")));
  }
  Sandbox::wait_until_daemons_are_left();  // who ends a session for a command that a signal has killed may live a
                                           // moment longer
}

// kill -9 comes while the session is made, or a little later.
TEST_F(TraceCommandE2e, AKilledCommandLeavesNoSession) {
  EXPECT_EQ(run_command({TRACE_COMMAND, "start", "other"}).exit_code, 0) << "the daemon runs now";
  for (int i = 0; i < 5; ++i) {
    RunningCommand start({.argv = {TRACE_COMMAND, "start", "run", "-a"}});
    ASSERT_TRUE(start.wait_for_output("writing tracing session to: ")) << start.err();
    start.send_signal(SIGKILL);
    const CommandResult result = start.wait();
    Sandbox::wait_until_daemons_are_left();
    if (result.exit_code == 0) {
      EXPECT_EQ(run_command({TRACE_COMMAND, "stop", "run"}).exit_code, 0);
    }
    EXPECT_THAT(listed_sessions(), testing::Not(testing::HasSubstr("run [")));
  }
}

TEST_F(TraceCommandE2e, AKilledInteractiveCommandLeavesAWholeTrace) {
  RunningCommand command({.argv = {TRACE_COMMAND, "-s", "run"}});
  EXPECT_TRUE(command.wait_for_output("press enter to start..."));
  command.write("\n");
  EXPECT_TRUE(command.wait_for_output("press enter to stop..."));
  TracedApp(30, 20).end();
  command.send_signal(SIGKILL);
  command.wait();
  Sandbox::wait_until_daemons_are_left();
  EXPECT_EQ(listed_sessions(), "");
  EXPECT_EQ(read_trace(trace).events["ros2:rclcpp_callback_register"], 30);
  EXPECT_THAT(test_support::read_file(trace + "/verdict.json"), testing::HasSubstr("\"complete\": true"));
}

// A daemon that is stopped accepts connections, and answers nothing.
TEST_F(TraceCommandE2e, NoVerbWaitsForAStoppedDaemonAndTheEndOfASessionContinuesIt) {
  EXPECT_EQ(run_command({TRACE_COMMAND, "start", "run"}).exit_code, 0);
  const pid_t daemon = stop_session_daemon();
  const std::string pid = std::to_string(daemon);
  for (const std::vector<std::string>& verb : std::vector<std::vector<std::string>>{{"list"},
                                                                                    {"status"},
                                                                                    {"status", "run"},
                                                                                    {"pause", "run"},
                                                                                    {"resume", "run"},
                                                                                    {"record_snapshot", "run"},
                                                                                    {"save", "run"},
                                                                                    {"events"},
                                                                                    {"start", "another"}}) {
    std::vector<std::string> argv = {TRACE_COMMAND};
    argv.insert(argv.end(), verb.begin(), verb.end());
    const CommandResult result = run_command(argv);
    EXPECT_FALSE(result.timed_out) << verb.front();
    EXPECT_EQ(result.exit_code, 1) << verb.front();
    EXPECT_EQ(result.err, "launch trace " + verb.front() + ": error: the LTTng session daemon (process " + pid +
                              ") is stopped and does not answer\n      = help: continue it with `kill -CONT " + pid +
                              "`\n")
        << verb.front();
  }
  // The end of a session continues it.
  const CommandResult stop = run_command({TRACE_COMMAND, "stop", "run"});
  EXPECT_EQ(stop.exit_code, 0);
  EXPECT_EQ(stop.err, "launch trace stop: note: LTTng's session daemon (process " + pid +
                          ") was stopped; it was continued, so that the session could end\n");
}

// The guardian of a killed launcher asks how old the session is.
TEST_F(TraceCommandE2e, AStoppedDaemonIsContinuedToTellTheAgeOfASession) {
  EXPECT_EQ(run_command({TRACE_COMMAND, "start", "run"}).exit_code, 0);
  const pid_t daemon = stop_session_daemon();
  const CommandResult stop = run_command({TRACE_COMMAND, "stop", "run", "--created-since=0"});
  EXPECT_EQ(stop.exit_code, 0);
  EXPECT_EQ(stop.err, "launch trace stop: note: LTTng's session daemon (process " + std::to_string(daemon) +
                          ") was stopped; it was continued, so that the session could end\n");
  EXPECT_EQ(listed_sessions(), "");
}

TEST_F(TraceCommandE2e, ASessionWithoutASnapshotNamesNoFolder) {
  EXPECT_EQ(run_command({TRACE_COMMAND, "start", "run", "--snapshot-mode"}).exit_code, 0);
  EXPECT_EQ(run_command({TRACE_COMMAND, "stop", "run"}).out,
            "stopping & destroying tracing session\nno trace was written: no snapshot was taken\n");
}

TEST_F(TraceCommandE2e, SnapshotIsRecordedByItsVerb) {
  EXPECT_EQ(run_command({TRACE_COMMAND, "start", "run", "--snapshot-mode"}).exit_code, 0);
  TracedApp app(10, 10);
  EXPECT_EQ(run_command({TRACE_COMMAND, "record_snapshot", "run"}).exit_code, 0);
  EXPECT_EQ(run_command({TRACE_COMMAND, "stop", "run"}).out,
            "stopping & destroying tracing session\nsnapshots are in: " + trace + "\n");
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
            "launch trace status: error: there is no trace session 'walk'\n"
            "      = help: `launch trace list` shows the sessions that exist\n");
  EXPECT_EQ(run_command({TRACE_COMMAND, "stop", "run"}).exit_code, 0);
}

TEST_F(TraceCommandE2e, VerbOnASessionThatDoesNotExistIsAnError) {
  ASSERT_EQ(run_command({"lttng-sessiond", "--daemonize"}).exit_code, 0);
  const CommandResult result = run_command({TRACE_COMMAND, "pause", "run"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err,
            "launch trace pause: error: cannot pause trace session 'run': Session name not found\n"
            "      = help: `launch trace list` shows the sessions that exist\n");
}

TEST_F(TraceCommandE2e, StoppingASessionAgainLeavesTheVerdictOfItsTrace) {
  EXPECT_EQ(run_command({TRACE_COMMAND, "start", "run"}).exit_code, 0);
  TracedApp(10, 10).end();
  EXPECT_EQ(run_command({TRACE_COMMAND, "pause", "run"}).exit_code, 0);
  EXPECT_EQ(run_command({TRACE_COMMAND, "resume", "run"}).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(trace + "/verdict.json")) << "that of the pause";
  EXPECT_EQ(run_command({TRACE_COMMAND, "stop", "run"}).exit_code, 0);
  const std::string verdict = test_support::read_file(trace + "/verdict.json");
  EXPECT_THAT(verdict, testing::HasSubstr("\"complete\": true"));
  const CommandResult again = run_command({TRACE_COMMAND, "stop", "run"});
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_EQ(again.err,
            "launch trace stop: error: cannot stop trace session 'run': Session name not found\n"
            "      = help: `launch trace list` shows the sessions that exist\n");
  EXPECT_EQ(test_support::read_file(trace + "/verdict.json"), verdict);
}

TEST_F(TraceCommandE2e, StoppingASessionOfSnapshotsAgainWritesNoVerdict) {
  EXPECT_EQ(run_command({TRACE_COMMAND, "start", "run", "--snapshot-mode"}).exit_code, 0);
  TracedApp app(10, 10);
  EXPECT_EQ(run_command({TRACE_COMMAND, "record_snapshot", "run"}).exit_code, 0);
  EXPECT_EQ(run_command({TRACE_COMMAND, "stop", "run"}).exit_code, 0);
  app.end();
  EXPECT_EQ(run_command({TRACE_COMMAND, "stop", "run"}).exit_code, 1);
  EXPECT_FALSE(std::filesystem::exists(trace + "/verdict.json"));
}

TEST_F(TraceCommandE2e, WithoutLttngTheExitCodeIsTwo) {
  const CommandResult result =
      run_command({.argv = {TRACE_COMMAND, "start", "run"}, .environment = {{"PATH", "/nowhere"}}});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err,
            "launch trace start: error: cannot trace: lttng-sessiond is not installed or not in PATH\n"
            "      = help: install LTTng: sudo apt-get install lttng-tools liblttng-ust-dev\n");
}

}  // namespace
