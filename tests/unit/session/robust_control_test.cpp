// SPDX-License-Identifier: Apache-2.0
// Problems around a session: each gives one clear error, blocks nothing, and leaves no session.
#include "tests/unit/session/robust_control.hpp"

#include <signal.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <thread>

#include "tests/support/command.hpp"
#include "tracing/record/checks/context_check.hpp"
#include "tracing/record/lttng/session_daemon.hpp"

namespace trace_test {
namespace {

using test_support::run_command;
using testing::HasSubstr;
using testing::StartsWith;

TEST_F(RobustControl, AFullDiskIsSaidAndTheSessionEnds) {
  if (geteuid() != 0) {
    GTEST_SKIP() << "skipped, because without root no small file system can be mounted";
  }
  fs::create_directories(sandbox.trace_directory());
  ASSERT_EQ(mount("tmpfs", sandbox.trace_directory().c_str(), "tmpfs", 0, "size=256k"), 0);
  const LossAccount losses = record_more_than_fits(sandbox.trace_directory());
  EXPECT_THAT(losses.damage, lacks_events("the file system of " + config().trace_directory() + " is full"));
  umount2(sandbox.trace_directory().c_str(), MNT_DETACH);
}

// On an ordinary kernel only btrfs has quotas that also hold for root.
TEST_F(RobustControl, ADiskQuotaThatIsUsedUpIsSaidAndTheSessionEnds) {
  const std::string image = (sandbox.directory() / "disk").string();
  const std::string disk = sandbox.trace_directory().string();
  const std::string traces = disk + "/traces";
  const auto made = run_command({"sh", "-ec",
                                 "truncate -s 128M " + image + "; mkfs.btrfs -q " + image + "; mkdir -p " + disk +
                                     "; mount -o loop " + image + " " + disk + "; btrfs quota enable " + disk +
                                     "; btrfs subvolume create " + traces + "; btrfs qgroup limit 256k " + traces});
  if (made.exit_code != 0) {
    GTEST_SKIP() << "skipped, because no file system with a quota can be made: " << made.err;
  }
  const LossAccount losses = record_more_than_fits(traces);
  EXPECT_THAT(losses.damage, lacks_events("the disk quota for " + traces + "/run is used up"));
  umount2(disk.c_str(), MNT_DETACH);
}

TEST_F(RobustControl, SharedMemoryThatCannotBeWrittenIsAnErrorBeforeAnythingIsCreated) {
  if (geteuid() != 0) {
    GTEST_SKIP() << "skipped, because without root /dev/shm can't be made read-only";
  }
  ASSERT_EQ(mount(nullptr, "/dev/shm", nullptr, MS_REMOUNT | MS_RDONLY, nullptr), 0);
  EXPECT_EQ(error_of([this] { tracer->start(config()); }),
            "userspace events need shared memory, but /dev/shm cannot be written: Read-only file system\n"
            "mount a tmpfs there that all users can write to; containers have one unless it was taken away");
  ASSERT_EQ(mount(nullptr, "/dev/shm", nullptr, MS_REMOUNT, nullptr), 0);
  EXPECT_FALSE(fs::exists(config().trace_directory()));
}

TEST_F(RobustControl, LittleSharedMemoryMakesTheBuffersSmallerWithAWarning) {
  if (geteuid() != 0) {
    GTEST_SKIP() << "skipped, because without root /dev/shm can't be made small";
  }
  ASSERT_EQ(mount(nullptr, "/dev/shm", nullptr, MS_REMOUNT, "size=3m"), 0);
  const auto warnings = tracer->start(config()).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], HasSubstr("sub-buffers are made smaller"));
  const auto size = trace_test::list_session("run").channel("ros2").subbuffer_size;
  EXPECT_LT(size, TraceConfig().ust.subbuffer_size);
  TracedApp(20, 100).end();
  tracer->finish(config(), never);
  EXPECT_EQ(read_trace(config().trace_directory()).events.at("ros2:rclcpp_callback_register"), 20);
}

TEST_F(RobustControl, TwoThatStartTheDaemonAtOnceBothGetTheirSession) {
  const auto start = [this](const std::string& name) {
    return test_support::Command{.argv = {TRACE_COMMAND, "start", name, "-p", sandbox.trace_directory().string()}};
  };
  for (int round = 0; round < 5; ++round) {
    test_support::RunningCommand first(start("first"));
    test_support::RunningCommand second(start("second"));
    const auto first_result = first.wait();
    const auto second_result = second.wait();
    ASSERT_EQ(first_result.exit_code, 0) << first_result.err;
    ASSERT_EQ(second_result.exit_code, 0) << second_result.err;
    for (const std::string name : {"first", "second"}) {
      ASSERT_TRUE(trace_test::list_session(name).active);
      tracer->finish(config(name), never);
    }
    sandbox.end_processes();
    fs::remove_all(sandbox.trace_directory());
  }
}

