// SPDX-License-Identifier: Apache-2.0
// `launch trace` on a tracer without LTTng.
#include "programs/launch/trace/trace_command.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "tracing/record/plan/trace_error.hpp"
#include "tracing/record/session/fake/fake_tracer.hpp"

namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using tracing::FakeTracer;
using tracing::run_trace_command;
using tracing::TraceError;

// The results of a run of the command.
struct Outcome {
  int exit_code;
  std::string out;
  std::string err;
};

// Runs the command with `input` on stdin, followed by the end of file.
Outcome run(const std::vector<std::string>& arguments, FakeTracer& tracer, const std::string& input = {}) {
  int ends[2];
  EXPECT_EQ(pipe(ends), 0);
  EXPECT_EQ(write(ends[1], input.data(), input.size()), static_cast<ssize_t>(input.size()));
  close(ends[1]);
  const int previous = dup(STDIN_FILENO);
  dup2(ends[0], STDIN_FILENO);
  close(ends[0]);
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int exit_code = run_trace_command(arguments, tracer);
  fflush(stdout);
  Outcome result{exit_code, testing::internal::GetCapturedStdout(), testing::internal::GetCapturedStderr()};
  dup2(previous, STDIN_FILENO);
  close(previous);
  return result;
}

TEST(TraceCommand, InteractiveFormStartsAtTheFirstEnterAndStopsAtTheSecond) {
  FakeTracer tracer;
  const Outcome result = run({"-s", "run", "-p", "/traces"}, tracer, "\n\n");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out,
            "userspace tracing enabled (42 events)\n"
            "kernel tracing disabled\n"
            "syscalls tracing disabled\n"
            "context (3 fields)\n"
            "writing tracing session to: /traces/run\n"
            "press enter to start...\n"
            "press enter to stop...\n"
            "stopping & destroying tracing session\n"
            "trace is complete: no events lost\n");
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(tracer.calls(), ElementsAre("start run", "finish run"));
}

TEST(TraceCommand, CreatesNothingWhenTheInputEndsBeforeTheFirstEnter) {
  FakeTracer tracer;
  const Outcome result = run({"-s", "run"}, tracer);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err,
            "launch trace: error: the input ended before tracing was started\n"
            "      = help: without a terminal use `launch trace start NAME`\n");
  EXPECT_THAT(tracer.calls(), IsEmpty());
}

TEST(TraceCommand, FinishesWhenTheInputEndsWhileTracing) {
  FakeTracer tracer;
  EXPECT_EQ(run({"-s", "run"}, tracer, "\n").exit_code, 0);
  EXPECT_THAT(tracer.calls(), ElementsAre("start run", "finish run"));
}

TEST(TraceCommand, ListsTheEnabledNames) {
  FakeTracer tracer;
  const Outcome result =
      run({"start", "run", "-p", "/traces", "-l", "-u", "a:b", "-k", "k1", "k2", "--syscall", "openat", "-c"}, tracer);
  EXPECT_EQ(result.out,
            "userspace tracing enabled (1 events)\n\ta:b\n"
            "kernel tracing enabled (2 events)\n\tk1\n\tk2\n"
            "syscalls tracing enabled (1 syscalls)\n\topenat\n"
            "context (0 fields)\n"
            "writing tracing session to: /traces/run\n");
}

TEST(TraceCommand, SaysWhatWasLost) {
  FakeTracer tracer;
  tracer.losses.channels = {{.domain = "ust", .channel = "ros2", .discarded_events = 12, .lost_packets = 0},
                            {.domain = "kernel", .channel = "kchan", .discarded_events = 0, .lost_packets = 1}};
  const Outcome result = run({"stop", "run"}, tracer);
  EXPECT_EQ(result.out,
            "stopping & destroying tracing session\n"
            "trace is incomplete: 12 events lost in ust channel ros2\n"
            "1 packet lost in kernel channel kchan\n");
}

TEST(TraceCommand, APauseSaysWhatIsRecordedSoFar) {
  FakeTracer tracer;
  tracer.losses_in_pause.emplace();
  tracer.losses_in_pause->directory = "/traces/run";
  tracer.losses_in_pause->processes = {{.name = "talker", .pid = 12, .seconds = 2, .events = 1000}};
  tracer.losses_in_pause->cost = {.ns_per_event = 100, .cpu = "", .lttng = "", .context_fields = {}, .measured = ""};
  EXPECT_EQ(run({"pause", "run"}, tracer).out,
            "pausing tracing session\n"
            "trace written to: /traces/run\n"
            "trace is complete: no events lost\n"
            "estimated cost of tracing: 0.000 s of processor time, 0.01 % of a processor; most in talker [12] (100 ns "
            "for each event)\n");
}

