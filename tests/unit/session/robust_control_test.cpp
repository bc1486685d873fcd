// SPDX-License-Identifier: Apache-2.0
// Problems around a session: each gives one clear error, blocks nothing, and leaves no session.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>
#include <thread>

#include "base/processes/process_stat.hpp"
#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"
#include "tests/unit/session/listed_session.hpp"
#include "tests/unit/session/trace_reading.hpp"
#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/checks/context_check.hpp"
#include "tracing/record/lttng/session_daemon.hpp"
#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/plan/trace_error.hpp"
#include "tracing/record/session/tracer.hpp"

namespace {

namespace fs = std::filesystem;

using test_support::run_command;
using testing::HasSubstr;
using testing::StartsWith;
using trace_test::listed_sessions;
using trace_test::read_trace;
using trace_test::TracedApp;
using tracing::LossAccount;
using tracing::TraceConfig;
using tracing::TraceError;

bool never() {
  return false;
}

struct RobustControl : testing::Test {
  TraceConfig config(const std::string& name = "run") const {
    TraceConfig made;
    made.session_name = name;
    made.base_path = sandbox.trace_directory();
    return made;
  }

  // An application that does not wait, a megabyte, and a session that ends and reports its losses.
  LossAccount record_more_than_fits(const std::string& base_path) {
    TraceConfig full = config();
    full.base_path = base_path;
    tracer->start(full);
    TracedApp app(2000, 200);
    app.fire_again();
    app.end();
    LossAccount losses = tracer->finish(full, never);
    EXPECT_FALSE(losses.complete());
    EXPECT_FALSE(losses.channels.at(0).unwritten.empty());
    EXPECT_EQ(listed_sessions(), "");
    return losses;
  }

  // Whether the first packet of one of them fits depends on the processor of the application.
  static auto lacks_events(const std::string& why) {
    return testing::MatchesRegex(why +
                                 ": (events after 0\\.[0-9]+ s of [0-9.]+ s are missing|no event could be written); "
                                 "make room there, or choose another base-path");
  }

  // "what\nremedy" of the error that `work` throws.
  template <typename Work>
  static std::string error_of(Work work) {
    try {
      work();
    } catch (const TraceError& error) {
      return std::string(error.what()) + "\n" + error.remedy();
    }
    return "no error";
  }

  // The processes of this test with this name.
  static std::vector<pid_t> processes(const std::string& name) {
    std::vector<pid_t> found;
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator("/proc")) {
      std::string comm;
      std::getline(std::ifstream(entry.path() / "comm") >> std::ws, comm);
      if (comm == name &&
          fs::read_symlink(entry.path() / "ns" / "net", ignored) == fs::read_symlink("/proc/self/ns/net")) {
        found.push_back(std::stoi(entry.path().filename()));
      }
    }
    return found;
  }

  // Kills them and waits until they have ended.
  static void kill_processes(const std::string& name) {
    for (const pid_t pid : processes(name)) {
      const int pidfd = static_cast<int>(syscall(SYS_pidfd_open, pid, 0));
      kill(pid, SIGKILL);
      pollfd death{pidfd, POLLIN, 0};
      EXPECT_EQ(poll(&death, 1, 10000), 1);
      close(pidfd);
    }
  }

  test_support::Sandbox sandbox;
  std::unique_ptr<tracing::Tracer> tracer = tracing::make_lttng_tracer();
};

TEST_F(RobustControl, AKilledConsumerIsAnErrorAndBlocksNoApplication) {
  if (geteuid() != 0) {
    GTEST_SKIP() << "skipped, because without root the consumers of the machine can't be told apart";
  }
  tracer->start(config());
  TracedApp app(10, 10);
  kill_processes("lttng-consumerd");
  app.fire_again();
  app.end();
  const std::string error = error_of([this] { tracer->finish(config(), never); });
  EXPECT_THAT(error, HasSubstr("run"));
  EXPECT_NE(error, "no error");
  // Sometimes LTTng's daemon ends with its consumer: then there is no session, either.
  EXPECT_THAT(listed_sessions(), testing::AnyOf("", HasSubstr("No session daemon is available")));
  signal(SIGPIPE, SIG_IGN);  // as launch does; LTTng's library writes to a daemon that may have ended
  const tracing::SetupReport next = tracer->start(config("next"));
  EXPECT_TRUE(next.started_daemon ||
              next.warnings == std::vector<std::string>{"LTTng's consumer had been killed; the session daemon, which a "
                                                        "launch had started, was restarted"});
  TracedApp(10, 10).end();
  tracer->finish(config("next"), never);
  EXPECT_EQ(read_trace(config("next").trace_directory()).events.at("ros2:rclcpp_callback_register"), 10);
}

