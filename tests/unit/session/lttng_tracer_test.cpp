// The real tracer on a session daemon of the test's own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"
#include "tests/unit/session/trace_reading.hpp"
#include "tracing/session/session_daemon.hpp"
#include "tracing/session/tracer.hpp"

namespace {

using test_support::read_file;
using test_support::run_command;
using test_support::Sandbox;
using testing::IsEmpty;
using trace_test::listed_sessions;
using trace_test::read_trace;
using trace_test::ReadTrace;
using trace_test::TracedApp;
using tracing::LossAccount;
using tracing::make_lttng_tracer;
using tracing::SetupReport;
using tracing::SetupStep;
using tracing::TraceConfig;
using tracing::TraceError;

bool never() {
  return false;
}

struct LttngTracer : testing::Test {
  TraceConfig config_named(const std::string& name) const {
    TraceConfig config;
    config.session_name = name;
    config.base_path = sandbox.trace_directory();
    return config;
  }

  // "what\nremedy" of the error that start() throws.
  std::string start_error(const TraceConfig& config) {
    try {
      tracer->start(config);
    } catch (const TraceError& error) {
      return std::string(error.what()) + "\n" + error.remedy();
    }
    return "no error";
  }

  Sandbox sandbox;
  std::unique_ptr<tracing::Tracer> tracer = make_lttng_tracer();
};

std::string daemon_pid_file() {
  const std::string home = std::string(getenv("LTTNG_HOME")) + "/.lttng";
  return (geteuid() == 0 ? "/run/lttng" : home) + "/lttng-sessiond.pid";
}

std::vector<std::string> step_names(const SetupReport& report) {
  std::vector<std::string> names;
  for (const SetupStep& step : report.steps) names.push_back(step.name);
  return names;
}

TEST_F(LttngTracer, RecordsEveryEventOfTwoApplications) {
  const TraceConfig config = config_named("run");
  const SetupReport report = tracer->start(config);
  EXPECT_EQ(report.trace_directory, config.trace_directory());
  EXPECT_THAT(report.warnings, IsEmpty());
  EXPECT_THAT(step_names(report),
              testing::ElementsAre("checks", "session daemon", "create session", "channel ros2", "events ros2",
                                   "context fields ros2", "start", "consumer priority"));
  TracedApp first(60, 100);
  TracedApp second(60, 100);
  first.end();
  const LossAccount losses = tracer->finish(config, never);
  second.end();

  const ReadTrace trace = read_trace(config.trace_directory());
  EXPECT_EQ(trace.complaints, "");
  EXPECT_EQ(losses.discarded_events(), 0u);
  EXPECT_EQ(trace.events, (std::map<std::string, int>{{"ros2:rcl_init", 2}, {"ros2:rclcpp_callback_register", 120}}));
  EXPECT_THAT(read_file(config.trace_directory() + "/verdict.json"), testing::HasSubstr("\"complete\": true"));
  EXPECT_GT(losses.channels.at(0).bytes, 120 * 100u) << "the packets were found";
  EXPECT_THAT(trace.lines.at(0), testing::HasSubstr("procname = \"traced_app\""));
  EXPECT_THAT(trace.lines.at(0), testing::ContainsRegex("vpid = [0-9]+, vtid = [0-9]+"));
  EXPECT_EQ(listed_sessions(), "");
}

TEST_F(LttngTracer, StartsADaemonOnDemandOnce) {
  EXPECT_TRUE(tracer->start(config_named("first")).started_daemon);
  EXPECT_FALSE(tracer->start(config_named("second")).started_daemon);
  tracer->finish(config_named("first"), never);
  tracer->finish(config_named("second"), never);
  EXPECT_EQ(listed_sessions(), "");
}

TEST_F(LttngTracer, TraceIsCompleteOnDiskEveryTimeFinishReturns) {
  constexpr int kRuns = 40;
  for (int run = 0; run < kRuns; ++run) {
    const TraceConfig config = config_named("run" + std::to_string(run));
    tracer->start(config);
    TracedApp alive(20, 50);
    TracedApp ended(20, 50);
    ended.end();
    tracer->finish(config, never);
    const ReadTrace trace = read_trace(config.trace_directory());
    ASSERT_EQ(trace.complaints, "") << "run " << run;
    ASSERT_EQ(trace.events, (std::map<std::string, int>{{"ros2:rcl_init", 2}, {"ros2:rclcpp_callback_register", 40}}))
        << "run " << run;
    alive.end();
  }
  EXPECT_EQ(listed_sessions(), "");
}

TEST_F(LttngTracer, NameTakenIsAnErrorAndLeavesTheOtherSessionAlone) {
  const TraceConfig config = config_named("taken");
  tracer->start(config);
  TraceConfig same_name = config;
  same_name.base_path += "/elsewhere";
  EXPECT_EQ(start_error(same_name),
            "trace session 'taken' exists already\n"
            "end it with `lttng destroy taken`, or choose another session-name");
  TracedApp(5, 10).end();
  tracer->finish(config, never);
  EXPECT_EQ(read_trace(config.trace_directory()).events["ros2:rcl_init"], 1);
  EXPECT_FALSE(std::filesystem::exists(same_name.base_path));
}

TEST_F(LttngTracer, DirectoryThatExistsIsAnErrorWithoutAppend) {
  const TraceConfig config = config_named("again");
  std::filesystem::create_directories(config.trace_directory());
  EXPECT_EQ(start_error(config), "trace directory " + config.trace_directory() +
                                     " exists already\n"
                                     "set append-trace to true to add to it, or choose another session-name");
}

TEST_F(LttngTracer, AppendedTraceIsReadTogetherWithTheEarlierOnes) {
  TraceConfig config = config_named("again");
  config.append_trace = true;
  for (int run = 0; run < 3; ++run) {
    EXPECT_EQ(tracer->start(config).trace_directory, config.trace_directory());
    TracedApp(5, 10).end();
    tracer->finish(config, never);
  }
  const ReadTrace trace = read_trace(config.trace_directory());
  EXPECT_EQ(trace.complaints, "");
  EXPECT_EQ(trace.events.at("ros2:rcl_init"), 3);
}

TEST_F(LttngTracer, BasePathBelowAFileIsAnErrorBeforeAnythingIsCreated) {
  test_support::write_file(sandbox.directory() / "file", "");
  TraceConfig config = config_named("run");
  config.base_path = sandbox.directory() / "file" / "traces";
  const std::string base = config.base_path;
  const std::string file = sandbox.directory() / "file";
  EXPECT_EQ(start_error(config), "cannot write traces to " + base + ": " + file +
                                     " is not a directory\nchoose another base-path, or set ROS_TRACE_DIR");
}

TEST_F(LttngTracer, ReadOnlyBasePathIsAnErrorBeforeAnythingIsCreated) {
  const std::filesystem::path folder = sandbox.directory() / "read_only";
  std::filesystem::create_directories(folder);
  if (geteuid() == 0) {
    ASSERT_EQ(mount("tmpfs", folder.c_str(), "tmpfs", MS_RDONLY, nullptr), 0);
  } else {
    std::filesystem::permissions(folder, std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  }
  TraceConfig config = config_named("run");
  config.base_path = folder / "traces";
  const char* reason = geteuid() == 0 ? "Read-only file system" : "Permission denied";
  EXPECT_EQ(start_error(config), "cannot write traces to " + config.base_path + ": " + folder.string() + ": " + reason +
                                     "\nchoose another base-path, or set ROS_TRACE_DIR");
  if (geteuid() == 0) umount(folder.c_str());
}

TEST_F(LttngTracer, MissingDaemonIsAnErrorThatNamesThePackages) {
  const std::string path = getenv("PATH");
  setenv("PATH", sandbox.directory().c_str(), 1);
  EXPECT_EQ(start_error(config_named("run")),
            "cannot trace: lttng-sessiond is not installed or not in PATH\n"
            "install LTTng: sudo apt-get install lttng-tools liblttng-ust-dev");
  setenv("PATH", path.c_str(), 1);
}

TEST_F(LttngTracer, DaemonThatDoesNotStartIsAnErrorWithItsOwnWords) {
  const std::filesystem::path program = sandbox.directory() / "bin" / "lttng-sessiond";
  test_support::write_file(program, "#!/bin/sh\necho 'Error: no room' >&2\nexit 1\n");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  const std::string path = getenv("PATH");
  setenv("PATH", (program.parent_path().string() + ":" + path).c_str(), 1);
  EXPECT_EQ(
      start_error(config_named("run")),
      "lttng-sessiond was started but does not answer: Error: no room\n"
      "run `lttng-sessiond --verbose` to see why; a daemon of another container that shares HOME is kept apart by "
      "another LTTNG_HOME");
  setenv("PATH", path.c_str(), 1);
}

TEST_F(LttngTracer, StoppedDaemonIsAnErrorAndDoesNotBlock) {
  ASSERT_TRUE(tracing::ensure_session_daemon());
  const pid_t pid = std::stoi(read_file(daemon_pid_file()));
  kill(pid, SIGSTOP);
  ASSERT_EQ(waitpid(pid, nullptr, WUNTRACED), pid);  // an orphan by now, so it is the sandbox's child
  EXPECT_EQ(start_error(config_named("run")), "the LTTng session daemon (process " + std::to_string(pid) +
                                                  ") is stopped and answers nobody\ncontinue it with `kill -CONT " +
                                                  std::to_string(pid) + "`");
  kill(pid, SIGCONT);
}

TEST_F(LttngTracer, UnknownContextFieldIsAnErrorWithASuggestion) {
  TraceConfig config = config_named("run");
  config.context_fields_ust = {"vpid", "procnam"};
  EXPECT_EQ(start_error(config), "unknown context field 'procnam'\ndid you mean `procname`?");
}

TEST_F(LttngTracer, KernelEventsWithoutAKernelTracerAreAnErrorAndNoSessionIsLeft) {
  TraceConfig config = config_named("run");
  config.events_kernel = {"sched_switch"};
  const std::string error = start_error(config);
  if (error == "no error") {
    tracer->finish(config, never);
    GTEST_SKIP() << "skipped, because this machine has the kernel tracer";
  }
  EXPECT_THAT(error, testing::StartsWith("kernel events cannot be recorded: "));
  EXPECT_THAT(error,
              testing::EndsWith("\ninstall the kernel tracer (sudo apt-get install lttng-modules-dkms) and run as "
                                "root or as a member of the group `tracing`; or trace without events-kernel and "
                                "syscalls"));
  EXPECT_EQ(listed_sessions(), "");
}

TEST_F(LttngTracer, FailureHalfWayLeavesNoSessionAndNoDirectory) {
  TraceConfig config = config_named("run");
  config.events_ust = {"ros2:rcl_init", "ros2:rcl_take if ((("};  // found when the session and its channel exist
  EXPECT_EQ(start_error(config),
            "LTTng does not understand the filter of event 'ros2:rcl_take': (((\n"
            "lttng-enable-event(1) describes filter expressions");
  EXPECT_EQ(listed_sessions(), "");
  EXPECT_FALSE(std::filesystem::exists(config.trace_directory()));
}

TEST_F(LttngTracer, OddSubbufferSizesAreRoundedUpWithAWarning) {
  TraceConfig config = config_named("run");
  config.subbuffer_size_ust = 10000;
  EXPECT_THAT(tracer->start(config).warnings,
              testing::ElementsAre("sub-buffer size of 10000 bytes for the ust domain is rounded up to 16384: LTTng "
                                   "needs a power of two, at least a page"));
  EXPECT_THAT(run_command({"lttng", "list", "run"}).out, testing::HasSubstr("Sub-buffer size:  16384 bytes"));
  tracer->finish(config, never);
}

TEST_F(LttngTracer, ChannelHasTheAttributesOfRos2TracingButForItsBuffers) {
  tracer->start(config_named("run"));
  const std::string listing = run_command({"lttng", "list", "run"}).out;
  for (const char* expected : {"Buffering scheme: per-user", "- ros2: [enabled]", "Event-loss mode:  discard",
                               "Sub-buffer size:  1048576 bytes", "Sub-buffer count: 4", "Switch timer:     inactive",
                               "Read timer:       50000 us", "Output mode:      mmap"}) {
    EXPECT_THAT(listing, testing::HasSubstr(expected));
  }
  tracer->finish(config_named("run"), never);
}

TEST_F(LttngTracer, ChannelHasTheNumberAndTimersThatWereAskedFor) {
  TraceConfig config = config_named("run");
  config.subbuffer_count_ust = 7;
  config.read_timer_ust = 50'000;
  config.switch_timer_ust = 1'000'000;
  EXPECT_THAT(
      tracer->start(config).warnings,
      testing::ElementsAre("number of sub-buffers 7 is rounded up to 8: LTTng needs a power of two, at least 2"));
  const std::string listing = run_command({"lttng", "list", "run"}).out;
  for (const char* expected : {"Sub-buffer count: 8", "Switch timer:     1000000 us", "Read timer:       50000 us"}) {
    EXPECT_THAT(listing, testing::HasSubstr(expected));
  }
  tracer->finish(config, never);
}

TEST_F(LttngTracer, InitialisationEventsHaveAChannelOfTheirOwnWhereAskedFor) {
  TraceConfig config = config_named("run");
  config.events_ust = {"ros2:*", "my:event"};
  config.init_channel = true;
  tracer->start(config);
  TracedApp(30, 10).end();
  const std::vector<tracing::ChannelDetails> channels = tracer->status("run").channels;
  ASSERT_EQ(channels.size(), 2u);
  for (const tracing::ChannelDetails& channel : channels) {
    const bool initialisation = channel.name == "ros2_init";
    EXPECT_EQ(channel.events.size(), initialisation ? 22u : 21u) << channel.name;
    EXPECT_THAT(channel.events, testing::Contains(initialisation ? "ros2:rcl_init" : "ros2:callback_start"));
  }
  const LossAccount losses = tracer->finish(config, never);
  EXPECT_EQ(read_trace(config.trace_directory()).events["ros2:rclcpp_callback_register"], 30) << "each once";
  ASSERT_EQ(losses.channels.size(), 2u);
  const auto bytes = [&losses](const std::string& name) {
    return losses.channels.at(losses.channels.at(0).channel == name ? 0 : 1).bytes;
  };
  EXPECT_GT(bytes("ros2_init"), bytes("ros2") + 30 * 30) << "they are not in the other one";
}

TEST_F(LttngTracer, LossesEqualWhatTheTraceSays) {
  TraceConfig config = config_named("flood");
  config.subbuffer_size_ust = 4096;
  tracer->start(config);
  constexpr int kEvents = 200000;
  TracedApp flood(kEvents, 200);
  flood.end();
  const LossAccount losses = tracer->finish(config, never);
  const ReadTrace trace = read_trace(config.trace_directory());
  EXPECT_EQ(trace.complaints, "");
  EXPECT_GT(losses.discarded_events(), 0u);
  EXPECT_EQ(losses.discarded_events(), trace.discarded);
  EXPECT_EQ(losses.discarded_events() + trace.lines.size(), static_cast<std::uint64_t>(kEvents) + 1);

  const std::string verdict = read_file(config.trace_directory() + "/verdict.json");
  EXPECT_THAT(verdict, testing::HasSubstr("\"complete\": false"));
  EXPECT_THAT(verdict, testing::HasSubstr("\"discarded_events\": " + std::to_string(trace.discarded)));
  std::uint64_t in_ranges = 0;
  for (const tracing::LossRange& range : losses.channels.at(0).ranges) in_ranges += range.events;
  EXPECT_EQ(in_ranges, trace.discarded);
}

TEST_F(LttngTracer, GivingUpDestroysTheSessionAtOnce) {
  const TraceConfig config = config_named("run");
  tracer->start(config);
  TracedApp app(10, 10);
  tracer->finish(config, [] { return true; });
  app.end();
  EXPECT_EQ(listed_sessions(), "");
}

TEST_F(LttngTracer, FinishOfASessionThatSomebodyDestroyedIsAnError) {
  const TraceConfig config = config_named("run");
  tracer->start(config);
  ASSERT_EQ(run_command({"lttng", "destroy", "run"}).exit_code, 0);
  try {
    tracer->finish(config, never);
    FAIL() << "no error";
  } catch (const TraceError& error) {
    EXPECT_STREQ(error.what(), "cannot stop trace session 'run': Session name not found");
    EXPECT_EQ(error.remedy(), "`launch trace list` shows the sessions that exist");
  }
}

TEST_F(LttngTracer, FinishAfterTheDaemonWasKilledIsAnErrorAndDoesNotBlock) {
  const TraceConfig config = config_named("run");
  tracer->start(config);
  const pid_t pid = std::stoi(read_file(daemon_pid_file()));
  const int pidfd = static_cast<int>(syscall(SYS_pidfd_open, pid, 0));
  kill(pid, SIGKILL);
  pollfd death{pidfd, POLLIN, 0};
  ASSERT_EQ(poll(&death, 1, 10000), 1);
  close(pidfd);
  try {
    tracer->finish(config, never);
    FAIL() << "no error";
  } catch (const TraceError& error) {
    EXPECT_STREQ(error.what(), "cannot stop trace session 'run': No session daemon is available");
    EXPECT_EQ(error.remedy(),
              "no LTTng session daemon runs for this user any more: its sessions are gone, their traces end where they "
              "are");
  }
}

TEST_F(LttngTracer, PausedSessionRecordsNothingUntilItIsResumed) {
  const TraceConfig config = config_named("run");
  tracer->start(config);
  TracedApp app(10, 10);
  tracer->pause("run");
  app.fire_again();
  tracer->resume("run");
  app.fire_again();
  tracer->pause("run");
  tracer->finish(config, never);
  app.end();
  EXPECT_EQ(read_trace(config.trace_directory()).events["ros2:rclcpp_callback_register"], 20);
  EXPECT_EQ(listed_sessions(), "");
}

TEST_F(LttngTracer, SnapshotsHoldWhatCameSinceTheLastOne) {
  TraceConfig config = config_named("run");
  config.snapshot_mode = true;
  tracer->start(config);
  EXPECT_THAT(
      run_command({"lttng", "list", "run"}).out,
      testing::AllOf(testing::HasSubstr("Event-loss mode:  overwrite"), testing::HasSubstr("Sub-buffer count: 4")));
  TracedApp app(10, 10);
  EXPECT_FALSE(std::filesystem::exists(config.trace_directory()));
  tracer->record_snapshot("run");
  app.fire_again();
  app.fire_again();
  tracer->record_snapshot("run");
  tracer->finish(config, never);
  app.end();

  std::vector<int> counts;
  for (const auto& snapshot : std::filesystem::directory_iterator(config.trace_directory())) {
    counts.push_back(read_trace(snapshot.path()).events["ros2:rclcpp_callback_register"]);
  }
  EXPECT_THAT(counts, testing::UnorderedElementsAre(10, 20));
  EXPECT_EQ(listed_sessions(), "");
}

TEST_F(LttngTracer, SnapshotOfAnOrdinarySessionIsAnError) {
  tracer->start(config_named("run"));
  try {
    tracer->record_snapshot("run");
    FAIL() << "no error";
  } catch (const TraceError& error) {
    EXPECT_STREQ(
        error.what(),
        "cannot record a snapshot of session 'run': Snapshot command can't be applied to a non-snapshot session");
  }
  tracer->finish(config_named("run"), never);
}

TEST_F(LttngTracer, DualSessionKeepsTheInitialisationOfNodesThatRanBefore) {
  TraceConfig snapshot = config_named("dual");
  snapshot.dual_session = true;
  snapshot.events_ust = tracing::initialisation_ros_events();
  tracer->start(snapshot);
  TracedApp app(10, 10);

  TraceConfig runtime = config_named("dual");
  runtime.dual_runtime = true;
  tracer->record_snapshot("dual-snapshot");
  tracer->start(runtime);
  app.fire_again();
  tracer->finish(runtime, never);
  tracer->finish(snapshot, never);
  app.end();

  EXPECT_EQ(read_trace(sandbox.trace_directory() / "dual" / "snapshot").events["ros2:rcl_init"], 1);
  EXPECT_EQ(read_trace(sandbox.trace_directory() / "dual" / "runtime").events["ros2:rclcpp_callback_register"], 10);
  EXPECT_EQ(read_trace(sandbox.trace_directory() / "dual").events["ros2:rclcpp_callback_register"], 20);
  EXPECT_EQ(listed_sessions(), "");
}

}  // namespace