TEST(TraceCommand, NegativeSizesAndTimesAreErrors) {
  FakeTracer tracer;
  for (const char* option : {"--subbuffer-size-ust", "--switch-timer-ust", "--read-timer-ust", "--tracefile-count"}) {
    const Outcome result = run({"start", "run", option, "-5"}, tracer);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.err, std::string("launch trace start: error: ") + option +
                              ": expected a number that is not negative, got '-5'\n" +
                              "      = help: see 'launch trace start --help'\n");
  }
  EXPECT_THAT(tracer.calls(), IsEmpty());
}

TEST(TraceCommand, ASnapshotSaysWhereItIs) {
  FakeTracer tracer;
  tracer.snapshot_directory = "/traces/run/snapshot-1";
  EXPECT_EQ(run({"record_snapshot", "run"}, tracer).out,
            "recording snapshot of tracing session\nsnapshot written to: /traces/run/snapshot-1\n");
}

TEST(TraceCommand, SaysWhereTheTraceIs) {
  FakeTracer tracer;
  tracer.losses.directory = "/traces/run";
  EXPECT_EQ(run({"stop", "run"}, tracer).out,
            "stopping & destroying tracing session\n"
            "trace written to: /traces/run\n"
            "trace is complete: no events lost\n");
}

TEST(TraceCommand, NamesNoFolderThatIsNotThere) {
  FakeTracer tracer;
  tracer.losses.directory = "/traces/run";
  tracer.losses.wrote_nothing = true;
  EXPECT_EQ(run({"stop", "run"}, tracer).out,
            "stopping & destroying tracing session\n"
            "no trace was written\n"
            "trace is complete: no events lost\n");
  tracer.losses.of_snapshots = true;
  EXPECT_EQ(run({"stop", "run"}, tracer).out,
            "stopping & destroying tracing session\n"
            "no trace was written: no snapshot was taken\n");
}

TEST(TraceCommand, SaysNothingOfLossesOfSnapshotSessions) {
  FakeTracer tracer;
  tracer.losses.directory = "/traces/run";
  tracer.losses.of_snapshots = true;
  EXPECT_EQ(run({"stop", "run"}, tracer).out,
            "stopping & destroying tracing session\n"
            "snapshots are in: /traces/run\n");
}

TEST(TraceCommand, FailsOnLossWhenAskedTo) {
  FakeTracer tracer;
  EXPECT_EQ(run({"stop", "run", "--fail-on-loss"}, tracer).exit_code, 0);
  tracer.losses.channels = {{.domain = "ust", .channel = "ros2", .discarded_events = 1, .lost_packets = 0}};
  EXPECT_EQ(run({"stop", "run"}, tracer).exit_code, 0);
  const Outcome result = run({"stop", "run", "--fail-on-loss"}, tracer);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err,
            "launch trace stop: error: the trace of session 'run' is incomplete\n"
            "      = help: use larger buffers, record fewer events, or leave out --fail-on-loss\n");
}

TEST(TraceCommand, PrintsWarningsOfTheSetUp) {
  FakeTracer tracer;
  tracer.setup_report.warnings = {"rounded up"};
  EXPECT_EQ(run({"start", "run"}, tracer).err, "launch trace start: warning: rounded up\n");
}

TEST(TraceCommand, ErrorIsOnStderrWithItsRemedyAndExitCodeOne) {
  FakeTracer tracer;
  tracer.start_error = TraceError("trace session 'run' exists already", "choose another");
  const Outcome result = run({"start", "run"}, tracer);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err,
            "launch trace start: error: trace session 'run' exists already\n"
            "      = help: choose another\n");
}

TEST(TraceCommand, WrongUsageIsExitCodeTwo) {
  FakeTracer tracer;
  const Outcome result = run({"start"}, tracer);
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err,
            "launch trace start: error: session_name is required\n"
            "      = help: see 'launch trace start --help'\n");
  EXPECT_THAT(tracer.calls(), IsEmpty());
}