// A daemon that somebody else has started, or that others use, is not ended.
TEST_F(RobustControl, AfterAKilledConsumerADaemonOfOthersIsToldOf) {
  if (geteuid() != 0) {
    GTEST_SKIP() << "skipped, because without root the consumers of the machine can't be told apart";
  }
  ASSERT_EQ(run_command({"lttng-sessiond", "--daemonize"}).exit_code, 0);
  tracer->start(config());
  const pid_t daemon = tracing::session_daemon_pid();
  kill_processes("lttng-consumerd");
  error_of([this] { tracer->finish(config(), never); });
  signal(SIGPIPE, SIG_IGN);
  const std::string error = error_of([this] { tracer->start(config("next")); });
  // Sometimes LTTng's daemon ends with its consumer.
  if (processes("lttng-sessiond") == std::vector<pid_t>{daemon}) {
    EXPECT_THAT(error,
                HasSubstr("restart lttng-sessiond: its consumer has ended, and it starts no other one. `kill " +
                          std::to_string(daemon) + "` ends it with all its sessions; the next trace starts a new one"));
  }
}

TEST_F(RobustControl, WhatARecordingNeedsIsWatched) {
  if (geteuid() != 0) {
    GTEST_SKIP() << "skipped, because without root the consumers of the machine can't be told apart";
  }
  tracer->start(config());
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<std::string> told;
  const auto next = [&] {
    std::unique_lock lock(mutex);
    changed.wait_for(lock, std::chrono::seconds(30), [&] { return !told.empty(); });
    std::string sentence = told.empty() ? "nothing" : told.front();
    if (!told.empty()) {
      told.erase(told.begin());
    }
    return sentence;
  };
  std::unique_ptr<tracing::RunWatch> watch = tracer->watch(config(), [&](const std::string& sentence) {
    const std::lock_guard lock(mutex);
    told.push_back(sentence);
    changed.notify_one();
  });
  const pid_t daemon = tracing::session_daemon_pid();
  const pid_t consumer = processes("lttng-consumerd").at(0);
  kill(daemon, SIGSTOP);
  EXPECT_EQ(next(), "the LTTng session daemon (process " + std::to_string(daemon) +
                        ") is stopped: processes that start now are not recorded; continue it with `kill -CONT " +
                        std::to_string(daemon) + "`");
  kill(daemon, SIGCONT);
  kill(consumer, SIGSTOP);
  EXPECT_EQ(next(), "LTTng's consumer (process " + std::to_string(consumer) +
                        ") is stopped: events are lost when the buffers are full; continue it with `kill -CONT " +
                        std::to_string(consumer) + "`");
  kill(consumer, SIGKILL);
  EXPECT_EQ(next(), "LTTng's consumer (process " + std::to_string(consumer) +
                        ") has ended: nothing is written any more, and the trace ends here; the next trace starts "
                        "another one");
  kill(daemon, SIGKILL);
  EXPECT_EQ(next(), "the LTTng session daemon (process " + std::to_string(daemon) +
                        ") has ended: nothing is recorded any more, and the trace ends here; the system goes on");
  watch.reset();
  EXPECT_TRUE(told.empty()) << "each is said once";
  EXPECT_THAT(error_of([this] { tracer->finish(config(), never); }), HasSubstr("run"));
  EXPECT_THAT(test_support::read_file(fs::path(config().trace_directory()) / "verdict.json"),
              HasSubstr("\"complete\": false"));
}

