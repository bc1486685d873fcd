// SPDX-License-Identifier: Apache-2.0
// Sessions that can't be set up or ended: each gives an error that says what to do, and leaves nothing behind.
#include <gmock/gmock.h>
#include <poll.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/syscall.h>
#include <sys/wait.h>

#include <filesystem>

#include "tests/support/command.hpp"
#include "tests/unit/session/lttng_tracer_fixture.hpp"
#include "tests/unit/session/trace_reading.hpp"
#include "tracing/record/lttng/session_daemon.hpp"
#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace {

using test_support::read_file;
using test_support::run_command;
using trace_test::daemon_pid_file;
using trace_test::listed_sessions;
using trace_test::LttngTracer;
using trace_test::never;
using trace_test::read_trace;
using trace_test::TracedApp;
using tracing::TraceConfig;
using tracing::TraceError;

TEST_F(LttngTracer, NameTakenIsAnErrorAndLeavesTheOtherSessionAlone) {
  const TraceConfig config = config_named("taken");
  tracer->start(config);
  TraceConfig same_name = config;
  same_name.base_path += "/elsewhere";
  EXPECT_EQ(start_error(same_name),
            "trace session 'taken' exists already\n"
            "it may be that of another launch that runs; choose another session-name, or, if nobody uses it any "
            "more, end it with `launch trace stop taken`");
  TracedApp(5, 10).end();
  tracer->finish(config, never);
  EXPECT_EQ(read_trace(config.trace_directory()).events["ros2:rcl_init"], 1);
  EXPECT_FALSE(std::filesystem::exists(same_name.base_path));
}

TEST_F(LttngTracer, DirectoryThatExistsIsAnErrorWithoutAppend) {
  const TraceConfig config = config_named("again");
  std::filesystem::create_directories(config.trace_directory());
  EXPECT_EQ(start_error(config),
            "trace directory " + config.trace_directory() +
                " exists already\n"
                "set append-trace to true (launch trace: --append-trace) to add to it, or choose another session-name");
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
  if (geteuid() == 0) {
    umount(folder.c_str());
  }
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
  ASSERT_EQ(waitpid(pid, nullptr, WUNTRACED), pid);  // it is an orphan now, so it is a child of the sandbox
  EXPECT_EQ(start_error(config_named("run")), "the LTTng session daemon (process " + std::to_string(pid) +
                                                  ") is stopped and does not answer\ncontinue it with `kill -CONT " +
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

}  // namespace