TEST_F(RobustControl, FiveHundredProcessesAreAllRecorded) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "skipped, because five hundred processes with ThreadSanitizer take minutes to start";
#endif
  TraceConfig many = config();
  tracer->start(many);
  constexpr int kProcesses = 500;
  const auto result = test_support::run_command({.argv = {"sh", "-c",
                                                          "for i in $(seq " + std::to_string(kProcesses) + "); do " +
                                                              TRACED_APP + " 1 10 >/dev/null & done; wait"},
                                                 // However busy the machine is: this is about the daemon's descriptors.
                                                 .environment = {{"LTTNG_UST_REGISTER_TIMEOUT", "-1"}}},
                                                std::chrono::seconds(300));
  const LossAccount losses = tracer->finish(many, never);
  EXPECT_EQ(losses.discarded_events(), 0u);
  EXPECT_EQ(read_trace(many.trace_directory()).events["ros2:rcl_init"], kProcesses);
}

TEST_F(RobustControl, TheConsumerIsPreferredWherePermitted) {
  if (geteuid() != 0) {
    GTEST_SKIP() << "skipped, because without root no process can be preferred";
  }
  tracer->start(config());
  const std::vector<pid_t> consumers = processes("lttng-consumerd");
  EXPECT_FALSE(consumers.empty());
  for (const pid_t consumer : consumers) {
    for (const auto& thread : fs::directory_iterator("/proc/" + std::to_string(consumer) + "/task")) {
      EXPECT_EQ(getpriority(PRIO_PROCESS, static_cast<id_t>(std::stoi(thread.path().filename()))), -10);
    }
  }
  tracer->finish(config(), never);
}

TEST_F(RobustControl, ContextFieldsAreTriedByRecordingOneEvent) {
  tracing::ensure_session_daemon();
  EXPECT_TRUE(tracing::records_an_event({"vpid"}, TRACE_PROBE));
  // A raw counter that no processor has: LTTng accepts it and records nothing.
  EXPECT_FALSE(tracing::records_an_event({"perf:thread:raw:rffffffffffff:NONE"}, TRACE_PROBE));
  EXPECT_EQ(listed_sessions(), "");
}

TEST_F(RobustControl, AWrongUserIsToldWhoseSessionItIs) {
  if (geteuid() != 0) {
    GTEST_SKIP() << "skipped, because only root has a session daemon that others can't use";
  }
  tracer->start(config());
  const auto result = test_support::run_command(
      {"setpriv", "--reuid=65534", "--regid=65534", "--clear-groups", TRACE_COMMAND, "stop", "run"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, StartsWith("launch trace stop: error: "));
  EXPECT_THAT(result.err, HasSubstr("\n      = help: "));
  EXPECT_TRUE(trace_test::list_session("run").active) << "it is as it was";
  tracer->finish(config(), never);
}

// The command that the guardian of a killed launcher runs when the launcher's session could not be created.
TEST_F(RobustControl, AnOlderSessionOfTheSameNameIsNotStopped) {
  tracer->start(config());
  const auto stop_since = [](std::int64_t seconds) {
    return test_support::run_command({TRACE_COMMAND, "stop", "run", "--created-since=" + std::to_string(seconds)});
  };
  const std::int64_t created = tracer->sessions().at(0).created;
  const auto later = stop_since(created + 1);
  EXPECT_EQ(later.exit_code, 0) << later.err;
  EXPECT_EQ(later.out, "trace session 'run' is left as it is: it is older\n");
  EXPECT_TRUE(trace_test::list_session("run").active);
  const auto own = stop_since(created);
  EXPECT_EQ(own.exit_code, 0) << own.err;
  EXPECT_EQ(listed_sessions(), "");
}

// As in a container: a program that runs before the session daemon waits for a wake-up through /dev/shm.
TEST_F(RobustControl, ProcessesWithSharedMemoryOfTheirOwnAreRecordedOrToldOf) {
  if (geteuid() != 0) {
    GTEST_SKIP() << "skipped, because without root there is no second /dev/shm";
  }
  const std::string apart = std::string("mount -t tmpfs none /dev/shm && exec ") + TRACED_APP + " 5 10";
  test_support::RunningCommand before({.argv = {"unshare", "-m", "sh", "-c", apart}});
  ASSERT_TRUE(before.wait_for_output("fired"));
  const auto started = test_support::run_command({TRACE_COMMAND, "start", "run", "-p", sandbox.trace_directory()});
  EXPECT_EQ(started.exit_code, 0);
  EXPECT_EQ(started.err,
            "launch trace start: warning: process " + std::to_string(before.pid()) +
                " (traced_app) is not recorded: it has a /dev/shm of its own and started before the session "
                "daemon; share /dev/shm (docker run --ipc=host), or start it again\n");
  test_support::RunningCommand after({.argv = {"unshare", "-m", "sh", "-c", apart}});
  ASSERT_TRUE(after.wait_for_output("fired"));
  for (test_support::RunningCommand* app : {&before, &after}) {
    app->close_input();
    EXPECT_EQ(app->wait().exit_code, 0);
  }
  tracer->finish(config(), never);
  EXPECT_EQ(read_trace(config().trace_directory()).events.at("ros2:rclcpp_callback_register"), 5);
}

}  // namespace
}  // namespace trace_test