TEST_F(RobustControl, AStoppedConsumerIsAnErrorAndIsContinuedAtTheEnd) {
  if (geteuid() != 0) {
    GTEST_SKIP() << "skipped, because without root the consumers of the machine can't be told apart";
  }
  tracer->start(config());
  TracedApp app(10, 10);
  const std::string consumer = std::to_string(processes("lttng-consumerd").at(0));
  for (const pid_t process : processes("lttng-consumerd")) {
    kill(process, SIGSTOP);
    while (launch::read_process_stat(process).state != 'T') {  // its threads stop one after the other
      std::this_thread::yield();
    }
  }
  const std::string stopped = "LTTng's consumer (process " + consumer + ") is stopped and does not answer\n" +
                              "continue it with `kill -CONT " + consumer + "`";
  EXPECT_EQ(error_of([this] { tracer->status("run"); }), stopped);
  EXPECT_EQ(error_of([this] { tracer->pause("run"); }), stopped);
  EXPECT_EQ(error_of([this] { tracer->resume("run"); }), stopped);
  const LossAccount losses = tracer->finish(config(), never);
  EXPECT_TRUE(losses.complete()) << losses.damage;
  EXPECT_THAT(losses.notes, testing::Contains("LTTng's consumer (process " + consumer +
                                              ") was stopped; it was continued, so that the session could end"));
  EXPECT_EQ(listed_sessions(), "");
  app.end();
  EXPECT_EQ(read_trace(config().trace_directory()).events.at("ros2:rclcpp_callback_register"), 10);
}

TEST_F(RobustControl, ADaemonThatIsStoppedInMidRunIsAnErrorAndIsContinuedAtTheEnd) {
  tracer->start(config());
  TracedApp app(10, 10);
  const std::string home = std::string(getenv("LTTNG_HOME")) + "/.lttng";
  const pid_t pid = std::stoi(test_support::read_file((geteuid() == 0 ? "/run/lttng" : home) + "/lttng-sessiond.pid"));
  kill(pid, SIGSTOP);
  ASSERT_EQ(waitpid(pid, nullptr, WUNTRACED), pid);
  const std::string stopped = "the LTTng session daemon (process " + std::to_string(pid) +
                              ") is stopped and does not answer\ncontinue it with `kill -CONT " + std::to_string(pid) +
                              "`";
  EXPECT_EQ(error_of([this] { tracer->status("run"); }), stopped);
  EXPECT_EQ(error_of([this] { tracer->pause("run"); }), stopped);
  const LossAccount losses = tracer->finish(config(), never);
  EXPECT_TRUE(losses.complete()) << losses.damage;
  EXPECT_THAT(losses.notes, testing::ElementsAre("LTTng's session daemon (process " + std::to_string(pid) +
                                                 ") was stopped; it was continued, so that the session could end"));
  EXPECT_EQ(listed_sessions(), "");
  app.end();
  EXPECT_EQ(read_trace(config().trace_directory()).events.at("ros2:rclcpp_callback_register"), 10);
}

// Also in the middle of the end of a session.
TEST_F(RobustControl, DaemonsThatAreStoppedWhileTheSessionEndsAreContinued) {
  if (geteuid() != 0) {
    GTEST_SKIP() << "skipped, because without root the consumers of the machine can't be told apart";
  }
  for (const char* const name : {"lttng-sessiond", "lttng-consumerd"}) {
    tracer->start(config(name));
    TracedApp app(2000, 200);
    const pid_t pid = processes(name).at(0);
    std::atomic<bool> ended = false;
    std::thread stopping([&] {
      while (!ended) {
        kill(pid, SIGSTOP);
        std::this_thread::sleep_for(std::chrono::milliseconds(150));
      }
    });
    const LossAccount losses = tracer->finish(config(name), never);
    ended = true;
    stopping.join();
    kill(pid, SIGCONT);
    EXPECT_TRUE(losses.complete()) << losses.damage;
    EXPECT_EQ(losses.notes.size(), 1u) << name;
    EXPECT_EQ(listed_sessions(), "");
    app.end();
  }
}

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