TEST(TraceCommand, VerbsActOnTheNamedSession) {
  FakeTracer tracer;
  for (const char* verb : {"start", "pause", "resume", "record_snapshot", "save", "stop", "load"}) {
    EXPECT_EQ(run({verb, "run"}, tracer).exit_code, 0) << verb;
  }
  EXPECT_THAT(tracer.calls(), ElementsAre("start run", "pause run", "resume run", "record_snapshot run", "save run ",
                                          "finish run", "load run "));
  EXPECT_EQ(run({"save", "run", "-p", "/there"}, tracer).exit_code, 0);
  EXPECT_EQ(tracer.calls().back(), "save run /there");
}

TEST(TraceCommand, DualSessionRecordsTheSnapshotBeforeTheRuntimeHalfRuns) {
  FakeTracer tracer;
  for (const char* verb : {"start", "pause", "resume", "stop"}) {
    EXPECT_EQ(run({verb, "run", "-d"}, tracer).exit_code, 0) << verb;
  }
  EXPECT_THAT(tracer.calls(), ElementsAre("record_snapshot run-snapshot", "start run-runtime", "pause run-runtime",
                                          "record_snapshot run-snapshot", "resume run-runtime", "finish run-runtime"));
}

TEST(TraceCommand, ListPrintsTheSessions) {
  FakeTracer tracer;
  EXPECT_EQ(run({"list"}, tracer).out, "no trace sessions\n");
  tracer.session_list = {{.name = "a", .path = "/traces/a", .active = true},
                         {.name = "b", .path = "", .active = false, .snapshot = true}};
  EXPECT_EQ(run({"list"}, tracer).out,
            "a (recording) /traces/a\n"
            "b (paused, snapshot)\n");
}

TEST(TraceCommand, StatusPrintsOneSessionOrAll) {
  const std::string channel =
      "  ust channel ros2: 2 sub-buffers of 32768 bytes per processor, drops the newest events when full\n"
      "    2 event rules: ros2:a, ros2:b\n"
      "  no events lost\n";
  FakeTracer tracer;
  EXPECT_EQ(run({"status"}, tracer).out, "no trace sessions\n");
  EXPECT_EQ(run({"status", "a"}, tracer).out, "a (recording) /traces/a\n" + channel);
  tracer.session_list = {{.name = "a"}, {.name = "b"}};
  EXPECT_EQ(run({"status"}, tracer).out, "a (recording) /traces/a\n" + channel + "b (recording) /traces/b\n" + channel);
  tracer.verb_error = TraceError("there is no trace session 'c'");
  EXPECT_EQ(run({"status", "c"}, tracer).exit_code, 1);
}

TEST(TraceCommand, EventsPrintsWhatCanBeRecorded) {
  FakeTracer tracer;
  tracer.events.userspace = {{.name = "ros2:rcl_init", .processes = {"ping 7", "pong 8"}}};
  tracer.events.why_no_kernel = "kernel events cannot be recorded: no modules";
  tracer.events.kernel_remedy = "install them";
  tracer.events.context_fields_ust = {"vpid", "vtid"};
  tracer.events.context_fields_kernel = {"pid"};
  const std::string fields =
      "context fields of userspace events: vpid, vtid, perf:thread:COUNTER, $app.PROVIDER:TYPE\n"
      "context fields of kernel events: pid, perf:cpu:COUNTER\n";
  EXPECT_EQ(run({"events"}, tracer).out,
            "userspace: 1 event of running programs\n"
            "  ros2:rcl_init (ping 7, pong 8)\n"
            "kernel: kernel events cannot be recorded: no modules\n"
            "  install them\n" +
                fields);
  tracer.events.userspace.clear();
  tracer.events.why_no_kernel.clear();
  tracer.events.kernel = {"sched_switch"};
  tracer.events.syscalls = 2;
  EXPECT_EQ(
      run({"events"}, tracer).out,
      "userspace: no running program has registered events; rules for events to come can be enabled all the same\n"
      "kernel: 1 event, 2 system calls\n"
      "  sched_switch\n" +
          fields);
}

TEST(TraceCommand, InteractiveDualSessionNeedsItsSnapshotHalf) {
  FakeTracer tracer;
  tracer.verb_error = TraceError("no session 'run-snapshot'");
  const Outcome result = run({"-s", "run", "-p", "/traces", "-d"}, tracer, "\n\n");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, testing::HasSubstr("writing snapshot tracing session to: /traces/run/snapshot\n"
                                             "writing runtime tracing session to: /traces/run/runtime\n"
                                             "press enter to start tracing...\n"));
  EXPECT_THAT(tracer.calls(), ElementsAre("record_snapshot run-snapshot"));
}

}  // namespace
